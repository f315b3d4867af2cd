//! Overlap test of two spheres: they are disjoint if `|c_A − c_B| > r_A + r_B`.

use crate::Vec3;

/// Returns `true` if two spheres (centre, radius), both in B's frame, may overlap.
#[inline]
pub(super) fn sphere_sphere(a: (&Vec3, f64), b: (&Vec3, f64)) -> bool {
    let reach = a.1 + b.1;
    let apart = (a.0 - b.0).norm_squared() > reach * reach;
    !apart
}
