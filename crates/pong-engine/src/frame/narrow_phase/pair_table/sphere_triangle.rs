//! A sphere on a triangle.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use crate::frame::narrow_phase::on_triangle::{on_triangle, thickness_for_sphere};
use pong_geometry::interference::sphere_triangle::{sphere_over_face, sphere_triangle};
use pong_geometry::primitive::Sphere;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Sphere(sphere) = a else { wrong_kind(a) };
    test_sphere(pair, sphere, false, found);
}

/// `over_face`: whether the face alone may push.
pub(crate) fn test_sphere(
    pair: &ElementPair<'_>,
    sphere: &Sphere,
    over_face: bool,
    found: &mut ChunkCandidates<'_>,
) {
    let (set, triangle) = (&pair.body_b().triangles, pair.item_b.element);
    let local = pair.body_a().spheres[pair.item_a.element as usize].center;
    let mut emit = |contact| on_triangle(pair, (&local, &sphere.center), contact, found);
    if over_face {
        sphere_over_face(sphere, set, triangle).into_iter().for_each(emit);
    } else {
        let thickness = thickness_for_sphere(pair.context, pair.item_b, sphere);
        sphere_triangle(sphere, set, triangle, thickness, &mut emit);
    }
}
