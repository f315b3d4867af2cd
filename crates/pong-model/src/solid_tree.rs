//! Binary tree of boxes.

use crate::solid_box::SolidBox;
use pong_geometry::Vec3;

/// Binary tree over numbered items, each with a box. A node has the items of a range of `order`; the left child has
/// the first half of them, and follows its parent in `bounds`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SolidTree {
    order: Vec<u32>,
    bounds: Vec<SolidBox>,
}

/// Node of a [`SolidTree`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SolidNode {
    index: u32,
    first: u32,
    end: u32,
}

impl SolidTree {
    /// Creates the tree of some boxes; the items are their indices. Each node is divided at the median of the
    /// centres, along the axis along which they are spread most.
    pub fn new(boxes: &[SolidBox]) -> Self {
        let mut tree = Self { order: (0..boxes.len() as u32).collect(), bounds: Vec::new() };
        let Some(root) = tree.root() else { return tree };
        let none = SolidBox { center: Vec3::zeros(), half: Vec3::zeros() };
        tree.bounds = vec![none; 2 * boxes.len() - 1];
        let mut open = vec![root];
        while let Some(node) = open.pop() {
            let items = &mut tree.order[node.first as usize..node.end as usize];
            let start = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
            let corners =
                items.iter().map(|&item| &boxes[item as usize]).fold(start, |(low, high), bound| {
                    (low.inf(&(bound.center - bound.half)), high.sup(&(bound.center + bound.half)))
                });
            tree.bounds[node.index as usize] =
                SolidBox { center: 0.5 * (corners.0 + corners.1), half: 0.5 * (corners.1 - corners.0) };
            let (low, high) = items
                .iter()
                .map(|&item| boxes[item as usize].center)
                .fold(start, |(low, high), center| (low.inf(&center), high.sup(&center)));
            let axis = (high - low).imax();
            if let Some([left, right]) = node.halves() {
                let along = |item: &u32| boxes[*item as usize].center[axis];
                let middle = (right.first - node.first) as usize;
                items.select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
                open.extend([right, left]);
            }
        }
        tree
    }

    /// Number of items.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Returns `true` if there are no items.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// Root; `None` without items.
    pub fn root(&self) -> Option<SolidNode> {
        (!self.order.is_empty()).then_some(SolidNode { index: 0, first: 0, end: self.order.len() as u32 })
    }

    /// Box around the items of a node.
    pub fn bound(&self, node: &SolidNode) -> &SolidBox {
        &self.bounds[node.index as usize]
    }

    /// Item of a node without children.
    pub fn item(&self, node: &SolidNode) -> usize {
        self.order[node.first as usize] as usize
    }

    /// Adds the items whose boxes meet a box to `found`.
    pub fn meeting(&self, bound: &SolidBox, found: &mut Vec<u32>) {
        self.root().inspect(|root| self.meeting_below(root, bound, found));
    }

    /// Calls `found` once for each two items whose boxes meet.
    pub fn meeting_pairs(&self, found: &mut impl FnMut(u32, u32)) {
        self.root().inspect(|root| self.meeting_within(root, found));
    }

    fn meeting_within(&self, node: &SolidNode, found: &mut impl FnMut(u32, u32)) {
        let Some([left, right]) = node.halves() else { return };
        self.meeting_within(&left, found);
        self.meeting_within(&right, found);
        self.meeting_between([&left, &right], found);
    }

    fn meeting_between(&self, [a, b]: [&SolidNode; 2], found: &mut impl FnMut(u32, u32)) {
        let (bound_a, bound_b) = (self.bound(a), self.bound(b));
        if ((bound_a.center - bound_b.center).abs() - bound_a.half - bound_b.half).max() > 0.0 {
            return;
        }
        match (a.halves(), b.halves()) {
            (None, None) => found(self.order[a.first as usize], self.order[b.first as usize]),
            (Some(halves), of_b) if of_b.is_none() || a.end - a.first >= b.end - b.first => {
                halves.iter().for_each(|half| self.meeting_between([half, b], found));
            }
            (_, Some(halves)) => halves.iter().for_each(|half| self.meeting_between([a, half], found)),
            (Some(_), None) => {}
        }
    }

    fn meeting_below(&self, node: &SolidNode, bound: &SolidBox, found: &mut Vec<u32>) {
        let own = self.bound(node);
        if ((own.center - bound.center).abs() - own.half - bound.half).max() > 0.0 {
            return;
        }
        match node.halves() {
            Some(halves) => halves.iter().for_each(|half| self.meeting_below(half, bound, found)),
            None => found.push(self.order[node.first as usize]),
        }
    }
}

impl SolidNode {
    /// Children; `None` for a node of one item.
    #[inline]
    pub fn halves(&self) -> Option<[Self; 2]> {
        let Self { index, first, end } = *self;
        let count = end - first;
        let middle = first + count / 2;
        (count > 1).then_some([
            Self { index: index + 1, first, end: middle },
            // The left child has 2·(middle − first) − 1 nodes.
            Self { index: index + 2 * (middle - first), first: middle, end },
        ])
    }
}
