//! The tree of bounding volumes of a body: the authored groups, with large leaves split further.
//!
//! Volumes of authored groups are fitted in the kind that the group names. A leaf with more than
//! [`LARGE_LEAF`] elements is halved along the longest side until at most [`SMALL_LEAF`] are left; the parts of
//! spheres are spheres, all others boxes along the axes, found from the bottom up.

use crate::draft::GroupDraft;
use crate::element::Element;
use crate::model::{Body, Item, Node, Tree};
use pong_geometry::Vec3;
use pong_geometry::bounding::{BoundKind, Bounded, Volume, fit, fit_aabb_bounds};
use pong_geometry::extension::Extensions;
use std::sync::Arc;

const LARGE_LEAF: usize = 16;
const SMALL_LEAF: usize = 8;
/// More things than this are not fitted one and all.
const MANY: usize = 512;

/// A group whose volume cannot be fitted: its index and the reason.
pub(crate) type FitFault = (usize, String);

/// A node on its way: children by index among the drafts.
struct DraftNode {
    volume: Volume,
    children: Vec<usize>,
    items: Vec<Item>,
    group: Arc<str>,
}

/// An element with its box.
#[derive(Clone, Copy)]
struct Boxed {
    item: Item,
    low: Vec3,
    high: Vec3,
}

struct Builder<'b> {
    body: &'b Body,
    groups: &'b [GroupDraft],
    ext: &'b Extensions,
    nodes: Vec<DraftNode>,
    faults: Vec<FitFault>,
}

/// Builds the tree of a body whose elements are all in place.
pub(crate) fn build(body: &Body, groups: &[GroupDraft], ext: &Extensions) -> Result<Tree, Vec<FitFault>> {
    let mut builder = Builder { body, groups, ext, nodes: Vec::new(), faults: Vec::new() };
    let root = match builder.group(0) {
        Some((root, _)) => root,
        None => builder.nothing(),
    };
    if builder.faults.is_empty() { Ok(flatten(builder.nodes, root)) } else { Err(builder.faults) }
}

impl Builder<'_> {
    /// A body without geometry of its own: a leaf that holds nothing.
    fn nothing(&mut self) -> usize {
        let group = Arc::clone(&self.groups[0].path);
        let volume = Volume::Aabb { center: Vec3::zeros(), half: Vec3::zeros() };
        self.push(DraftNode { volume, children: Vec::new(), items: Vec::new(), group })
    }

    fn push(&mut self, node: DraftNode) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// The node of a group and all items below it; `None` if there are none.
    fn group(&mut self, index: usize) -> Option<(usize, Vec<Item>)> {
        let groups = self.groups;
        let group = &groups[index];
        let mut below = group.items.clone();
        let mut children = Vec::new();
        for &child in &group.children {
            if let Some((node, items)) = self.group(child) {
                children.push(node);
                below.extend(items);
            }
        }
        if below.is_empty() {
            return None;
        }
        let volume = self.authored_volume(index, &below);
        let node = if group.items.is_empty() {
            self.push(DraftNode { volume, children, items: Vec::new(), group: Arc::clone(&group.path) })
        } else {
            self.leaf(group, volume)
        };
        Some((node, below))
    }

    fn authored_volume(&mut self, index: usize, items: &[Item]) -> Volume {
        let kind = &self.groups[index].bound;
        if *kind == BoundKind::Aabb
            && let Some(volume) = box_around(&self.boxed(items))
        {
            return volume;
        }
        self.fitted_around_many(kind, items).unwrap_or_else(|reason| {
            self.faults.push((index, reason));
            Volume::Unbounded
        })
    }

    fn fitted(&self, kind: &BoundKind, items: &[Item]) -> Result<Volume, String> {
        let elements: Vec<Element<'_>> = items.iter().map(|&item| Element::new(self.body, item)).collect();
        let things: Vec<&dyn Bounded> = elements.iter().map(|element| element as &dyn Bounded).collect();
        fit(kind, &things, self.ext)
    }

    /// A fitted volume; of many things only the outermost choose where it stands, and all of them how large it
    /// is.
    fn fitted_around_many(&self, kind: &BoundKind, items: &[Item]) -> Result<Volume, String> {
        if items.len() <= MANY || matches!(kind, BoundKind::Custom(_)) {
            return self.fitted(kind, items);
        }
        let elements: Vec<Element<'_>> = items.iter().map(|&item| Element::new(self.body, item)).collect();
        let most = |direction: &Vec3| elements.iter().map(|e| e.support(direction)).fold(f64::MIN, f64::max);
        Ok(match self.fitted(kind, &outermost(&elements, items))? {
            Volume::Sphere { center, .. } => {
                let radius = elements.iter().map(|e| e.farthest(&center)).fold(0.0, f64::max);
                Volume::Sphere { center, radius }.inflated()
            }
            Volume::Obb { axes, .. } => {
                let along = |axis: usize| axes.column(axis).into_owned();
                let high = Vec3::from([0, 1, 2].map(|axis| most(&along(axis))));
                let low = Vec3::from([0, 1, 2].map(|axis| -most(&-along(axis))));
                let (center, half) = (axes * (0.5 * (low + high)), 0.5 * (high - low));
                Volume::Obb { center, axes, half }.inflated()
            }
            other => other,
        })
    }

    fn boxed(&self, items: &[Item]) -> Vec<Boxed> {
        let boxed = |&item: &Item| {
            let (low, high) = Element::new(self.body, item).extent();
            Boxed { item, low, high }
        };
        items.iter().map(boxed).collect()
    }

    /// A leaf as authored, or the top of what it is split into.
    fn leaf(&mut self, group: &GroupDraft, volume: Volume) -> usize {
        let path = &group.path;
        if group.items.len() <= LARGE_LEAF {
            let items = group.items.clone();
            return self.push(DraftNode { volume, children: Vec::new(), items, group: Arc::clone(path) });
        }
        let (mut bounded, endless): (Vec<_>, Vec<_>) =
            self.boxed(&group.items).into_iter().partition(Boxed::is_bounded);
        let kind = if group.bound == BoundKind::Sphere { BoundKind::Sphere } else { BoundKind::Aabb };
        let mut children = Vec::new();
        if !endless.is_empty() {
            let items = endless.iter().map(|boxed| boxed.item).collect();
            let volume = Volume::Unbounded;
            children.push(self.push(DraftNode {
                volume,
                children: Vec::new(),
                items,
                group: Arc::clone(path),
            }));
        }
        if !bounded.is_empty() {
            let split = self.split(&mut bounded, &kind, path).0;
            if endless.is_empty() {
                // The authored volume replaces that of the part which holds everything.
                self.nodes[split].volume = volume;
                return split;
            }
            children.push(split);
        }
        self.push(DraftNode { volume, children, items: Vec::new(), group: Arc::clone(path) })
    }

    /// Halves at the median of the longest side; also returns the box of all.
    fn split(&mut self, boxed: &mut [Boxed], kind: &BoundKind, path: &Arc<str>) -> (usize, Vec3, Vec3) {
        if boxed.len() <= SMALL_LEAF {
            boxed.sort_unstable_by_key(|b| (b.item.primitive, b.item.element));
            let (low, high) = extent(boxed);
            let items: Vec<Item> = boxed.iter().map(|b| b.item).collect();
            let volume = self.part_volume(kind, boxed, low, high);
            let node = self.push(DraftNode { volume, children: Vec::new(), items, group: Arc::clone(path) });
            return (node, low, high);
        }
        let axis = longest_axis(boxed);
        let middle = boxed.len() / 2;
        boxed.select_nth_unstable_by(middle, |a, b| {
            let order = a.center(axis).total_cmp(&b.center(axis));
            order.then((a.item.primitive, a.item.element).cmp(&(b.item.primitive, b.item.element)))
        });
        let (left, right) = boxed.split_at_mut(middle);
        let (left, low_l, high_l) = self.split(left, kind, path);
        let (right, low_r, high_r) = self.split(right, kind, path);
        let (low, high) = (low_l.inf(&low_r), high_l.sup(&high_r));
        let volume = self.part_volume(kind, boxed, low, high);
        let children = vec![left, right];
        let node = self.push(DraftNode { volume, children, items: Vec::new(), group: Arc::clone(path) });
        (node, low, high)
    }

    /// Parts are many: a ball stands where the box does, with the least radius there.
    fn part_volume(&self, kind: &BoundKind, boxed: &[Boxed], low: Vec3, high: Vec3) -> Volume {
        if *kind == BoundKind::Aabb {
            return fit_aabb_bounds(low, high);
        }
        let center = 0.5 * (low + high);
        let farthest = |b: &Boxed| Element::new(self.body, b.item).farthest(&center);
        let radius = boxed.iter().map(farthest).fold(0.0, f64::max);
        Volume::Sphere { center, radius }.inflated()
    }
}

impl Boxed {
    fn is_bounded(&self) -> bool {
        self.low.iter().chain(self.high.iter()).all(|x| x.is_finite())
    }

    /// Twice the centre.
    fn center(&self, axis: usize) -> f64 {
        self.low[axis] + self.high[axis]
    }
}

/// The items that lie outermost in any of 26 directions, or all if one of them is unbounded or no number.
fn outermost(elements: &[Element<'_>], items: &[Item]) -> Vec<Item> {
    let mut found = Vec::new();
    for code in 0..27_u32 {
        let sign = |place: u32| f64::from(code / place % 3) - 1.0;
        let direction = Vec3::new(sign(1), sign(3), sign(9));
        if direction == Vec3::zeros() {
            continue;
        }
        let unit = direction.normalize();
        let mut best = (f64::NEG_INFINITY, 0);
        for (index, element) in elements.iter().enumerate() {
            let support = element.support(&unit);
            if !support.is_finite() {
                return items.to_vec();
            }
            if support > best.0 {
                best = (support, index);
            }
        }
        found.push(items[best.1]);
    }
    found
}

fn extent(boxed: &[Boxed]) -> (Vec3, Vec3) {
    let (first, rest) = (boxed[0], &boxed[1..]);
    rest.iter().fold((first.low, first.high), |(low, high), b| (low.inf(&b.low), high.sup(&b.high)))
}

/// `None` if anything is unbounded, or not a number.
fn box_around(boxed: &[Boxed]) -> Option<Volume> {
    if !boxed.iter().all(Boxed::is_bounded) {
        return None;
    }
    let (low, high) = extent(boxed);
    Some(fit_aabb_bounds(low, high))
}

fn longest_axis(boxed: &[Boxed]) -> usize {
    let center = |b: &Boxed| b.low + b.high;
    let first = center(&boxed[0]);
    let span = |(low, high): (Vec3, Vec3), b: &Boxed| (low.inf(&center(b)), high.sup(&center(b)));
    let (low, high) = boxed.iter().fold((first, first), span);
    (high - low).imax()
}

/// Breadth first, so that the children of a node lie side by side.
fn flatten(mut drafts: Vec<DraftNode>, root: usize) -> Tree {
    let mut order = vec![root];
    let mut tree = Tree::default();
    let mut next = 0;
    while next < order.len() {
        let draft = &mut drafts[order[next]];
        let first_child = order.len() as u32;
        let first_item = tree.items.len() as u32;
        order.append(&mut draft.children);
        tree.items.append(&mut draft.items);
        tree.nodes.push(Node {
            volume: draft.volume.clone(),
            children: first_child..order.len() as u32,
            items: first_item..tree.items.len() as u32,
            group: Arc::clone(&draft.group),
        });
        next += 1;
    }
    tree
}
