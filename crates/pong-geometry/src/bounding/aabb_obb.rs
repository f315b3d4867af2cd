//! A box along its frame's axes against one along its own, in either order.

use super::box_box::boxes_overlap;
use super::volume::FromAToB;
use crate::{Mat3, Vec3};

/// A is axis-aligned; B is (centre, axes, half extents).
#[inline]
pub(super) fn aabb_obb(a: (&Vec3, &Vec3), b: (&Vec3, &Mat3, &Vec3), x_ba: &FromAToB) -> bool {
    let m = b.1.tr_mul(&x_ba.rotation);
    boxes_overlap(a.1, b.2, &m, &b.1.tr_mul(&(x_ba.point(a.0) - b.0)))
}

/// A is (centre, axes, half extents); B is axis-aligned.
#[inline]
pub(super) fn obb_aabb(a: (&Vec3, &Mat3, &Vec3), b: (&Vec3, &Vec3), x_ba: &FromAToB) -> bool {
    boxes_overlap(a.2, b.1, &(x_ba.rotation * a.1), &(x_ba.point(a.0) - b.0))
}
