//! Ball against ball: apart if `|c_A − c_B| > r_A + r_B`.

use super::volume::FromAToB;
use crate::Vec3;

#[inline]
pub(super) fn sphere_sphere(a: (&Vec3, f64), b: (&Vec3, f64), x_ba: &FromAToB) -> bool {
    let reach = a.1 + b.1;
    let apart = (x_ba.point(a.0) - b.0).norm_squared() > reach * reach;
    !apart
}
