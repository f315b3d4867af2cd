//! Point and sphere (A) – capsule, cylinder and cone (B) (docs/theory.md, 2.8): contact at the surface point
//! nearest to the sphere's centre. For a centre inside, the contact is on the side of least depth.

use super::Interference;
use super::round_surface::{Nearest, of_capsule, of_frustum_within};
use crate::Vec3;
use crate::primitive::{Capsule, Frustum, Sphere};

/// Tests a sphere, or with radius 0 a point, against a capsule.
pub fn ball_capsule(ball: &Sphere, capsule: &Capsule) -> Option<Interference> {
    pressed(&ball.center, ball.radius, &of_capsule(&ball.center, capsule))
}

/// Tests a sphere, or with radius 0 a point, against a cylinder or a cone.
pub fn ball_frustum(ball: &Sphere, frustum: &Frustum) -> Option<Interference> {
    pressed(&ball.center, ball.radius, &of_frustum_within(&ball.center, frustum, ball.radius)?)
}

/// Returns the contact of a sphere, given the solid's surface point nearest to the sphere's centre; `None` if
/// the sphere does not reach the surface.
pub(crate) fn pressed(center: &Vec3, radius: f64, nearest: &Nearest) -> Option<Interference> {
    let depth = radius - nearest.distance;
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: nearest.normal_b,
        deepest_b: center - nearest.normal_b * radius,
        feature: nearest.feature,
    })
}
