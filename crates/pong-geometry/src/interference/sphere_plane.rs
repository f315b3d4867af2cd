//! Sphere (A) – plane (B): the depth is the radius less the height of the centre above the plane.

use super::{Feature, Interference};
use crate::primitive::{Plane, Sphere};

/// Returns the contact of a sphere that extends below a plane; `None` for a sphere above it.
pub fn sphere_plane(sphere: &Sphere, plane: &Plane) -> Option<Interference> {
    let depth = sphere.radius - plane.height(&sphere.center);
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: plane.normal,
        deepest_b: sphere.center - plane.normal * sphere.radius,
        feature: Feature::WHOLE,
    })
}
