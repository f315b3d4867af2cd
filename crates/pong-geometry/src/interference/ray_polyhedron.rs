//! Ray (A) – polyhedron (B) (physics contract, 2.5): the face through which the ray enters the solid.
//!
//! Degenerate cases: a ray along a face is outside unless it runs strictly inside the other faces; one through
//! an edge takes the lower of the two faces.

use super::Feature;
use super::ray_plane::RayHit;
use crate::primitive::{Polyhedron, Ray};

/// Where a ray enters a polyhedron through an active face. The origin may lie inside, up to the reach behind
/// the face, but not beyond the far side.
pub fn ray_polyhedron(ray: &Ray, polyhedron: &Polyhedron) -> Option<RayHit> {
    let mut entry: Option<(f64, usize)> = None;
    let mut leave = f64::INFINITY;
    for (index, face) in polyhedron.faces.iter().enumerate() {
        let height = face.height(&ray.origin);
        let climb = ray.direction.dot(&face.normal);
        if climb == 0.0 {
            if height >= 0.0 {
                return None;
            }
        } else if climb < 0.0 {
            let distance = -height / climb;
            if entry.is_none_or(|(best, _)| distance > best) {
                entry = Some((distance, index));
            }
        } else {
            leave = leave.min(-height / climb);
        }
    }
    let (distance, index) = entry?;
    let face = &polyhedron.faces[index];
    let before_far_side = distance < leave && leave > 0.0;
    let within = -ray.reach.unwrap_or(0.0) < distance && distance < ray.length;
    (face.active && before_far_side && within).then_some(RayHit {
        distance,
        normal: face.normal,
        feature: Feature::face(index),
    })
}
