//! Sphere (A) – ellipsoid (B): depth and normal at the surface point nearest to the sphere's centre.

use super::ellipsoid_math::nearest_on_ellipsoid;
use super::{Feature, Interference};
use crate::primitive::{Ellipsoid, Sphere};

/// Tests a sphere (A) against an ellipsoid (B); `None` if they do not overlap. A sphere whose centre is inside leaves
/// by the surface point nearest to its centre. At the centre of the ellipsoid the normal is that of
/// [`point_ellipsoid`](super::point_ellipsoid::point_ellipsoid).
pub fn sphere_ellipsoid(sphere: &Sphere, e: &Ellipsoid) -> Option<Interference> {
    let arm = sphere.center - e.center;
    if arm.norm() >= sphere.radius + e.semi_axes.max() {
        return None;
    }
    let foot = nearest_on_ellipsoid(&e.semi_axes, &e.axes.tr_mul(&arm));
    let depth = sphere.radius + foot.depth;
    let normal = (e.axes * crate::Vec3::from(foot.normal)).normalize();
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: normal,
        deepest_b: sphere.center - normal * sphere.radius,
        feature: Feature::WHOLE,
    })
}
