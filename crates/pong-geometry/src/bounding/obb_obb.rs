//! Overlap test of two oriented boxes (centre, axes, half extents). Centres are in B's frame, axes in each
//! box's own frame; `r_ba` rotates from A's frame to B's.

use super::box_box::boxes_overlap;
use crate::{Mat3, Vec3};

#[inline]
pub(super) fn obb_obb(a: (&Vec3, &Mat3, &Vec3), b: (&Vec3, &Mat3, &Vec3), r_ba: &Mat3) -> bool {
    let m = b.1.tr_mul(&(r_ba * a.1));
    boxes_overlap(a.2, b.2, &m, &b.1.tr_mul(&(a.0 - b.0)))
}
