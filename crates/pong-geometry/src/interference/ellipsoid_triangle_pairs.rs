//! Pairs of an ellipsoid and a triangle, eight at a time: which of them may touch at all.
//!
//! An ellipsoid near a surface meets the boxes of many triangles and touches few. Most of the others are told by products
//! and three roots: wholly beyond the plane of the face or a plane through an edge across it; or with nothing that may
//! push:
//!
//! * the face does not where the foot of the deepest point lies beyond an edge that the centre, in front, lies beyond too;
//! * an edge does not that lies outside the ellipsoid, nor a vertex, as long as the face is too shallow for a second minimum.
//!
//! What is left goes through [`EllipsoidOnTriangles`](super::ellipsoid_triangle::EllipsoidOnTriangles) one by one. Nothing
//! here decides an answer: every comparison asks what is asked there, with more room for rounding, and a number that is none
//! tells nothing.

use super::triangle_lanes::{
    EightVectors, NOTHING, TriangleLanes, bit_of_each, fill_in, fill_vectors_in, put,
};
use crate::Vec3;
use crate::primitive::{Ellipsoid, TriangleSet};
use crate::simd::{LANES, LaneBits, Numbers, Simd, Vectors, run_at_level};

/// Up to eight pairs.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct EllipsoidTrianglePairs {
    lanes: TriangleLanes,
    /// Principal axes times semi-axes.
    widen: [EightVectors; 3],
    /// One over the squares of the semi-axes, 1/m².
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
    /// How many pairs there are.
    #[inline]
    pub fn count(&self) -> usize {
        self.lanes.count
    }

    /// Forgets all pairs.
    #[inline]
    pub fn clear(&mut self) {
        self.lanes.count = 0;
    }

    /// Adds a pair, of which there may be eight; answers its place. `thickness` as in
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

    /// Makes the pairs that are pushed from here on those of an ellipsoid; `thickness` as in [`add`](Self::add). Where several
    /// triangles in a row meet one ellipsoid, that is quicker.
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

    /// Adds a pair of what was begun with last, of which there may be eight; answers its place.
    #[inline(always)]
    pub fn push(&mut self, triangle: u32) -> usize {
        self.lanes.push(triangle)
    }

    /// Tells which pairs may touch, a bit for each in their order, whose triangles are of a set; then there are none.
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

/// What is kept of a principal axis: it times its semi-axis, m, and one over the square of that, 1/m².
#[inline(always)]
fn along(ellipsoid: &Ellipsoid, axis: usize) -> (Vec3, f64) {
    let semi_axis = ellipsoid.semi_axes[axis];
    (ellipsoid.axes.column(axis) * semi_axis, 1.0 / (semi_axis * semi_axis))
}

fn may_touch(pairs: &EllipsoidTrianglePairs) -> LaneBits {
    run_at_level!(may_touch_in(pairs: EllipsoidTrianglePairs) -> LaneBits)
}

/// What is called beyond, as a share of the lengths involved: far more than rounding, and than the slack of a foot.
const FAR_SLACK: f64 = 1e-9;
/// By how much a square of a distance exceeds that of the unit ball before it is outside: ten times what one edge takes.
const OUTSIDE_SLACK: f64 = 1e-5;
/// The same as a share of the squares of what is measured from: rounding in far corners.
const OUTSIDE_SHARE: f64 = 1e-12;

/// Ellipsoids.
struct Ellipsoids<S: Simd> {
    widen: [Vectors<S>; 3],
    shrink: Vectors<S>,
    /// Squares of the largest semi-axes.
    largest_square: Numbers<S>,
}

impl<S: Simd> Ellipsoids<S> {
    /// Scaled normals, whose lengths are the half widths times those of the normals.
    #[inline(always)]
    fn widened(&self, normal: Vectors<S>) -> Vectors<S> {
        normal.dot_rows(self.widen)
    }

    /// Vectors as seen where the ellipsoids are unit balls.
    #[inline(always)]
    fn shrunk(&self, vector: Vectors<S>) -> Vectors<S> {
        let (wide, shrink) = (self.widened(vector), self.shrink);
        Vectors { x: wide.x * shrink.x, y: wide.y * shrink.y, z: wide.z * shrink.z }
    }

    /// Where a product of a normal with an arm certainly exceeds a reach, whatever rounding does to either.
    #[inline(always)]
    fn exceeds(
        &self,
        product: Numbers<S>,
        reach_square: Numbers<S>,
        normal: Vectors<S>,
        arm: Vectors<S>,
    ) -> S::Mask {
        /// Both far beyond rounding: for products and reaches that are as large as the vectors allow, and for the rest.
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

/// Sums of the sizes of the components.
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

    // Behind, an ellipsoid is pushed to the front from as deep as the surface is thick.
    let thickness = Numbers::load(simd, &lanes.thicknesses);
    let behind = Numbers::select(height.below(zero), thickness * thickness * normal_square, zero);
    let widened = ellipsoids.widened(normal);
    let widened_square = widened.norm_squared();
    let mut apart = simd.bits(ellipsoids.exceeds(height, widened_square.larger(behind), normal, arms[0]));

    // At least as long as anything that is measured.
    let size = taxicab(arms[0]) + taxicab(edges[0]) + taxicab(edges[1]) + taxicab(center) + largest;
    let slack = size * size.all(FAR_SLACK);
    let (length, half_width) = (normal_square.sqrt(), widened_square.sqrt());
    let in_front = simd.bits((slack * length).below(height));
    // The overlap of the face, and of what a second minimum is at least, both times the length of the normal.
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
        // How far the centre, and the foot of the deepest point, lie beyond the edge.
        let room = slack * taxicab(outward);
        let foot_beyond = beyond * half_width - wide.dot(widened);
        let lost = simd.bits((room * half_width).below(foot_beyond)) & simd.bits(room.below(beyond));
        face &= !(in_front & lost);
        // Towards the centre of the unit ball.
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
