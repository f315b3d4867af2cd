//! Two boxes, each axis-aligned in its own frame. The frames may be rotated, so this is the general box-box
//! test.

use super::box_box::boxes_overlap;
use crate::{Mat3, Vec3};

/// Centres in B's frame; `r_ba` turns A's frame into B's.
#[inline]
pub(super) fn aabb_aabb(a: (&Vec3, &Vec3), b: (&Vec3, &Vec3), r_ba: &Mat3) -> bool {
    boxes_overlap(a.1, b.1, r_ba, &(a.0 - b.0))
}
