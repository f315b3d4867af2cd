//! Overlap test of a sphere and an oriented box: the test of an axis-aligned box, in the axes of the box.

use super::sphere_aabb::{ball_reaches_box, into_a};
use super::volume::FromAToB;
use crate::{Mat3, Vec3};

/// Returns `true` if a sphere A and a box B (centre, axes, half extents), both in B's frame, may overlap.
#[inline]
pub(super) fn sphere_obb(a: (&Vec3, f64), b: (&Vec3, &Mat3, &Vec3)) -> bool {
    ball_reaches_box(&b.1.tr_mul(&(a.0 - b.0)), a.1, b.2)
}

/// Returns `true` if a box A in A's frame and a sphere B in B's frame may overlap.
#[inline]
pub(super) fn obb_sphere(a: (&Vec3, &Mat3, &Vec3), b: (&Vec3, f64), x_ba: &FromAToB) -> bool {
    ball_reaches_box(&a.1.tr_mul(&(into_a(b.0, x_ba) - a.0)), b.1, a.2)
}
