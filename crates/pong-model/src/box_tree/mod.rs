//! A tree of boxes around the elements of a leaf, eight to a node, for one question: which of them may a given box
//! touch?
//!
//! Boxes are kept in single precision around an origin of the tree's own, rounded outward. A coarser box costs a
//! test that finds nothing; it can never change an answer. Eight boxes are compared at once, and eight elements of
//! a leaf share one bottom node: what the engine carries into another frame and tests together.

mod build;
pub(crate) use build::Boxed;

use pong_geometry::Vec3;
use std::ops::Range;

/// Boxes of one node.
pub const WIDTH: usize = 8;

/// In [`BoxNode::children`]: the child is an element, not a node.
const ELEMENT: u32 = 1 << 31;

/// A box in single precision; empty where `low > high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NarrowBox {
    /// Least coordinates less the tree's origin, m.
    pub low: [f32; 3],
    /// Greatest coordinates less the tree's origin, m.
    pub high: [f32; 3],
}

/// Eight boxes, coordinate by coordinate; unused ones are empty.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct NarrowBoxes {
    /// Least coordinates by axis less the tree's origin, m.
    pub low: [[f32; WIDTH]; 3],
    /// Greatest coordinates by axis less the tree's origin, m.
    pub high: [[f32; WIDTH]; 3],
}

/// Up to eight boxes, each around a child node or an element.
#[derive(Clone, Debug)]
pub struct BoxNode {
    /// The boxes.
    pub boxes: NarrowBoxes,
    children: [u32; WIDTH],
    /// The elements below, consecutive in the tree's order.
    pub elements: Range<u32>,
}

/// What a box of a node holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Child {
    /// Another node, by index.
    Node(u32),
    /// An element, by its place in the tree's order.
    Element(u32),
}

/// The tree.
#[derive(Clone, Debug)]
pub struct BoxTree {
    /// Subtracted from coordinates before they are rounded to single precision, m.
    pub origin: Vec3,
    /// Node 0 is the root, unless there is no element.
    pub nodes: Vec<BoxNode>,
    /// The box around everything.
    pub around: NarrowBox,
}

impl NarrowBox {
    /// All space.
    pub const EVERYTHING: Self = Self { low: [-f32::MAX; 3], high: [f32::MAX; 3] };
    /// No place at all: beyond every other box.
    pub const NOTHING: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// The box between two corners given from the tree's origin, rounded outward.
    #[inline]
    pub fn outward(low: &Vec3, high: &Vec3) -> Self {
        Self { low: [0, 1, 2].map(|k| round_down(low[k])), high: [0, 1, 2].map(|k| round_up(high[k])) }
    }

    /// Whether two boxes around the same origin share a place.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        !(0..3).any(|k| self.low[k] > other.high[k] || self.high[k] < other.low[k])
    }

    /// The box around both.
    #[inline]
    pub fn join(&self, other: &Self) -> Self {
        Self {
            low: [0, 1, 2].map(|k| self.low[k].min(other.low[k])),
            high: [0, 1, 2].map(|k| self.high[k].max(other.high[k])),
        }
    }
}

/// A finite number of single precision that is not greater. What lies below them all becomes the least: every upper
/// bound is at least as great, so two boxes are not taken for apart.
#[inline]
pub fn round_down(x: f64) -> f32 {
    let nearest = (x as f32).min(f32::MAX);
    // At least one unit in the last place below, also where the product underflows.
    (nearest - nearest.abs() * (1.01 * f32::EPSILON) - f32::MIN_POSITIVE).max(-f32::MAX)
}

/// A finite number of single precision that is not smaller, likewise.
#[inline]
pub fn round_up(x: f64) -> f32 {
    -round_down(-x)
}

/// One byte per box of a node, 1 where it was met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Met(u64);

impl Met {
    /// From one byte per box: 0 or 1.
    #[inline]
    pub fn new(bytes: [u8; WIDTH]) -> Self {
        Self(u64::from_le_bytes(bytes))
    }

    /// Whether no box was met.
    #[inline]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many boxes were met.
    #[inline]
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }

    /// Those whose bit is set as well, the lowest bit for the first box.
    #[inline]
    pub fn only(self, bits: u8) -> Self {
        // Bit i moves to byte i: copies of the bits into all bytes, one bit of each kept, and brought down.
        let spread = (u64::from(bits) * 0x0101_0101_0101_0101) & 0x8040_2010_0804_0201;
        let bytes = ((spread + 0x7f7f_7f7f_7f7f_7f7f) | spread) >> 7 & 0x0101_0101_0101_0101;
        Self(self.0 & bytes)
    }
}

impl Iterator for Met {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let lane = self.0.trailing_zeros() as usize / 8;
        self.0 &= self.0 - 1;
        Some(lane)
    }
}

impl NarrowBoxes {
    /// No place at all.
    pub const NOTHING: Self =
        Self { low: [[f32::INFINITY; WIDTH]; 3], high: [[f32::NEG_INFINITY; WIDTH]; 3] };

    /// Which of the boxes a box meets.
    #[inline(always)]
    pub fn met_by(&self, query: &NarrowBox) -> Met {
        let mut bytes = [0_u8; WIDTH];
        for (i, byte) in bytes.iter_mut().enumerate() {
            let apart = (self.low[0][i] > query.high[0])
                | (self.high[0][i] < query.low[0])
                | (self.low[1][i] > query.high[1])
                | (self.high[1][i] < query.low[1])
                | (self.low[2][i] > query.high[2])
                | (self.high[2][i] < query.low[2]);
            *byte = u8::from(!apart);
        }
        Met::new(bytes)
    }

    /// One of the boxes.
    #[inline]
    pub fn lane(&self, lane: usize) -> NarrowBox {
        NarrowBox { low: [0, 1, 2].map(|k| self.low[k][lane]), high: [0, 1, 2].map(|k| self.high[k][lane]) }
    }

    fn set(&mut self, lane: usize, one: &NarrowBox) {
        for k in 0..3 {
            self.low[k][lane] = one.low[k];
            self.high[k][lane] = one.high[k];
        }
    }
}

impl BoxNode {
    /// What a box holds.
    #[inline]
    pub fn child(&self, lane: usize) -> Child {
        let child = self.children[lane];
        if child & ELEMENT != 0 { Child::Element(child & !ELEMENT) } else { Child::Node(child) }
    }

    /// Whether the boxes are those of elements.
    #[inline]
    pub fn is_bottom(&self) -> bool {
        self.children[0] & ELEMENT != 0
    }

    /// What the boxes hold.
    pub fn children(&self) -> impl Iterator<Item = Child> + '_ {
        let used = |&lane: &usize| self.boxes.low[0][lane] <= self.boxes.high[0][lane];
        (0..WIDTH).filter(used).map(|lane| self.child(lane))
    }
}

impl BoxTree {
    /// A box of the movable group's frame, as this tree sees it.
    #[inline]
    pub fn narrowed(&self, low: &Vec3, high: &Vec3) -> NarrowBox {
        NarrowBox::outward(&(low - self.origin), &(high - self.origin))
    }

    /// The box of an element in the movable group's frame, m; infinite where the element is unbounded.
    pub fn bounds(&self, element: u32) -> (Vec3, Vec3) {
        let (mut node, mut lane) = (&self.nodes[0], 0);
        loop {
            let holds = |child: Child| match child {
                Child::Element(place) => place == element,
                Child::Node(below) => self.nodes[below as usize].elements.contains(&element),
            };
            lane = node.children().position(holds).unwrap_or(lane);
            match node.child(lane) {
                Child::Node(below) => node = &self.nodes[below as usize],
                Child::Element(_) => break,
            }
        }
        self.widened(&node.boxes.lane(lane))
    }

    /// A box of this tree in the movable group's frame, m.
    pub fn widened(&self, narrow: &NarrowBox) -> (Vec3, Vec3) {
        let wide = |x: f32, beyond: f64| if x.abs() < f32::MAX { f64::from(x) } else { beyond };
        let low = Vec3::from(narrow.low.map(|x| wide(x, f64::NEG_INFINITY)));
        let high = Vec3::from(narrow.high.map(|x| wide(x, f64::INFINITY)));
        (self.origin + low, self.origin + high)
    }

    /// Calls `visit` with every bottom node that has boxes which a box meets; answers how many nodes were looked
    /// at.
    #[inline(always)]
    pub fn visit(&self, query: &NarrowBox, mut visit: impl FnMut(&BoxNode, Met)) -> u32 {
        /// A tree of 2³¹ elements has eleven levels; each leaves at most seven nodes waiting.
        const DEPTH_MAX: usize = 80;
        let mut stack = [0_u32; DEPTH_MAX];
        let mut waiting = usize::from(!self.nodes.is_empty());
        let mut looked_at = 0;
        while waiting > 0 {
            waiting -= 1;
            let node = &self.nodes[stack[waiting] as usize];
            let met = node.boxes.met_by(query);
            looked_at += 1;
            if met.is_empty() {
                continue;
            }
            if node.is_bottom() {
                visit(node, met);
                continue;
            }
            for lane in met {
                stack[waiting] = node.children[lane];
                waiting += 1;
            }
        }
        looked_at
    }
}

#[cfg(test)]
mod tests;
