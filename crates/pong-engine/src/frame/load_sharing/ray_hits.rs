//! First hit of a ray (docs/theory.md, 2.5).

use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;

/// Rounding errors, in units of the hit position's rounding over the slope of the flatter face, up to which
/// two distances count as equal.
const ROUNDINGS: f64 = 64.0;

/// Keeps one contact per ray: the first hit, ties in key order. Rays that also hit other movable groups of
/// the same Object are resolved after all contacts are known.
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

/// Returns true if the ray hits this face before the other.
///
/// At a fold with both faces on one side of the ray, the distances are equal and rounding would decide. Then
/// the face that hides the other from neighbouring rays counts.
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

/// Returns true if a face hides the other from rays next to one that passes through the line where their
/// planes meet; `None` if the ray does not pass there, or if the faces lie on different sides of it.
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
    // Signed offset of each face from the ray, perpendicular to the ray and the fold.
    let across = direction.cross(&normals[0].cross(&normals[1]));
    let sides = [hit, other].map(|hit| {
        let [a, b, c] = triangles.corners(hit.element_b);
        across.dot(&(a + b + c - place * 3.0))
    });
    if sides[0] * sides[1] <= 0.0 {
        return None;
    }
    // Increase of the hit distance for a ray shifted to that side.
    let across: Vec3 = across * sides[0].signum();
    let grows = |k: usize| normals[k].dot(&across) / slopes[k];
    Some(grows(0) < grows(1))
}
