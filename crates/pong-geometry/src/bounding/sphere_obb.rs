//! Sphere against oriented box: the axis-aligned test in the axes of the box.

use super::sphere_aabb::{ball_reaches_box, into_a};
use super::volume::FromAToB;
use crate::{Mat3, Vec3};

/// Sphere and box (centre, axes, half extents), both in B's frame.
#[inline]
pub(super) fn sphere_obb(a: (&Vec3, f64), b: (&Vec3, &Mat3, &Vec3)) -> bool {
    ball_reaches_box(&b.1.tr_mul(&(a.0 - b.0)), a.1, b.2)
}

/// Box in A's frame, sphere in B's.
#[inline]
pub(super) fn obb_sphere(a: (&Vec3, &Mat3, &Vec3), b: (&Vec3, f64), x_ba: &FromAToB) -> bool {
    ball_reaches_box(&a.1.tr_mul(&(into_a(b.0, x_ba) - a.0)), b.1, a.2)
}
