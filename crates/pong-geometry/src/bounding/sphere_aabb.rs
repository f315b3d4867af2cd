//! Overlap test of a sphere and an axis-aligned box. They are disjoint if the box point nearest to the
//! sphere's centre is farther from the centre than the radius.

use super::volume::FromAToB;
use crate::Vec3;

/// Returns `true` if a sphere A (centre, radius) and a box B (centre, half extents), both in B's frame, may
/// overlap.
#[inline]
pub(super) fn sphere_aabb(a: (&Vec3, f64), b: (&Vec3, &Vec3)) -> bool {
    ball_reaches_box(&(a.0 - b.0), a.1, b.1)
}

/// Returns `true` if a box A in A's frame and a sphere B in B's frame may overlap.
#[inline]
pub(super) fn aabb_sphere(a: (&Vec3, &Vec3), b: (&Vec3, f64), x_ba: &FromAToB) -> bool {
    ball_reaches_box(&(into_a(b.0, x_ba) - a.0), b.1, a.1)
}

/// Returns `true` if a sphere at `center` overlaps or touches a box of half extents `half` around the origin.
#[inline]
pub(super) fn ball_reaches_box(center: &Vec3, radius: f64, half: &Vec3) -> bool {
    let outside = (center.abs() - half).map(|x| x.max(0.0));
    let apart = outside.norm_squared() > radius * radius;
    !apart
}

/// Transforms a point of B's frame to A's frame.
#[inline]
pub(super) fn into_a(point: &Vec3, x_ba: &FromAToB) -> Vec3 {
    x_ba.rotation.tr_mul(&(point - x_ba.translation))
}
