//! Top-down construction of a box tree. Bottom nodes are filled with eight elements; the levels above have as
//! few boxes per node as the number of levels allows, evenly distributed.

use super::{BoxNode, BoxTree, ELEMENT, NarrowBox, NarrowBoxes, WIDTH};
use pong_geometry::Vec3;

/// Element during construction, with its box, m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Boxed<T> {
    pub item: T,
    pub low: Vec3,
    pub high: Vec3,
}

impl<T> Boxed<T> {
    /// Returns `true` if the box is finite.
    pub fn is_bounded(&self) -> bool {
        self.low.iter().chain(self.high.iter()).all(|x| x.is_finite())
    }

    /// Twice the coordinate of the centre along an axis, m; 0 if the box is infinite on either side.
    fn center(&self, axis: usize) -> f64 {
        let (low, high) = (self.low[axis], self.high[axis]);
        if low.is_finite() && high.is_finite() { low + high } else { 0.0 }
    }
}

impl BoxTree {
    /// Builds the tree of the elements and sorts the elements into its order. An unbounded element makes
    /// every box above it unbounded, so unbounded elements belong in a tree of their own.
    pub(crate) fn build<T: Copy + Ord>(elements: &mut [Boxed<T>]) -> Self {
        let mut tree = Self {
            origin: middle(elements),
            nodes: Vec::new(),
            around: NarrowBox::NOTHING,
            is_bounded: false,
            levels: 0,
        };
        if !elements.is_empty() {
            let bottoms = elements.len().div_ceil(WIDTH);
            tree.nodes.reserve_exact(bottoms + bottoms / 2 + 2);
            tree.levels = levels_above(bottoms);
            tree.around = tree.add_node(elements, 0, tree.levels).1;
            tree.nodes.shrink_to_fit();
            let mut bounds = tree.around.low.iter().chain(&tree.around.high);
            tree.is_bounded = bounds.all(|bound| bound.abs() < f32::MAX);
        }
        tree
    }

    /// Adds the node of some elements and all nodes below; returns its index and its box.
    fn add_node<T: Copy + Ord>(
        &mut self,
        elements: &mut [Boxed<T>],
        first: usize,
        levels: u32,
    ) -> (u32, NarrowBox) {
        let index = self.nodes.len();
        let range = first as u32..(first + elements.len()) as u32;
        self.nodes.push(BoxNode::empty(range));
        let mut around = NarrowBox::NOTHING;
        if levels == 0 {
            elements.sort_unstable_by_key(|element| element.item);
            for (lane, element) in elements.iter().enumerate() {
                let one = self.narrowed(&element.low, &element.high);
                self.nodes[index].set(lane, &one, ELEMENT | (first + lane) as u32);
                around = around.join(&one);
            }
            return (index as u32, around);
        }
        let parts = root_up(elements.len().div_ceil(WIDTH), levels);
        let mut lane = 0;
        deal(elements, (parts, WIDTH.pow(levels - 1)), &mut |part, start| {
            let (child, one) = self.add_node(part, first + start, levels - 1);
            self.nodes[index].set(lane, &one, child);
            around = around.join(&one);
            lane += 1;
        });
        (index as u32, around)
    }
}

/// Number of levels above `bottoms` bottom nodes.
fn levels_above(bottoms: usize) -> u32 {
    let mut levels = 0;
    while WIDTH.pow(levels) < bottoms {
        levels += 1;
    }
    levels
}

/// Smallest number of boxes per node for which `levels` levels suffice above `bottoms` bottom nodes.
fn root_up(bottoms: usize, levels: u32) -> usize {
    (1..).find(|width: &usize| width.pow(levels) >= bottoms).expect("numbers do not end")
}

/// Splits elements into `parts` parts with nearly equal numbers of bottom nodes, at most `most` each. The
/// elements are halved repeatedly, across the axis along which their centres extend farthest. Calls `take`
/// with each part and the index of its first element.
fn deal<T: Copy + Ord>(
    elements: &mut [Boxed<T>],
    (parts, most): (usize, usize),
    take: &mut dyn FnMut(&mut [Boxed<T>], usize),
) {
    deal_from(elements, (parts, most), 0, take);
}

/// Number of bottom nodes per part from which parts begin at multiples of eight bottom nodes, if the limit
/// `most` allows it. Eight chunks that are tested together then belong to the same part.
const WHOLE_GROUPS_FROM: usize = 2 * WIDTH;

fn deal_from<T: Copy + Ord>(
    elements: &mut [Boxed<T>],
    (parts, most): (usize, usize),
    start: usize,
    take: &mut dyn FnMut(&mut [Boxed<T>], usize),
) {
    if parts == 1 {
        return take(elements, start);
    }
    let bottoms = elements.len().div_ceil(WIDTH);
    let (left_parts, right_parts) = (parts / 2, parts - parts / 2);
    let mut left_bottoms = bottoms / parts * left_parts + (bottoms % parts).min(left_parts);
    if bottoms / parts >= WHOLE_GROUPS_FROM {
        let nearest = (left_bottoms + WIDTH / 2) / WIDTH * WIDTH;
        if nearest <= left_parts * most && bottoms - nearest <= right_parts * most {
            left_bottoms = nearest;
        }
    }
    let middle = left_bottoms * WIDTH;
    let axis = longest_axis(elements);
    elements.select_nth_unstable_by(middle, |a, b| {
        a.center(axis).total_cmp(&b.center(axis)).then(a.item.cmp(&b.item))
    });
    let (left, right) = elements.split_at_mut(middle);
    deal_from(left, (left_parts, most), start, take);
    deal_from(right, (right_parts, most), start + middle, take);
}

fn longest_axis<T>(elements: &[Boxed<T>]) -> usize {
    let center = |element: &Boxed<T>| Vec3::from([0, 1, 2].map(|axis| element.center(axis)));
    let first = center(&elements[0]);
    let span = |(low, high): (Vec3, Vec3), element: &Boxed<T>| {
        (low.inf(&center(element)), high.sup(&center(element)))
    };
    let (low, high) = elements.iter().fold((first, first), span);
    (high - low).imax()
}

/// Centre of the box around all finite boxes, m; the origin if there are none.
fn middle<T>(elements: &[Boxed<T>]) -> Vec3 {
    let mut bounded = elements.iter().filter(|element| element.is_bounded()).map(|e| (e.low, e.high));
    let Some(first) = bounded.next() else { return Vec3::zeros() };
    let (low, high) = bounded.fold(first, |(low, high), (l, h)| (low.inf(&l), high.sup(&h)));
    0.5 * (low + high)
}

impl BoxNode {
    fn empty(elements: std::ops::Range<u32>) -> Self {
        Self { boxes: NarrowBoxes::NOTHING, children: [0; WIDTH], elements }
    }

    fn set(&mut self, lane: usize, one: &NarrowBox, child: u32) {
        self.boxes.set(lane, one);
        self.children[lane] = child;
    }
}
