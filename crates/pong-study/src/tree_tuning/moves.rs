//! Changes of the groups of a model, from large to small.

use crate::runs::subject::{Grouping, Setting, Shape};
use pong_geometry::bounding::BoundKind;
use pong_model::grouping::Bound;

/// Settings for some groups.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Move(pub Vec<(usize, Setting)>);

/// Extent of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reach {
    /// All groups of a model.
    Model,
    /// All groups of a body, or the child groups of one group.
    Family,
    /// One group.
    Group,
}

/// Leaf sizes tried, in elements.
const SIZES: [usize; 4] = [8, 32, 128, 512];

const KINDS: [BoundKind; 3] = [BoundKind::Aabb, BoundKind::Sphere, BoundKind::Obb];

/// All moves of a reach from a grouping, always in the same order.
pub(crate) fn moves(shape: &Shape, now: &Grouping, reach: Reach) -> Vec<Move> {
    let all: Vec<usize> = (0..shape.groups.len()).collect();
    let mut moves = match reach {
        Reach::Model => of_families(shape, now, &[all]),
        Reach::Family => of_families(shape, now, &families(shape)),
        Reach::Group => all.iter().flat_map(|group| of_group(shape, now, *group)).collect(),
    };
    let mut known = vec![now.clone()];
    moves.retain(|change| {
        let then = applied(shape, now, change);
        let is_new = !known.contains(&then);
        known.push(then);
        is_new
    });
    moves
}

/// The grouping after a move. Leaf sizes are removed from groups that are no longer leaves.
pub(crate) fn applied(shape: &Shape, now: &Grouping, change: &Move) -> Grouping {
    let mut then = now.clone();
    for (group, setting) in &change.0 {
        then[*group] = setting.clone();
    }
    let leafless: Vec<usize> = (0..then.len()).filter(|group| shape.leaf(&then, *group) == 0).collect();
    leafless.into_iter().for_each(|group| then[group].leaf_size = None);
    then
}

/// All groups of each body, if there are several bodies; the child groups of each group.
fn families(shape: &Shape) -> Vec<Vec<usize>> {
    let body_of = |mut group: usize| {
        while let Some(above) = shape.groups[group].above.filter(|_| !shape.groups[group].movable) {
            group = above;
        }
        group
    };
    let bodies: Vec<usize> = (0..shape.groups.len()).filter(|group| shape.groups[*group].movable).collect();
    let mut families = Vec::new();
    if bodies.len() > 1 {
        let of = |body: usize| (0..shape.groups.len()).filter(|group| body_of(*group) == body).collect();
        families.extend(bodies.into_iter().map(of));
    }
    let below = |group| shape.below(group).filter(|below| !shape.groups[*below].movable).collect::<Vec<_>>();
    families.extend((0..shape.groups.len()).map(below).filter(|family| family.len() > 1));
    families
}

/// Moves of whole families: one kind for all, no volumes except the bodies' own, none above leaves, none of
/// leaves.
fn of_families(shape: &Shape, now: &Grouping, families: &[Vec<usize>]) -> Vec<Move> {
    let mut moves = Vec::new();
    for family in families {
        for kind in KINDS {
            let bounded = family.iter().filter(|group| now[**group].bound != Bound::Above);
            moves.push(set(now, bounded, |setting| setting.bound = Bound::Around(kind.clone())));
        }
        let plain = |group: &&usize| !shape.groups[**group].movable;
        let holds = |group: &&usize| shape.groups[**group].holds_primitives;
        let above = |setting: &mut Setting| setting.bound = Bound::Above;
        let flat = set(now, family.iter().filter(plain), above);
        moves.push(set(now, family.iter().filter(plain).filter(|group| !holds(group)), above));
        moves.push(set(now, family.iter().filter(plain).filter(holds), above));
        for size in SIZES {
            let mut cut = flat.clone();
            cut.0.extend(cut_bodies(shape, now, family, &flat, size));
            moves.push(cut);
            let whole = applied(shape, now, &set(now, family.iter(), |_| {}));
            let large = family.iter().filter(|group| shape.leaf(&whole, **group) > size);
            moves.push(set(now, large, |setting| setting.leaf_size = Some(size)));
        }
        moves.push(set(now, family.iter(), |setting| setting.leaf_size = None));
        moves.push(flat);
    }
    moves
}

/// Leaf sizes for the movable groups of a family whose leaves become large without the volumes below.
fn cut_bodies(
    shape: &Shape,
    now: &Grouping,
    family: &[usize],
    flat: &Move,
    size: usize,
) -> Vec<(usize, Setting)> {
    let then = applied(shape, now, flat);
    let bodies = family.iter().filter(|group| shape.groups[**group].movable);
    let large = bodies.filter(|group| shape.leaf(&then, **group) > size);
    large.map(|group| (*group, Setting { leaf_size: Some(size), ..now[*group].clone() })).collect()
}

fn of_group(shape: &Shape, now: &Grouping, group: usize) -> Vec<Move> {
    let mut bounds: Vec<Bound> = KINDS.into_iter().map(Bound::Around).collect();
    if !shape.groups[group].movable {
        bounds.push(Bound::Above);
    }
    let set_bound = |bound: &Bound| set(now, [group].iter(), |setting| setting.bound = bound.clone());
    let mut moves: Vec<Move> = bounds.iter().map(set_bound).collect();
    let leaf = shape.leaf(now, group);
    let sizes = SIZES.into_iter().filter(|size| *size < leaf).map(Some);
    for size in sizes.chain([None]) {
        moves.push(set(now, [group].iter(), |setting| setting.leaf_size = size));
    }
    moves
}

/// A setting for some groups. Volumes of a kind registered by the host are left alone, because only the host
/// knows their purpose.
fn set<'g>(now: &Grouping, groups: impl Iterator<Item = &'g usize>, change: impl Fn(&mut Setting)) -> Move {
    let known = groups.filter(|group| !matches!(now[**group].bound, Bound::Around(BoundKind::Custom(_))));
    Move(
        known
            .map(|group| {
                let mut setting = now[*group].clone();
                change(&mut setting);
                (*group, setting)
            })
            .collect(),
    )
}
