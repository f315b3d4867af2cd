//! Point (A) – ellipsoid (B): depth and normal at the nearest surface point.

use super::ellipsoid_math::nearest_on_ellipsoid;
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::Ellipsoid;

/// Tests a point (A) against an ellipsoid (B); `None` unless the point is inside.
///
/// For a point at the centre, the normal is the direction of the shortest axis, the first if several are
/// equal. See [`ellipsoid_math`](super::ellipsoid_math) for the equation.
pub fn point_ellipsoid(p: &Vec3, e: &Ellipsoid) -> Option<Interference> {
    let y = e.axes.tr_mul(&(p - e.center));
    if y.component_div(&e.semi_axes).norm_squared() >= 1.0 {
        return None;
    }
    let foot = nearest_on_ellipsoid(&e.semi_axes, &y);
    (foot.depth > 0.0).then(|| Interference {
        depth: foot.depth,
        normal_b: e.axes * Vec3::from(foot.normal),
        deepest_b: *p,
        feature: Feature::WHOLE,
    })
}
