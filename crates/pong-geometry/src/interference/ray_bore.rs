//! Ray (A) – bore (B): the point at which the ray leaves the hole through the wall (docs/theory.md, 2.5 and
//! 2.8).
//!
//! Degenerate case: a ray that runs along the wall, or that crosses it from behind, has no hit.

use super::Feature;
use super::ray_plane::RayHit;
use crate::Vec3;
use crate::primitive::{Bore, Curved, Ray};

/// Returns the hit of a ray on the wall from within the hole. `None` unless the ray leaves the hole between
/// the ends of the wall, and −reach < distance < length. A ray without a `reach` uses the thickness of the
/// wall.
pub fn ray_bore(ray: &Ray, bore: &Bore) -> Option<RayHit> {
    let distance = way_out(&ray.origin, &ray.direction, bore)?;
    let reach = ray.reach.unwrap_or(bore.thickness);
    if !(-reach < distance && distance < ray.length) {
        return None;
    }
    let hole = &bore.hole;
    let arm = ray.origin + ray.direction * distance - hole.ends[0];
    let along = hole.axis.dot(&arm);
    let across = arm - hole.axis * along;
    let aside = across.norm();
    if !(0.0..=hole.length).contains(&along) || aside == 0.0 {
        return None;
    }
    let [wall_along, wall_aside] = hole.wall;
    let outward = hole.axis * wall_along + across * (wall_aside / aside);
    Some(RayHit { distance, normal_b: -outward.normalize(), feature: Feature::face(0) })
}

/// Returns the position, in units of `direction`, at which a line leaves the cone of the wall: there the
/// line's distance from the axis grows beyond the cone's radius. The cone is extended past the mouths. `None`
/// if the line does not leave it.
pub(crate) fn way_out(origin: &Vec3, direction: &Vec3, bore: &Bore) -> Option<f64> {
    let hole = &bore.hole;
    let widening = (hole.radii[1] - hole.radii[0]) / hole.length;
    let arm = origin - hole.ends[0];
    let (along, rate) = (hole.axis.dot(&arm), hole.axis.dot(direction));
    let (across, turning) = (arm - hole.axis * along, direction - hole.axis * rate);
    let (radius, growth) = (hole.radii[0] + widening * along, widening * rate);
    // Along the line |across|² − radius² is square·t² + 2·half·t + start; the exit is its zero with a
    // positive slope.
    let square = (turning.norm() - growth) * (turning.norm() + growth);
    let half = across.dot(&turning) - radius * growth;
    let start = (across.norm() - radius) * (across.norm() + radius);
    let root = half * half - square * start;
    let slope = if root > 0.0 { root.sqrt() } else { return None };
    let distance = if half > 0.0 {
        -start / (half + slope)
    } else if square != 0.0 {
        (slope - half) / square
    } else {
        // The line is parallel to a generator of the cone: it enters and never leaves.
        return None;
    };
    (distance.is_finite() && radius + growth * distance > 0.0).then_some(distance)
}

impl Curved for Bore {
    /// Returns the normal of the wall where a straight path leaves the hole through it; `None` if the path
    /// does not. The radius does not matter.
    fn passed(&self, from: &Vec3, to: &Vec3, _radius: f64) -> Option<Vec3> {
        let ray = Ray { reach: Some(0.0), ..Ray::between(from, to)? };
        ray_bore(&ray, self).map(|hit| hit.normal_b)
    }
}
