//! Overlap test of an axis-aligned box and an oriented box, in either order. Centres are in B's frame; `r_ba`
//! rotates from A's frame to B's.

use super::box_box::boxes_overlap;
use crate::{Mat3, Vec3};

/// Returns `true` if an axis-aligned box A (centre, half extents) and an oriented box B (centre, axes, half
/// extents) may overlap.
#[inline]
pub(super) fn aabb_obb(a: (&Vec3, &Vec3), b: (&Vec3, &Mat3, &Vec3), r_ba: &Mat3) -> bool {
    let m = b.1.tr_mul(r_ba);
    boxes_overlap(a.1, b.2, &m, &b.1.tr_mul(&(a.0 - b.0)))
}

/// Returns `true` if an oriented box A (centre, axes in A's frame, half extents) and an axis-aligned box B
/// (centre, half extents) may overlap.
#[inline]
pub(super) fn obb_aabb(a: (&Vec3, &Mat3, &Vec3), b: (&Vec3, &Vec3), r_ba: &Mat3) -> bool {
    boxes_overlap(a.2, b.1, &(r_ba * a.1), &(a.0 - b.0))
}
