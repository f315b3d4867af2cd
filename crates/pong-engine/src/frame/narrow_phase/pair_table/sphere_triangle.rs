//! A sphere on a triangle.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{Ball, ChunkCandidates, ElementPair, wrong_kind};
use crate::frame::narrow_phase::on_triangle::{Centre, on_triangle, thickness_for_sphere};
use pong_geometry::interference::sphere_triangle::{sphere_over_face, sphere_triangle};

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Sphere(sphere) = a else { wrong_kind(a) };
    test_ball(pair, &Ball::of(sphere), false, found);
}

/// Tests a sphere; with `over_face`, only the face can push.
pub(crate) fn test_ball(
    pair: &ElementPair<'_>,
    ball: &Ball<'_>,
    over_face: bool,
    found: &mut ChunkCandidates<'_>,
) {
    let (set, triangle) = (&pair.body_b().triangles, pair.item_b.element);
    let center = Centre { center_a: *pair.center_a(ball), center_b: ball.sphere.center, end: ball.end };
    let mut emit = |contact| on_triangle(pair, &center, contact, found);
    if over_face {
        sphere_over_face(ball.sphere, set, triangle).into_iter().for_each(emit);
    } else {
        let thickness = thickness_for_sphere(pair.context, pair.item_b, ball.sphere);
        sphere_triangle(ball.sphere, set, triangle, thickness, &mut emit);
    }
}
