//! Two boxes (centre, axes, half extents), each along its own axes. Centres in B's frame, axes each in their own;
//! `r_ba` turns A's frame into B's.

use super::box_box::boxes_overlap;
use crate::{Mat3, Vec3};

#[inline]
pub(super) fn obb_obb(a: (&Vec3, &Mat3, &Vec3), b: (&Vec3, &Mat3, &Vec3), r_ba: &Mat3) -> bool {
    let m = b.1.tr_mul(&(r_ba * a.1));
    boxes_overlap(a.2, b.2, &m, &b.1.tr_mul(&(a.0 - b.0)))
}
