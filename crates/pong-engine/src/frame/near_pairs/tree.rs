//! Tree that finds overlapping boxes. A node splits its boxes into two halves along the axis on which their
//! centres spread most.

use super::swept::Bounds;

/// Maximum boxes per leaf.
const LEAF: usize = 8;

/// Node of the tree. Its first child follows it in the list of nodes; `second` is the index of the other
/// child.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// Range of its boxes in `order`.
    first: u32,
    end: u32,
    /// Index of its second child; zero for a leaf.
    second: u32,
}

/// The tree, with its memory.
pub(super) struct BoundsTree {
    /// Indices of the bounded boxes, in tree order.
    order: Vec<u32>,
    nodes: Vec<Node>,
    /// Indices of the boxes that are not finite.
    unbounded: Vec<u32>,
}

/// Callback for the indices of two overlapping boxes.
type Found<'f> = dyn FnMut(usize, usize) + 'f;

/// Reports the boxes of `others` that overlap the box `one`.
fn report<'o>(one: u32, others: impl IntoIterator<Item = &'o u32>, boxes: &[Bounds], found: &mut Found<'_>) {
    for &other in others {
        if boxes[one as usize].overlap(&boxes[other as usize]) {
            found(one as usize, other as usize);
        }
    }
}

impl BoundsTree {
    /// Memory per box, bytes.
    pub const BYTES_EACH: usize = 2 * size_of::<u32>() + size_of::<Node>();

    /// Allocates room for this many boxes.
    pub fn with_capacity(boxes: usize) -> Self {
        Self {
            order: Vec::with_capacity(boxes),
            // Only nodes with more than `LEAF` boxes are split, so a leaf has at least `LEAF`/2 boxes.
            nodes: Vec::with_capacity(boxes + 1),
            unbounded: Vec::with_capacity(boxes),
        }
    }

    /// Calls `found` once for each two boxes that are not certainly disjoint, in no particular order. Only
    /// the boxes with the indices `numbers` take part.
    pub fn overlaps(&mut self, numbers: &[usize], boxes: &[Bounds], found: &mut Found<'_>) {
        self.order.clear();
        self.nodes.clear();
        self.unbounded.clear();
        for &number in numbers {
            let list = if boxes[number].is_finite() { &mut self.order } else { &mut self.unbounded };
            list.push(number as u32);
        }
        for (place, &one) in self.unbounded.iter().enumerate() {
            report(one, self.order.iter().chain(&self.unbounded[place + 1..]), boxes, found);
        }
        if !self.order.is_empty() {
            self.build(0, self.order.len(), boxes);
            self.within(0, boxes, found);
        }
    }

    /// Appends the node of a range of boxes, and all nodes below it.
    fn build(&mut self, first: usize, end: usize, boxes: &[Bounds]) {
        let own = &self.order[first..end];
        let bounds = own.iter().fold(Bounds::nothing(), |all, &one| all.merge(&boxes[one as usize]));
        let node = self.nodes.len();
        self.nodes.push(Node { bounds, first: first as u32, end: end as u32, second: 0 });
        if end - first <= LEAF {
            return;
        }
        // Twice the centre; only its order matters.
        let middle =
            |one: u32, axis: usize| boxes[one as usize].low_w[axis] + boxes[one as usize].high_w[axis];
        let spread = |axis: usize| {
            let middles = own.iter().map(|&one| middle(one, axis));
            let (least, most) = middles
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
            most - least
        };
        let spreads = [spread(0), spread(1), spread(2)];
        let axis = (0..3).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b])).unwrap_or(0);
        let half = (end - first) / 2;
        self.order[first..end]
            .select_nth_unstable_by(half, |&a, &b| middle(a, axis).total_cmp(&middle(b, axis)));
        self.build(first, first + half, boxes);
        self.nodes[node].second = self.nodes.len() as u32;
        self.build(first + half, end, boxes);
    }

    fn places(&self, node: &Node) -> &[u32] {
        &self.order[node.first as usize..node.end as usize]
    }

    /// Reports overlaps among the boxes below one node.
    fn within(&self, index: u32, boxes: &[Bounds], found: &mut Found<'_>) {
        let node = &self.nodes[index as usize];
        if node.second != 0 {
            self.within(index + 1, boxes, found);
            self.within(node.second, boxes, found);
            return self.between(index + 1, node.second, boxes, found);
        }
        let own = self.places(node);
        for (place, &one) in own.iter().enumerate() {
            report(one, &own[place + 1..], boxes, found);
        }
    }

    /// Reports overlaps between the boxes below two nodes.
    fn between(&self, a: u32, b: u32, boxes: &[Bounds], found: &mut Found<'_>) {
        let (node_a, node_b) = (&self.nodes[a as usize], &self.nodes[b as usize]);
        if !node_a.bounds.overlap(&node_b.bounds) {
            return;
        }
        if node_a.second == 0 && node_b.second == 0 {
            let reaches_b = |one: &&u32| boxes[**one as usize].overlap(&node_b.bounds);
            for &one in self.places(node_a).iter().filter(reaches_b) {
                report(one, self.places(node_b), boxes, found);
            }
            return;
        }
        // Descend into the node with more boxes.
        let opens_a = node_b.second == 0
            || (node_a.second != 0 && node_a.end - node_a.first >= node_b.end - node_b.first);
        if opens_a {
            self.between(a + 1, b, boxes, found);
            self.between(node_a.second, b, boxes, found);
        } else {
            self.between(a, b + 1, boxes, found);
            self.between(a, node_b.second, boxes, found);
        }
    }
}
