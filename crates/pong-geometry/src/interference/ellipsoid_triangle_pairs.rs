//! Rejection of ellipsoid-triangle pairs, eight at a time.
//!
//! An ellipsoid near a surface overlaps the boxes of many triangles and touches few. A pair is rejected if
//! the ellipsoid lies entirely in front of or behind the triangle, or entirely outside of a plane through an
//! edge perpendicular to the triangle. It is also rejected if no feature of the triangle can push:
//!
//! * the face cannot push if the centre is in front of it, and both the centre and the foot (the deepest
//!   point after the ellipsoid is pushed out) lie beyond the same edge;
//! * an edge or a vertex outside the ellipsoid cannot push if the overlap of the face is too small for a
//!   second local minimum.
//!
//! The remaining pairs go one by one through
//! [`EllipsoidOnTriangles`](super::ellipsoid_triangle::EllipsoidOnTriangles). The rejection changes no
//! result: it makes the same comparisons with a larger margin, and NaN never rejects a pair.

use super::triangle_lanes::{
    EightVectors, NOTHING, TriangleLanes, bit_of_each, fill_in, fill_vectors_in, put,
};
use crate::Vec3;
use crate::primitive::{Ellipsoid, TriangleSet};
use crate::simd::{LANES, LaneBits, Numbers, Simd, Vectors, run_at_level};

/// Batch of up to eight ellipsoid-triangle pairs.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct EllipsoidTrianglePairs {
    lanes: TriangleLanes,
    /// Principal axes times semi-axes, m.
    widen: [EightVectors; 3],
    /// Reciprocal squares of the semi-axes, 1/m².
    shrink: EightVectors,
    /// Smallest and largest semi-axes, m.
    smallest: [f64; LANES],
    largest: [f64; LANES],
}

impl Default for EllipsoidTrianglePairs {
    fn default() -> Self {
        Self {
            lanes: TriangleLanes::NONE,
            widen: [NOTHING; 3],
            shrink: NOTHING,
            smallest: [0.0; LANES],
            largest: [0.0; LANES],
        }
    }
}

impl EllipsoidTrianglePairs {
    /// Returns the number of pairs in the batch.
    #[inline]
    pub fn count(&self) -> usize {
        self.lanes.count
    }

    /// Removes all pairs.
    #[inline]
    pub fn clear(&mut self) {
        self.lanes.count = 0;
    }

    /// Adds a pair to the batch, which may hold eight, and returns the lane of the pair. `thickness` is as in
    /// [`ellipsoid_triangle`](super::ellipsoid_triangle::ellipsoid_triangle).
    #[inline]
    pub fn add(&mut self, ellipsoid: &Ellipsoid, triangle: u32, thickness: f64) -> usize {
        let lane = self.lanes.add(&ellipsoid.center, triangle, thickness);
        let semi_axes = &ellipsoid.semi_axes;
        for axis in 0..3 {
            let (widen, shrink) = along(ellipsoid, axis);
            put(&mut self.widen[axis], lane, &widen);
            self.shrink[axis][lane] = shrink;
        }
        (self.smallest[lane], self.largest[lane]) = (semi_axes.min(), semi_axes.max());
        lane
    }

    /// Sets the ellipsoid for all pairs that [`push`](Self::push) adds afterwards. `thickness` is as in
    /// [`add`](Self::add). This is faster than `add` if several consecutive pairs have the same ellipsoid.
    #[inline(always)]
    pub fn begin_in<S: Simd>(&mut self, simd: S, ellipsoid: &Ellipsoid, thickness: f64) {
        let (lane, semi_axes) = (self.count(), &ellipsoid.semi_axes);
        for axis in 0..3 {
            let (widen, shrink) = along(ellipsoid, axis);
            fill_vectors_in(simd, &mut self.widen[axis], lane, &widen);
            fill_in(simd, &mut self.shrink[axis], lane, shrink);
        }
        fill_in(simd, &mut self.smallest, lane, semi_axes.min());
        fill_in(simd, &mut self.largest, lane, semi_axes.max());
        self.lanes.begin_in(simd, &ellipsoid.center, thickness);
    }

    /// Adds a pair of the current ellipsoid and a triangle to the batch, which may hold eight, and returns
    /// the lane of the pair.
    #[inline(always)]
    pub fn push(&mut self, triangle: u32) -> usize {
        self.lanes.push(triangle)
    }

    /// Returns the pairs that may touch, one bit per lane, and empties the batch. The triangles are in `set`.
    #[inline]
    pub fn take(&mut self, set: &TriangleSet) -> LaneBits {
        if self.lanes.count == 0 {
            return 0;
        }
        self.lanes.fetch(set);
        let near = may_touch(self);
        self.clear();
        near
    }
}

/// Returns a principal axis times its semi-axis, m, and the reciprocal square of the semi-axis, 1/m².
#[inline(always)]
fn along(ellipsoid: &Ellipsoid, axis: usize) -> (Vec3, f64) {
    let semi_axis = ellipsoid.semi_axes[axis];
    (ellipsoid.axes.column(axis) * semi_axis, 1.0 / (semi_axis * semi_axis))
}

fn may_touch(pairs: &EllipsoidTrianglePairs) -> LaneBits {
    run_at_level!(may_touch_in(pairs: EllipsoidTrianglePairs) -> LaneBits)
}

/// Distance beyond an edge, relative to the lengths involved, above which a point counts as beyond it. Far
/// above the tolerance of a foot.
const FAR_SLACK: f64 = 1e-9;
/// Amount by which a squared distance must exceed 1 to count as outside the unit ball: ten times the `SLACK`
/// of the test of a single pair (`misses_edge`).
const OUTSIDE_SLACK: f64 = 1e-5;
/// Additional amount, relative to the squared lengths involved, that covers rounding at distant corners.
const OUTSIDE_SHARE: f64 = 1e-12;

/// Ellipsoids, one per lane.
struct Ellipsoids<S: Simd> {
    widen: [Vectors<S>; 3],
    shrink: Vectors<S>,
    /// Squared largest semi-axes, m².
    largest_square: Numbers<S>,
}

impl<S: Simd> Ellipsoids<S> {
    /// Returns the scaled normals. Their lengths are the half widths times the lengths of the normals.
    #[inline(always)]
    fn widened(&self, normal: Vectors<S>) -> Vectors<S> {
        normal.dot_rows(self.widen)
    }

    /// Returns vectors in the metric in which the ellipsoids are the unit ball.
    #[inline(always)]
    fn shrunk(&self, vector: Vectors<S>) -> Vectors<S> {
        let (wide, shrink) = (self.widened(vector), self.shrink);
        Vectors { x: wide.x * shrink.x, y: wide.y * shrink.y, z: wide.z * shrink.z }
    }

    /// Returns the lanes in which the square of `product` certainly exceeds `reach_square`. `product` is
    /// `normal·arm`.
    #[inline(always)]
    fn exceeds(
        &self,
        product: Numbers<S>,
        reach_square: Numbers<S>,
        normal: Vectors<S>,
        arm: Vectors<S>,
    ) -> S::Mask {
        /// Margins far above rounding: `SLACK` relative to `reach_square`, `SMALL_SLACK` relative to the
        /// largest square that the product can have.
        const SLACK: f64 = 1e-9;
        const SMALL_SLACK: f64 = 1e-18;
        let most = normal.norm_squared() * (arm.norm_squared() + self.largest_square);
        let reach = reach_square * product.all(1.0 + SLACK) + most * product.all(SMALL_SLACK);
        reach.below(product * product)
    }
}

#[inline(always)]
fn load_three<S: Simd>(simd: S, [first, second, third]: &[EightVectors; 3]) -> [Vectors<S>; 3] {
    [Vectors::load(simd, first), Vectors::load(simd, second), Vectors::load(simd, third)]
}

/// Returns the sums of the absolute components.
#[inline(always)]
fn taxicab<S: Simd>(v: Vectors<S>) -> Numbers<S> {
    v.x.abs() + v.y.abs() + v.z.abs()
}

#[inline(always)]
fn may_touch_in<S: Simd>(simd: S, pairs: &EllipsoidTrianglePairs) -> LaneBits {
    let lanes = &pairs.lanes;
    let corners = load_three(simd, &lanes.corners);
    let center = Vectors::load(simd, &lanes.centers);
    let (smallest, largest) = (Numbers::load(simd, &pairs.smallest), Numbers::load(simd, &pairs.largest));
    let (widen, shrink) = (load_three(simd, &pairs.widen), Vectors::load(simd, &pairs.shrink));
    let ellipsoids = Ellipsoids { widen, shrink, largest_square: largest * largest };
    let edges = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
    let arms = [center - corners[0], center - corners[1], center - corners[2]];
    let normal = edges[0].cross(corners[2] - corners[0]);
    let normal_square = normal.norm_squared();
    let height = normal.dot(arms[0]);
    let zero = Numbers::splat(simd, 0.0);

    // A centre behind the face is pushed to the front as long as its distance is less than the thickness.
    let thickness = Numbers::load(simd, &lanes.thicknesses);
    let behind = Numbers::select(height.below(zero), thickness * thickness * normal_square, zero);
    let widened = ellipsoids.widened(normal);
    let widened_square = widened.norm_squared();
    let mut apart = simd.bits(ellipsoids.exceeds(height, widened_square.larger(behind), normal, arms[0]));

    // Upper bound of all lengths involved.
    let size = taxicab(arms[0]) + taxicab(edges[0]) + taxicab(edges[1]) + taxicab(center) + largest;
    let slack = size * size.all(FAR_SLACK);
    let (length, half_width) = (normal_square.sqrt(), widened_square.sqrt());
    let in_front = simd.bits((slack * length).below(height));
    // Upper bound of the overlap of the face, times the length of the normal. If the overlap is less than the
    // smallest radius of curvature, `smallest²/largest`, edges and vertices have one local minimum only.
    let overlap = (half_width - height + slack * length) * size.all(1.0 + OUTSIDE_SLACK);
    let one_minimum = simd.bits((overlap * largest).below(smallest * smallest * length));

    let starts = [ellipsoids.shrunk(arms[0]), ellipsoids.shrunk(arms[1]), ellipsoids.shrunk(arms[2])];
    let ends_slack = slack.over(smallest);
    let (mut face, mut features) = (LaneBits::MAX, 0);
    for k in 0..3 {
        let (edge, arm) = (edges[k], arms[k]);
        let outward = edge.cross(normal);
        let beyond = outward.dot(arm);
        let wide = ellipsoids.widened(outward);
        let is_apart = simd.bits(ellipsoids.exceeds(beyond, wide.norm_squared(), outward, arm));
        apart |= simd.bits(zero.below(beyond)) & is_apart;
        // Distances of the centre (`beyond`) and of the foot (`foot_beyond`) beyond the edge, times the
        // length of `outward`, and for the foot also times `half_width`.
        let room = slack * taxicab(outward);
        let foot_beyond = beyond * half_width - wide.dot(widened);
        let lost = simd.bits((room * half_width).below(foot_beyond)) & simd.bits(room.below(beyond));
        face &= !(in_front & lost);
        // In the unit-ball metric: vectors from the corner to the centre, and along the edge.
        let (start, along) = (starts[k], starts[k] - starts[(k + 1) % 3]);
        let share = start.dot(along).over(along.norm_squared()).larger(zero).smaller(zero.all(1.0));
        let start_square = start.norm_squared();
        let rounding = (start_square + along.norm_squared()) * zero.all(OUTSIDE_SHARE);
        let ball = zero.all(1.0 + OUTSIDE_SLACK) + ends_slack + rounding;
        let edge_outside = simd.bits(ball.below((start - along * share).norm_squared()));
        features |= bit_of_each(&lanes.may_push, k) & !(one_minimum & edge_outside);
        let vertex_outside = simd.bits(ball.below(start_square));
        features |= bit_of_each(&lanes.may_push, 3 + k) & !(one_minimum & vertex_outside);
    }
    lanes.used() & !apart & (face | features)
}
