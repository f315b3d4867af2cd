//! A point or a sphere on a capsule, a cylinder or a cone: one contact.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::ball_round::{ball_capsule, ball_frustum};
use pong_geometry::primitive::Sphere;

pub(crate) fn test_capsule(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    pair.whole(ball_capsule(&ball(a), &pair.body_b().capsules[pair.item_b.element as usize]), found);
}

/// Tests against a cylinder or a cone.
pub(crate) fn test_frustum(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    pair.whole(ball_frustum(&ball(a), &pair.body_b().frusta[pair.item_b.element as usize]), found);
}

/// Sphere of the element; a point has zero radius.
fn ball(a: &TransformedPrimitive) -> Sphere {
    match a {
        TransformedPrimitive::Sphere(sphere) => *sphere,
        TransformedPrimitive::Point(point) => Sphere { center: point.position, radius: 0.0 },
        _ => wrong_kind(a),
    }
}
