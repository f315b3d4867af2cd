//! Tree of bounding volumes of a movable group: the authored groups, each with a volume of its kind. The
//! elements of a leaf lie in batches, one per kind, each with a [`BoxTree`] of its own.

use crate::box_tree::{BoxTree, Boxed};
use crate::draft::GroupDraft;
use crate::element::Element;
use crate::extensions::Extensions;
use crate::model::{Batch, ChunkBoxes, Item, MovableGroup, Node, SegmentLanes, SphereLanes, Tree};
use pong_geometry::Vec3;
use pong_geometry::bounding::{BoundKind, Bounded, Volume, fit, fit_aabb_bounds};
use pong_geometry::primitive::PrimitiveKind;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Number of shapes above which a volume is not fitted to all of them.
const MANY: usize = 512;

/// Group whose volume cannot be fitted: its index and the reason.
pub(crate) type FitFault = (usize, String);

/// Node under construction, whose children are indices into the drafts.
struct DraftNode {
    volume: Volume,
    children: Vec<usize>,
    items: Vec<Item>,
    group: Arc<str>,
}

struct Builder<'b> {
    body: &'b MovableGroup,
    groups: &'b [GroupDraft],
    ext: &'b Extensions,
    nodes: Vec<DraftNode>,
    faults: Vec<FitFault>,
}

/// Builds the tree of a movable group whose elements are complete. Returns the faults if a volume cannot be
/// fitted.
pub(crate) fn build(
    body: &MovableGroup,
    groups: &[GroupDraft],
    ext: &Extensions,
) -> Result<Tree, Vec<FitFault>> {
    let mut builder = Builder { body, groups, ext, nodes: Vec::new(), faults: Vec::new() };
    let root = match builder.group(0) {
        Some((root, _)) => root,
        None => builder.nothing(),
    };
    if builder.faults.is_empty() { Ok(flatten(body, builder.nodes, root)) } else { Err(builder.faults) }
}

impl Builder<'_> {
    /// Adds an empty leaf, for a movable group without geometry of its own.
    fn nothing(&mut self) -> usize {
        let group = Arc::clone(&self.groups[0].path);
        let volume = Volume::Aabb { center: Vec3::zeros(), half: Vec3::zeros() };
        self.push(DraftNode { volume, children: Vec::new(), items: Vec::new(), group })
    }

    fn push(&mut self, node: DraftNode) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Adds the node of a group, and returns it with all items below it; `None` if there are none.
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
        let items = group.items.clone();
        let node = self.push(DraftNode { volume, children, items, group: Arc::clone(&group.path) });
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

    /// Volume fitted around the items. If there are many, the outermost alone determine the centre of a
    /// sphere or the axes of an oriented box; all of them determine the size.
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

    fn boxed(&self, items: &[Item]) -> Vec<Boxed<Item>> {
        items.iter().map(|&item| boxed(self.body, item)).collect()
    }
}

fn boxed(body: &MovableGroup, item: Item) -> Boxed<Item> {
    let (low, high) = Element::new(body, item).extent();
    Boxed { item, low, high }
}

/// Adds the batches of a leaf to the tree: its elements by kind, unbounded ones in batches of their own. Each
/// batch is in the order of its box tree.
fn batches(body: &MovableGroup, items: &[Item], tree: &mut Tree) {
    let mut by_kind: BTreeMap<(PrimitiveKind, bool), Vec<Boxed<Item>>> = BTreeMap::new();
    for &item in items {
        let kind = body.primitives[item.primitive as usize].kind;
        let boxed = boxed(body, item);
        by_kind.entry((kind, !boxed.is_bounded())).or_default().push(with_margin(boxed));
    }
    for ((kind, _), mut elements) in by_kind {
        let boxes = BoxTree::build(&mut elements);
        let first = tree.items.len() as u32;
        tree.items.extend(elements.iter().map(|element| element.item));
        let items = first..tree.items.len() as u32;
        let spheres = SphereLanes::of(body, kind, &tree.items[first as usize..]);
        let segments = SegmentLanes::of(body, kind, &tree.items[first as usize..]);
        let never_a =
            matches!(kind, PrimitiveKind::Triangle | PrimitiveKind::Polyhedron | PrimitiveKind::Plane);
        let chunks = if never_a { Vec::new() } else { ChunkBoxes::of(&boxes) };
        tree.batches.push(Batch { kind, items, boxes, chunks, spheres, segments });
    }
}

/// Adds the margin of a fitted volume to a box; an unbounded box becomes infinite in all directions.
fn with_margin(boxed: Boxed<Item>) -> Boxed<Item> {
    // Tested first, because an infinite box has no centre.
    if boxed.is_bounded()
        && let Volume::Aabb { center, half } = fit_aabb_bounds(boxed.low, boxed.high)
    {
        return Boxed { low: center - half, high: center + half, ..boxed };
    }
    let infinite = Vec3::repeat(f64::INFINITY);
    Boxed { low: -infinite, high: infinite, ..boxed }
}

/// Items that are outermost in one of 26 directions, or all items if one is unbounded or NaN.
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

/// Box around all boxes; `None` if one is unbounded or NaN.
fn box_around(boxed: &[Boxed<Item>]) -> Option<Volume> {
    if !boxed.iter().all(Boxed::is_bounded) {
        return None;
    }
    let (first, rest) = boxed.split_first()?;
    let join = |(low, high): (Vec3, Vec3), b: &Boxed<Item>| (low.inf(&b.low), high.sup(&b.high));
    let (low, high) = rest.iter().fold((first.low, first.high), join);
    Some(fit_aabb_bounds(low, high))
}

/// Converts the drafts to an array in breadth-first order, so that the children of a node are contiguous.
fn flatten(body: &MovableGroup, mut drafts: Vec<DraftNode>, root: usize) -> Tree {
    let mut order = vec![root];
    let mut tree = Tree::default();
    let mut next = 0;
    while next < order.len() {
        let draft = &mut drafts[order[next]];
        let first_child = order.len() as u32;
        let (first_item, first_batch) = (tree.items.len() as u32, tree.batches.len() as u32);
        order.append(&mut draft.children);
        batches(body, &draft.items, &mut tree);
        tree.nodes.push(Node {
            volume: draft.volume.clone(),
            children: first_child..order.len() as u32,
            items: first_item..tree.items.len() as u32,
            batches: first_batch..tree.batches.len() as u32,
            group: Arc::clone(&draft.group),
        });
        next += 1;
    }
    tree
}
