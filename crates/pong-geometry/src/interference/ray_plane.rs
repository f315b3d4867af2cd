//! Ray (A) – plane (B), and the contact that follows from the hit of a ray on any surface (docs/theory.md,
//! 2.5).
//!
//! Degenerate case: a ray that runs along the surface, or that crosses it from behind, has no hit.

use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{Plane, Ray, RayResponse};

/// Hit of a ray on the front of a surface: distance, normal and feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// Distance from the ray's origin along its direction, m; negative behind the origin.
    pub distance: f64,
    /// Unit normal of the surface.
    pub normal_b: Vec3,
    /// Feature that is hit.
    pub feature: Feature,
}

/// Returns the hit of a ray on the front of a plane; `None` unless −reach < distance < length.
pub fn ray_plane(ray: &Ray, plane: &Plane) -> Option<RayHit> {
    hit_plane(ray, &plane.normal, -plane.height(&ray.origin), ray.reach.unwrap_or(0.0), Feature::WHOLE)
}

/// Returns the hit of a ray on the front of a plane that lies `rise` (m) from the ray's origin along
/// `normal`; `None` unless −`reach` < distance < length. `rise` is negative if the origin is in front. A `normal` of
/// another length than 1 has to have the `rise` times this length.
#[inline]
pub(super) fn hit_plane(ray: &Ray, normal: &Vec3, rise: f64, reach: f64, feature: Feature) -> Option<RayHit> {
    let closing = ray.direction.dot(normal);
    if closing >= 0.0 {
        return None;
    }
    // Clamped, so that the divisor is not zero even if a compiler divides before the branch.
    let distance = rise / closing.min(-f64::MIN_POSITIVE);
    (-reach < distance && distance < ray.length).then_some(RayHit { distance, normal_b: *normal, feature })
}

/// Returns the contact of a ray with the nearest surface that it hits, along the direction that the ray's
/// `response` selects.
#[inline]
pub fn ray_contact(ray: &Ray, hit: &RayHit) -> Interference {
    let shortening = ray.length - hit.distance;
    let (depth, normal) = match ray.response {
        RayResponse::Normal => (shortening * -ray.direction.dot(&hit.normal_b), hit.normal_b),
        RayResponse::Axial => (shortening, -ray.direction),
    };
    Interference { depth, normal_b: normal, deepest_b: ray.tip(), feature: hit.feature }
}
