//! Keeps only the first hit of each ray (docs/theory.md, 2.5).

use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;

/// Difference up to which two ray distances count as equal, in units of the rounding error of the hit
/// position divided by the slope of the flatter face.
const ROUNDINGS: f64 = 64.0;

/// Keeps the first hit of each ray and culls the others; of hits at equal distance, it keeps the first in key
/// order. Hits on other movable groups of the Object of B are compared in `output/order.rs`, after all
/// contacts are known.
pub(super) fn keep_first_ray_hits(found: &mut [ContactCandidate], context: &PairContext<'_>) {
    for hits in found.chunk_by_mut(|a, b| a.key.primitive_a == b.key.primitive_a) {
        let mut first: Option<usize> = None;
        for other in 0..hits.len() {
            // Contacts of registered testers have no ray distance and are not compared.
            if hits[other].ray_distance == f64::INFINITY {
                continue;
            }
            let Some(before) = first else {
                first = Some(other);
                continue;
            };
            let is_nearer = is_first(&hits[other], &hits[before], context);
            hits[if is_nearer { before } else { other }].status = CandidateStatus::Culled;
            first = Some(if is_nearer { other } else { before });
        }
    }
}

/// Returns true if the ray hits the face of `hit` before the face of `other`.
///
/// If the ray passes through the line where two faces of a mesh meet, and both faces lie on one side of the
/// ray, the distances are equal up to rounding. Then the face that hides the other from neighbouring rays
/// counts as hit first.
fn is_first(hit: &ContactCandidate, other: &ContactCandidate, context: &PairContext<'_>) -> bool {
    let is_on_mesh = |hit: &ContactCandidate| hit.kind_b == PrimitiveKind::Triangle;
    if is_on_mesh(hit)
        && is_on_mesh(other)
        && let Some(is_in_front) = is_in_front_at_a_fold(hit, other, context)
    {
        return is_in_front;
    }
    hit.ray_distance < other.ray_distance
}

/// Returns true if the face of `hit` hides the face of `other` from neighbours of a ray that passes through
/// the line where the planes of the two faces meet. `None` if the ray does not pass through this line, or if
/// the faces lie on different sides of the ray.
fn is_in_front_at_a_fold(
    hit: &ContactCandidate,
    other: &ContactCandidate,
    context: &PairContext<'_>,
) -> Option<bool> {
    let ray = &context.body_a.rays[hit.element_a as usize];
    let direction = context.motion.x_ba.vector(&ray.direction);
    let place = hit.deepest_b - direction * (ray.length - hit.ray_distance);
    let triangles = &context.body_b.triangles;
    let normals = [hit, other].map(|hit| triangles.normal(hit.element_b));
    let slopes = normals.map(|normal| -normal.dot(&direction));
    let apart = (hit.ray_distance - other.ray_distance).abs();
    let reached = place.amax() + ray.length;
    if apart * slopes[0].min(slopes[1]) > ROUNDINGS * f64::EPSILON * reached {
        return None;
    }
    // Signed offset of each face from the ray, in the direction perpendicular to the ray and to the line
    // where the planes meet.
    let across = direction.cross(&normals[0].cross(&normals[1]));
    let sides = [hit, other].map(|hit| {
        let [a, b, c] = triangles.corners(hit.element_b);
        across.dot(&(a + b + c - place * 3.0))
    });
    if sides[0] * sides[1] <= 0.0 {
        return None;
    }
    // Increase of the hit distance of each face per unit by which the ray is shifted towards the faces.
    let across: Vec3 = across * sides[0].signum();
    let grows = |k: usize| normals[k].dot(&across) / slopes[k];
    Some(grows(0) < grows(1))
}
