//! Tree of boxes around the elements of a leaf, eight boxes to a node. It finds the elements that a given box
//! may touch.
//!
//! Boxes are stored in single precision relative to the tree's origin, rounded outward. A larger box may cost
//! a test that finds nothing, but never changes a result. Eight boxes are compared at once. The eight
//! elements of a bottom node are transformed and tested together by the engine.

mod build;
pub(crate) use build::Boxed;

use pong_geometry::Vec3;
use pong_geometry::simd::{EightBoxes, LANES, LaneBits, Simd};
use std::ops::Range;

/// Boxes per node.
pub const WIDTH: usize = LANES;

/// Flag in [`BoxNode::children`]: the child is an element, not a node.
const ELEMENT: u32 = 1 << 31;

/// Box in single precision; empty if `low > high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NarrowBox {
    /// Minimum coordinates relative to the tree's origin, m.
    pub low: [f32; 3],
    /// Maximum coordinates relative to the tree's origin, m.
    pub high: [f32; 3],
}

/// Sphere in single precision, relative to the tree's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NarrowBall {
    center: [f32; 3],
    /// Squared radius, m²; infinite if the sphere is outside the range in which single precision can decide.
    square: f32,
}

/// Eight boxes as coordinate arrays; unused ones are empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NarrowBoxes {
    /// Minimum coordinates by axis relative to the tree's origin, then the maximum ones, m.
    pub bounds: EightBoxes,
}

/// Up to eight boxes, each around a child node or an element.
// Four cache lines; no group of eight bounds crosses a cache line.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct BoxNode {
    /// Boxes.
    pub boxes: NarrowBoxes,
    children: [u32; WIDTH],
    /// Elements below, consecutive in the tree's order.
    pub elements: Range<u32>,
}

/// Contents of one box of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Child {
    /// Child node, by index.
    Node(u32),
    /// Element, by its index in the tree's order.
    Element(u32),
}

/// Tree of boxes.
#[derive(Clone, Debug)]
pub struct BoxTree {
    /// Origin subtracted from coordinates before they are rounded to single precision, m.
    pub origin: Vec3,
    /// Nodes; node 0 is the root, unless there is no element.
    pub nodes: Vec<BoxNode>,
    /// Box around everything.
    pub around: NarrowBox,
    /// True if every element is bounded in all directions.
    pub is_bounded: bool,
    /// Levels of nodes above the bottom nodes, which are all at the same depth.
    pub levels: u32,
}

impl NarrowBox {
    /// Box that contains all space.
    pub const EVERYTHING: Self = Self { low: [-f32::MAX; 3], high: [f32::MAX; 3] };
    /// Empty box, disjoint from every other box.
    pub const NOTHING: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// Box between two corners given relative to the tree's origin, rounded outward.
    #[inline]
    pub fn outward(low: &Vec3, high: &Vec3) -> Self {
        Self {
            low: [round_down(low.x), round_down(low.y), round_down(low.z)],
            high: [round_up(high.x), round_up(high.y), round_up(high.z)],
        }
    }

    /// Returns `true` if two boxes with the same origin overlap.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        !(0..3).any(|k| self.low[k] > other.high[k] || self.high[k] < other.low[k])
    }

    /// Smallest box around both boxes.
    #[inline]
    pub fn join(&self, other: &Self) -> Self {
        Self {
            low: [0, 1, 2].map(|k| self.low[k].min(other.low[k])),
            high: [0, 1, 2].map(|k| self.high[k].max(other.high[k])),
        }
    }
}

impl NarrowBall {
    /// Sphere about a centre given relative to the tree's origin, enlarged for rounding.
    #[inline]
    fn outward(center: &Vec3, radius: f64) -> Self {
        /// Size of the coordinates above which a sphere counts as near everything, because their squares
        /// could overflow.
        const FAR: f64 = 1e18;
        /// Relative margin above the rounding of a coordinate, of a distance and of its square.
        const ROOM: f64 = 8.0 * f32::EPSILON as f64;
        let size = center.x.abs() + center.y.abs() + center.z.abs();
        let wide = (radius + ROOM * size) * (1.0 + ROOM);
        let square = if size < FAR { wide * wide + f64::from(f32::MIN_POSITIVE) } else { f64::INFINITY };
        Self { center: [center.x as f32, center.y as f32, center.z as f32], square: square as f32 }
    }

    /// Returns `true` if the sphere can exclude a box.
    #[inline]
    pub fn is_bounded(&self) -> bool {
        self.square < f32::INFINITY
    }
}

/// Finite single-precision number that is not greater than `x`. A number below the range, or NaN, becomes the
/// least finite number: no upper bound is less, so such a box is never taken for disjoint.
#[inline(always)]
#[allow(clippy::manual_clamp, reason = "NaN becomes the least finite number")]
pub fn round_down(x: f64) -> f32 {
    const MOST: f64 = f32::MAX as f64;
    // Without this limit, +∞ would become ∞ − ∞, which is NaN.
    let x = if x > MOST { MOST } else { x };
    // Less than `x` by more than one single-precision unit in the last place; the constant term covers an
    // underflow of the product.
    let below = x - (x.abs() * (1.01 * f64::from(f32::EPSILON)) + f64::from(f32::MIN_POSITIVE));
    below.max(-MOST).min(MOST) as f32
}

/// Finite single-precision number that is not less than `x`. A number above the range, or NaN, becomes the
/// greatest finite number.
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

/// Lanes whose bits are set, in order.
#[inline(always)]
pub fn lanes(mut bits: LaneBits) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        bits &= bits.wrapping_sub(1);
        (lane < WIDTH).then_some(lane)
    })
}

impl NarrowBoxes {
    /// Eight empty boxes.
    pub const NOTHING: Self = Self { bounds: [[[f32::INFINITY; WIDTH]; 3], [[f32::NEG_INFINITY; WIDTH]; 3]] };

    /// Eight boxes that contain all space.
    pub const EVERYTHING: Self = Self { bounds: [[[-f32::MAX; WIDTH]; 3], [[f32::MAX; WIDTH]; 3]] };

    /// Returns the boxes that overlap `query`.
    #[inline(always)]
    pub fn met_by<S: Simd>(&self, simd: S, query: &NarrowBox) -> LaneBits {
        simd.boxes_met(&self.bounds, &query.low, &query.high)
    }

    /// Returns the boxes that a sphere may reach. Only an unbounded sphere reaches empty boxes.
    #[inline(always)]
    pub fn near<S: Simd>(&self, simd: S, ball: &NarrowBall) -> LaneBits {
        simd.boxes_near(&self.bounds, &ball.center, ball.square)
    }

    /// Box around all eight boxes.
    #[inline(always)]
    pub fn around(&self) -> NarrowBox {
        let [low, high] = &self.bounds;
        NarrowBox {
            low: [least(&low[0]), least(&low[1]), least(&low[2])],
            high: [greatest(&high[0]), greatest(&high[1]), greatest(&high[2])],
        }
    }

    /// Box of one lane.
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
    /// Contents of the box in a lane.
    #[inline]
    pub fn child(&self, lane: usize) -> Child {
        let child = self.children[lane];
        if child & ELEMENT != 0 { Child::Element(child & !ELEMENT) } else { Child::Node(child) }
    }

    /// Child nodes in the boxes whose bits are set, in order, moved to the front; the remaining lanes have no
    /// meaning. Not for a bottom node, whose boxes contain elements.
    #[inline(always)]
    pub fn nodes_in<S: Simd>(&self, simd: S, boxes: LaneBits) -> [u32; WIDTH] {
        simd.packed(&self.children, boxes)
    }

    /// Elements in the boxes whose bits are set, in order, moved to the front; the remaining lanes have no
    /// meaning. Only for a bottom node.
    #[inline(always)]
    pub fn elements_in<S: Simd>(&self, simd: S, boxes: LaneBits) -> [u32; WIDTH] {
        simd.packed(&self.children, boxes).map(|child| child & !ELEMENT)
    }

    /// Returns `true` for a bottom node, whose boxes are around single elements.
    #[inline]
    pub fn is_bottom(&self) -> bool {
        self.children[0] & ELEMENT != 0
    }

    /// Contents of all boxes that are not empty.
    pub fn children(&self) -> impl Iterator<Item = Child> + '_ {
        let [low, high] = &self.boxes.bounds;
        let used = move |&lane: &usize| low[0][lane] <= high[0][lane];
        (0..WIDTH).filter(used).map(|lane| self.child(lane))
    }
}

impl BoxTree {
    /// Converts a box given in the group frame, m, to single precision relative to the tree's origin, rounded
    /// outward.
    #[inline]
    pub fn narrowed(&self, low: &Vec3, high: &Vec3) -> NarrowBox {
        NarrowBox::outward(&(low - self.origin), &(high - self.origin))
    }

    /// Converts a sphere given in the group frame, m, to single precision relative to the tree's origin,
    /// enlarged for rounding.
    #[inline]
    pub fn narrowed_ball(&self, center: &Vec3, radius: f64) -> NarrowBall {
        NarrowBall::outward(&(center - self.origin), radius)
    }

    /// Box of an element in the group frame, m; infinite where the element's box is unbounded.
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

    /// Converts a box of this tree to the group frame, m; infinite where the tree's box is unbounded.
    pub fn widened(&self, narrow: &NarrowBox) -> (Vec3, Vec3) {
        let wide = |x: f32, beyond: f64| if x.abs() < f32::MAX { f64::from(x) } else { beyond };
        let low = Vec3::from(narrow.low.map(|x| wide(x, f64::NEG_INFINITY)));
        let high = Vec3::from(narrow.high.map(|x| wide(x, f64::INFINITY)));
        (self.origin + low, self.origin + high)
    }

    /// Calls `visit` with every bottom node that has boxes overlapping the query, and with the bits of these
    /// boxes. Returns the number of nodes compared with the query.
    #[inline(always)]
    pub fn visit<S: Simd>(
        &self,
        simd: S,
        query: &NarrowBox,
        mut visit: impl FnMut(&BoxNode, LaneBits),
    ) -> u32 {
        /// Limit of the stack: a tree of 2³¹ elements has eleven levels, and each level adds at most seven
        /// waiting nodes.
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
