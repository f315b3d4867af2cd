//! Overlap test of two boxes, each axis-aligned in its own frame. One frame may be rotated relative to the
//! other, so this is the general box-box test.

use super::box_box::boxes_overlap;
use crate::{Mat3, Vec3};

/// Returns `true` if two boxes, as (centre in B's frame, half extents), may overlap. `r_ba` rotates from A's
/// frame to B's.
#[inline]
pub(super) fn aabb_aabb(a: (&Vec3, &Vec3), b: (&Vec3, &Vec3), r_ba: &Mat3) -> bool {
    boxes_overlap(a.1, b.1, r_ba, &(a.0 - b.0))
}
