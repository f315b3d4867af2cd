//! Two boxes (centre, axes, half extents), each along its own axes.

use super::box_box::boxes_overlap;
use super::volume::FromAToB;
use crate::{Mat3, Vec3};

#[inline]
pub(super) fn obb_obb(a: (&Vec3, &Mat3, &Vec3), b: (&Vec3, &Mat3, &Vec3), x_ba: &FromAToB) -> bool {
    let m = b.1.tr_mul(&(x_ba.rotation * a.1));
    boxes_overlap(a.2, b.2, &m, &b.1.tr_mul(&(x_ba.point(a.0) - b.0)))
}
