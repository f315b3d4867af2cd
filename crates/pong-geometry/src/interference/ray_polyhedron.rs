//! Ray (A) – polyhedron (B) (physics contract, 2.5): the face through which the ray enters the solid.
//!
//! Degenerate cases: a ray along an active face is outside; one along an inner wall belongs to the piece that the
//! wall is closed for. One through an edge takes the lower of the two faces. Where a ray enters at the very edge of
//! an inner wall rounding may put the entry behind the wall for this piece and before it for the next; the piece it
//! leaves by the wall then takes it, and if both do they agree.

use super::Feature;
use super::ray_plane::RayHit;
use crate::primitive::{Polyhedron, Ray};

/// Where a ray enters a polyhedron through an active face. The origin may lie inside, up to the reach behind
/// the face, but not beyond the far side.
pub fn ray_polyhedron(ray: &Ray, polyhedron: &Polyhedron) -> Option<RayHit> {
    /// Rounding in a distance along the ray, relative to the polyhedron's diameter.
    const WALL_SLACK: f64 = 1e-12;
    let mut entry: Option<(f64, usize)> = None;
    let mut leave = f64::INFINITY;
    for (index, face) in polyhedron.faces.iter().enumerate() {
        let height = face.height(&ray.origin);
        let climb = ray.direction.dot(&face.normal);
        if climb == 0.0 {
            if height > 0.0 || (height == 0.0 && !face.closed) {
                return None;
            }
        } else if climb < 0.0 {
            let distance = -height / climb;
            if entry.is_none_or(|(best, _)| distance > best) {
                entry = Some((distance, index));
            }
        } else {
            let slack = if face.active { 0.0 } else { WALL_SLACK * polyhedron.diameter };
            leave = leave.min(-height / climb + slack);
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
