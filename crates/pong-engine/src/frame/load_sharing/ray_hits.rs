//! Which hit of a ray is the first one (docs/theory.md, 2.5).

use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;

/// How many roundings of the place of a hit, over the slope of the flatter face, two distances may be apart and count
/// as one.
const ROUNDINGS: f64 = 64.0;

/// One contact per ray: the first hit, ties in key order. Rays that also hit other movable groups of the same Object
/// are judged when all are known.
pub(super) fn keep_first_ray_hits(found: &mut [ContactCandidate], context: &PairContext<'_>) {
    for hits in found.chunk_by_mut(|a, b| a.key.primitive_a == b.key.primitive_a) {
        let mut first: Option<usize> = None;
        for other in 0..hits.len() {
            // What a registered test finds for a ray has no distance and takes no part.
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

/// Whether the ray hits this face before the other one.
///
/// Through a fold whose faces both lie on one side of the ray, rays beside it hit the face that hides the other, or
/// none. In the fold itself the distances are equal, and rounding would choose.
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

/// Whether a face hides the other one from rays beside a ray through the line in which their planes meet; `None` if the
/// ray does not pass there, or if the faces lie on both sides of it.
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
    // Across the ray and the fold: how far each face lies to that side.
    let across = direction.cross(&normals[0].cross(&normals[1]));
    let sides = [hit, other].map(|hit| {
        let [a, b, c] = triangles.corners(hit.element_b);
        across.dot(&(a + b + c - place * 3.0))
    });
    if sides[0] * sides[1] <= 0.0 {
        return None;
    }
    // What the distance grows by for a ray that is so far to that side.
    let across: Vec3 = across * sides[0].signum();
    let grows = |k: usize| normals[k].dot(&across) / slopes[k];
    Some(grows(0) < grows(1))
}
