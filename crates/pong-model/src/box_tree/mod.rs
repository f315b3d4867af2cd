//! A tree of boxes around the elements of a leaf, eight to a node, for one question: which of them may a given box
//! touch?
//!
//! Boxes are kept in single precision around an origin of the tree's own, rounded outward. A coarser box costs a
//! test that finds nothing; it can never change an answer. Eight boxes are compared at once, and eight elements of
//! a leaf share one bottom node: what the engine carries into another frame and tests together.

mod build;
pub(crate) use build::Boxed;

use pong_geometry::Vec3;
use pong_geometry::simd::{EightBoxes, LANES, LaneBits, Simd};
use std::ops::Range;

/// Boxes of one node.
pub const WIDTH: usize = LANES;

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

/// A ball in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NarrowBall {
    center: [f32; 3],
    /// Infinite where the ball is beyond what single precision tells apart.
    square: f32,
}

/// Eight boxes, coordinate by coordinate; unused ones are empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NarrowBoxes {
    /// Least coordinates by axis less the tree's origin, then the greatest, m.
    pub bounds: EightBoxes,
}

/// Up to eight boxes, each around a child node or an element.
// Four cache lines, and no eight bounds span two of them.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
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
    /// Whether every element has a bound in each direction.
    pub is_bounded: bool,
    /// Levels of nodes above the bottom nodes, which are all at the same depth.
    pub levels: u32,
}

impl NarrowBox {
    /// All space.
    pub const EVERYTHING: Self = Self { low: [-f32::MAX; 3], high: [f32::MAX; 3] };
    /// No place at all: beyond every other box.
    pub const NOTHING: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// The box between two corners given from the tree's origin, rounded outward.
    #[inline]
    pub fn outward(low: &Vec3, high: &Vec3) -> Self {
        Self {
            low: [round_down(low.x), round_down(low.y), round_down(low.z)],
            high: [round_up(high.x), round_up(high.y), round_up(high.z)],
        }
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

impl NarrowBall {
    /// The ball about a place given from the tree's origin, with room for rounding.
    #[inline]
    fn outward(center: &Vec3, radius: f64) -> Self {
        /// Places farther than this are near everything: their squares do not fit.
        const FAR: f64 = 1e18;
        /// More than the rounding of a place, and of a distance and its square.
        const ROOM: f64 = 8.0 * f32::EPSILON as f64;
        let size = center.x.abs() + center.y.abs() + center.z.abs();
        let wide = (radius + ROOM * size) * (1.0 + ROOM);
        let square = if size < FAR { wide * wide + f64::from(f32::MIN_POSITIVE) } else { f64::INFINITY };
        Self { center: [center.x as f32, center.y as f32, center.z as f32], square: square as f32 }
    }

    /// Whether anything is beyond it.
    #[inline]
    pub fn is_bounded(&self) -> bool {
        self.square < f32::INFINITY
    }
}

/// A finite number of single precision that is not greater. What lies below them all, and what is no number, becomes the
/// least: every upper bound is at least as great, so two boxes are not taken for apart.
#[inline(always)]
#[allow(clippy::manual_clamp, reason = "of what is no number this makes the least")]
pub fn round_down(x: f64) -> f32 {
    const MOST: f64 = f32::MAX as f64;
    // Infinity would be taken from itself.
    let x = if x > MOST { MOST } else { x };
    // In double precision: more than a unit in the last place below, also where the product underflows.
    let below = x - (x.abs() * (1.01 * f64::from(f32::EPSILON)) + f64::from(f32::MIN_POSITIVE));
    below.max(-MOST).min(MOST) as f32
}

/// A finite number of single precision that is not smaller, likewise.
#[inline]
pub fn round_up(x: f64) -> f32 {
    -round_down(-x)
}

#[inline(always)]
fn least(x: &[f32; WIDTH]) -> f32 {
    let pick = |a: f32, b: f32| if a < b { a } else { b };
    let four = [pick(x[0], x[4]), pick(x[1], x[5]), pick(x[2], x[6]), pick(x[3], x[7])];
    pick(pick(four[0], four[2]), pick(four[1], four[3]))
}

#[inline(always)]
fn greatest(x: &[f32; WIDTH]) -> f32 {
    let pick = |a: f32, b: f32| if a > b { a } else { b };
    let four = [pick(x[0], x[4]), pick(x[1], x[5]), pick(x[2], x[6]), pick(x[3], x[7])];
    pick(pick(four[0], four[2]), pick(four[1], four[3]))
}

/// The lanes whose bits are set, in order.
#[inline(always)]
pub fn lanes(mut bits: LaneBits) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        bits &= bits.wrapping_sub(1);
        (lane < WIDTH).then_some(lane)
    })
}

impl NarrowBoxes {
    /// No place at all.
    pub const NOTHING: Self = Self { bounds: [[[f32::INFINITY; WIDTH]; 3], [[f32::NEG_INFINITY; WIDTH]; 3]] };

    /// Eight times all space.
    pub const EVERYTHING: Self = Self { bounds: [[[-f32::MAX; WIDTH]; 3], [[f32::MAX; WIDTH]; 3]] };

    /// Which of the boxes a box meets.
    #[inline(always)]
    pub fn met_by<S: Simd>(&self, simd: S, query: &NarrowBox) -> LaneBits {
        simd.boxes_met(&self.bounds, &query.low, &query.high)
    }

    /// Which of the boxes a ball may reach. Only one that is not bounded reaches empty boxes.
    #[inline(always)]
    pub fn near<S: Simd>(&self, simd: S, ball: &NarrowBall) -> LaneBits {
        simd.boxes_near(&self.bounds, &ball.center, ball.square)
    }

    /// The box around all of them.
    #[inline(always)]
    pub fn around(&self) -> NarrowBox {
        let [low, high] = &self.bounds;
        NarrowBox {
            low: [least(&low[0]), least(&low[1]), least(&low[2])],
            high: [greatest(&high[0]), greatest(&high[1]), greatest(&high[2])],
        }
    }

    /// One of the boxes.
    #[inline]
    pub fn lane(&self, lane: usize) -> NarrowBox {
        let [low, high] = &self.bounds;
        NarrowBox {
            low: [low[0][lane], low[1][lane], low[2][lane]],
            high: [high[0][lane], high[1][lane], high[2][lane]],
        }
    }

    fn set(&mut self, lane: usize, one: &NarrowBox) {
        for k in 0..3 {
            self.bounds[0][k][lane] = one.low[k];
            self.bounds[1][k][lane] = one.high[k];
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

    /// The nodes in some of the boxes, in the boxes' order, from the first place on; what follows them has no meaning. Not for a
    /// bottom node.
    #[inline(always)]
    pub fn nodes_in<S: Simd>(&self, simd: S, boxes: LaneBits) -> [u32; WIDTH] {
        simd.packed(&self.children, boxes)
    }

    /// The places of the elements in some of the boxes of a bottom node, likewise.
    #[inline(always)]
    pub fn elements_in<S: Simd>(&self, simd: S, boxes: LaneBits) -> [u32; WIDTH] {
        simd.packed(&self.children, boxes).map(|child| child & !ELEMENT)
    }

    /// Whether the boxes are those of elements: of all that are below, in their order.
    #[inline]
    pub fn is_bottom(&self) -> bool {
        self.children[0] & ELEMENT != 0
    }

    /// What the boxes hold.
    pub fn children(&self) -> impl Iterator<Item = Child> + '_ {
        let [low, high] = &self.boxes.bounds;
        let used = move |&lane: &usize| low[0][lane] <= high[0][lane];
        (0..WIDTH).filter(used).map(|lane| self.child(lane))
    }
}

impl BoxTree {
    /// A box of the movable group's frame, as this tree sees it.
    #[inline]
    pub fn narrowed(&self, low: &Vec3, high: &Vec3) -> NarrowBox {
        NarrowBox::outward(&(low - self.origin), &(high - self.origin))
    }

    /// A ball of the movable group's frame, as this tree sees it.
    #[inline]
    pub fn narrowed_ball(&self, center: &Vec3, radius: f64) -> NarrowBall {
        NarrowBall::outward(&(center - self.origin), radius)
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
    pub fn visit<S: Simd>(
        &self,
        simd: S,
        query: &NarrowBox,
        mut visit: impl FnMut(&BoxNode, LaneBits),
    ) -> u32 {
        /// A tree of 2³¹ elements has eleven levels; each leaves at most seven nodes waiting.
        const DEPTH_MAX: usize = 80;
        let mut stack = [0_u32; DEPTH_MAX];
        let mut waiting = usize::from(!self.nodes.is_empty());
        let mut looked_at = 0;
        while waiting > 0 {
            waiting -= 1;
            let node = &self.nodes[stack[waiting] as usize];
            let met = node.boxes.met_by(simd, query);
            looked_at += 1;
            if met == 0 {
                continue;
            }
            if node.is_bottom() {
                visit(node, met);
                continue;
            }
            for lane in lanes(met) {
                stack[waiting] = node.children[lane];
                waiting += 1;
            }
        }
        looked_at
    }
}

#[cfg(test)]
mod tests;
