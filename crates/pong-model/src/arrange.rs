//! Conversion of authored groups into the groups of the tree: a group without its own volume passes its
//! contents to the group above, and leaves with a size limit are split.

use crate::draft::GroupDraft;
use crate::element::Element;
use crate::model::{Item, MovableGroup};
use pong_geometry::Vec3;
use pong_geometry::bounding::BoundKind;
use std::sync::Arc;

/// Groups of a movable group's tree; 0 is the movable one.
pub(crate) fn arranged(body: &MovableGroup, authored: &[GroupDraft]) -> Vec<GroupDraft> {
    let mut groups = Vec::with_capacity(authored.len());
    arrange(body, authored, 0, &mut groups);
    groups
}

/// Groups whose leaf size has no effect, because they have no leaf.
pub(crate) fn without_leaf(authored: &[GroupDraft]) -> Vec<usize> {
    let has_leaf = |index: usize| !authored[index].above && !contents(authored, index).0.is_empty();
    (0..authored.len()).filter(|&index| authored[index].leaf_size.is_some() && !has_leaf(index)).collect()
}

/// Adds a group and everything below it; returns its index.
fn arrange(
    body: &MovableGroup,
    authored: &[GroupDraft],
    index: usize,
    groups: &mut Vec<GroupDraft>,
) -> usize {
    let from = &authored[index];
    let (items, children) = contents(authored, index);
    groups.push(GroupDraft { at: from.at, bound: from.bound.clone(), ..GroupDraft::new(&from.path) });
    let place = groups.len() - 1;
    if !items.is_empty() {
        // A node holds either other nodes or elements.
        let leaf = if children.is_empty() { place } else { push(groups, place) };
        match from.leaf_size {
            Some(most) => cut(body, items, most, leaf, groups),
            None => groups[leaf].items = items,
        }
    }
    for child in children {
        let child = arrange(body, authored, child, groups);
        groups[place].children.push(child);
    }
    place
}

/// Contents of a group: its elements and those of groups below without a volume, and the groups below with a
/// volume.
fn contents(authored: &[GroupDraft], index: usize) -> (Vec<Item>, Vec<usize>) {
    let mut items = authored[index].items.clone();
    let mut children = Vec::new();
    for &child in &authored[index].children {
        if authored[child].above {
            let (more, below) = contents(authored, child);
            items.extend(more);
            children.extend(below);
        } else {
            children.push(child);
        }
    }
    (items, children)
}

/// Adds an empty group below another, with the same kind of volume.
pub(crate) fn push(groups: &mut Vec<GroupDraft>, above: usize) -> usize {
    let GroupDraft { at, bound, .. } = &groups[above];
    let child = GroupDraft { at: *at, bound: bound.clone(), ..GroupDraft::new(&groups[above].path) };
    groups.push(child);
    let index = groups.len() - 1;
    groups[above].children.push(index);
    index
}

/// Adds items to a group in leaves of at most `most` items; unbounded items get a leaf of their own.
pub(crate) fn cut(
    body: &MovableGroup,
    items: Vec<Item>,
    most: usize,
    into: usize,
    groups: &mut Vec<GroupDraft>,
) {
    let (bounded, unbounded): (Vec<Item>, Vec<Item>) =
        items.into_iter().partition(|item| center(body, *item).is_some());
    match (bounded.is_empty(), unbounded.is_empty()) {
        (_, true) => halve(body, bounded, most, into, groups),
        (true, _) => groups[into].items = unbounded,
        _ => {
            let child = push(groups, into);
            halve(body, bounded, most, child, groups);
            let child = push(groups, into);
            groups[child].items = unbounded;
        }
    }
}

/// Adds bounded items to a group. If there are more than `most`, splits them into halves, for two groups
/// below it.
fn halve(body: &MovableGroup, mut items: Vec<Item>, most: usize, into: usize, groups: &mut Vec<GroupDraft>) {
    if items.len() <= most {
        groups[into].items = items;
        return;
    }
    let centers: Vec<Vec3> = items.iter().filter_map(|item| center(body, *item)).collect();
    let Some(first) = centers.first() else { return };
    let (low, high) = centers.iter().fold((*first, *first), |(low, high), c| (low.inf(c), high.sup(c)));
    let axis = (high - low).imax();
    let along = |item: &Item| center(body, *item).map_or(0.0, |center| center[axis]);
    // Ties keep the order of the items, so the tree is reproducible.
    items.sort_by(|a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
    let rest = items.split_off(items.len() / 2);
    for half in [items, rest] {
        let child = push(groups, into);
        halve(body, half, most, child, groups);
    }
}

/// Centre of an element's box, m; `None` if it is unbounded.
fn center(body: &MovableGroup, item: Item) -> Option<Vec3> {
    let (low, high) = Element::new(body, item).extent();
    let is_bounded = low.iter().chain(&high).all(|x| x.is_finite());
    is_bounded.then(|| 0.5 * (low + high))
}

impl GroupDraft {
    /// Empty group bounded by a box.
    pub(crate) fn new(path: &Arc<str>) -> Self {
        Self {
            path: Arc::clone(path),
            at: 0,
            bound: BoundKind::Aabb,
            above: false,
            leaf_size: None,
            children: Vec::new(),
            items: Vec::new(),
        }
    }
}
