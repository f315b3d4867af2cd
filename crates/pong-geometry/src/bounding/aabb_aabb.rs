//! Two boxes, each along the axes of its own frame: the frames may be turned, so this is box against box.

use super::box_box::boxes_overlap;
use crate::{Mat3, Vec3};

/// Centres in B's frame; `r_ba` turns A's frame into B's.
#[inline]
pub(super) fn aabb_aabb(a: (&Vec3, &Vec3), b: (&Vec3, &Vec3), r_ba: &Mat3) -> bool {
    boxes_overlap(a.1, b.1, r_ba, &(a.0 - b.0))
}
