//! Pairs of an ellipsoid and a triangle, eight at a time: which of them may touch at all.
//!
//! An ellipsoid near a surface meets the boxes of many triangles and touches few. Most of the others lie wholly beyond the
//! plane of the face, or beyond a plane through an edge across it, which products alone tell: of a plane's normal of any
//! length the half width is the length of the scaled normal. What is left goes through
//! [`EllipsoidOnTriangles`](super::ellipsoid_triangle::EllipsoidOnTriangles) one by one. Nothing here decides an answer:
//! every comparison leaves room for rounding, and a number that is none tells nothing.

use super::triangle_lanes::{EightVectors, NOTHING, put, put_corners};
use crate::primitive::{Ellipsoid, TriangleSet};
use crate::simd::{LANES, LaneBits, Numbers, Simd, Vectors, run_at_level};

/// Up to eight pairs.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct EllipsoidTrianglePairs {
    corners: [EightVectors; 3],
    centers: EightVectors,
    /// Principal axes times semi-axes.
    widen: [EightVectors; 3],
    /// Largest semi-axes, m.
    largest: [f64; LANES],
    thicknesses: [f64; LANES],
    count: usize,
}

impl Default for EllipsoidTrianglePairs {
    fn default() -> Self {
        Self {
            corners: [NOTHING; 3],
            centers: NOTHING,
            widen: [NOTHING; 3],
            largest: [0.0; LANES],
            thicknesses: [0.0; LANES],
            count: 0,
        }
    }
}

impl EllipsoidTrianglePairs {
    /// How many pairs there are.
    #[inline]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Forgets all pairs.
    #[inline]
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds a pair, of which there may be eight. `thickness` as in
    /// [`ellipsoid_triangle`](super::ellipsoid_triangle::ellipsoid_triangle).
    #[inline]
    pub fn add(&mut self, ellipsoid: &Ellipsoid, set: &TriangleSet, triangle: u32, thickness: f64) {
        let lane = self.count;
        put_corners(&mut self.corners, lane, set, triangle);
        put(&mut self.centers, lane, &ellipsoid.center);
        for (axis, widen) in self.widen.iter_mut().enumerate() {
            put(widen, lane, &(ellipsoid.axes.column(axis) * ellipsoid.semi_axes[axis]));
        }
        self.largest[lane] = ellipsoid.semi_axes.max();
        self.thicknesses[lane] = thickness;
        self.count += 1;
    }

    /// Tells which pairs may touch, a bit for each in their order; then there are none.
    #[inline]
    pub fn take(&mut self) -> LaneBits {
        let near = may_touch(self);
        self.count = 0;
        near
    }
}

fn may_touch(pairs: &EllipsoidTrianglePairs) -> LaneBits {
    run_at_level!(may_touch_in(pairs: EllipsoidTrianglePairs) -> LaneBits)
}

/// Planes, with normals of any length, and the ellipsoids.
struct Planes<S: Simd> {
    widen: [Vectors<S>; 3],
    /// Squares of the largest semi-axes.
    largest_square: Numbers<S>,
}

impl<S: Simd> Planes<S> {
    /// Squares of the half widths times the lengths of the normals.
    #[inline(always)]
    fn reach_square(&self, normal: Vectors<S>) -> Numbers<S> {
        let [first, second, third] = self.widen;
        let widened = Vectors { x: first.dot(normal), y: second.dot(normal), z: third.dot(normal) };
        widened.norm_squared()
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

#[inline(always)]
fn may_touch_in<S: Simd>(simd: S, pairs: &EllipsoidTrianglePairs) -> LaneBits {
    let used = !(LaneBits::MAX.checked_shl(pairs.count as u32).unwrap_or(0));
    let corners = load_three(simd, &pairs.corners);
    let center = Vectors::load(simd, &pairs.centers);
    let largest = Numbers::load(simd, &pairs.largest);
    let planes = Planes { widen: load_three(simd, &pairs.widen), largest_square: largest * largest };
    let edges = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
    let normal = edges[0].cross(corners[2] - corners[0]);
    let from_first = center - corners[0];
    let height = normal.dot(from_first);
    let zero = Numbers::splat(simd, 0.0);
    // Behind, an ellipsoid is pushed to the front from as deep as the surface is thick.
    let thickness = Numbers::load(simd, &pairs.thicknesses);
    let behind = thickness * thickness * normal.norm_squared();
    let behind = Numbers::select(height.below(zero), behind, zero);
    let reach_square = planes.reach_square(normal).larger(behind);
    let mut apart = simd.bits(planes.exceeds(height, reach_square, normal, from_first));
    for k in 0..3 {
        let outward = edges[k].cross(normal);
        let arm = center - corners[k];
        let beyond = outward.dot(arm);
        let exceeds = planes.exceeds(beyond, planes.reach_square(outward), outward, arm);
        apart |= simd.bits(zero.below(beyond)) & simd.bits(exceeds);
    }
    used & !apart
}
