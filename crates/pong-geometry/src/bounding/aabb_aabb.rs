//! Two boxes, each along the axes of its own frame: the frames may be turned, so this is box against box.

use super::box_box::boxes_overlap;
use super::volume::FromAToB;
use crate::Vec3;

#[inline]
pub(super) fn aabb_aabb(a: (&Vec3, &Vec3), b: (&Vec3, &Vec3), x_ba: &FromAToB) -> bool {
    boxes_overlap(a.1, b.1, &x_ba.rotation, &(x_ba.point(a.0) - b.0))
}
