//! A sphere on or in a piece of a body.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{Ball, ChunkCandidates, ElementPair, status_of, wrong_kind};
use pong_geometry::interference::sphere_polyhedron::{sphere_inside_polyhedron, sphere_outside_polyhedron};
use pong_geometry::primitive::Containment;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Sphere(sphere) = a else { wrong_kind(a) };
    test_ball(pair, &Ball::of(sphere), found);
}

pub(super) fn test_ball(pair: &ElementPair<'_>, ball: &Ball<'_>, found: &mut ChunkCandidates<'_>) {
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    let sphere = ball.sphere;
    let containment = polyhedron.containment(&sphere.center);
    if matches!(containment, Containment::Outside | Containment::BeyondWall)
        && let Some(contact) = sphere_outside_polyhedron(sphere, polyhedron)
    {
        pair.sharing(ball, &contact, found);
    }
    if containment == Containment::Outside {
        return;
    }
    let center_a = pair.center_a(ball);
    let key = pair.key_at(ball.end.unwrap_or(0));
    let remembered = pair.context.memory.under(&key);
    let Some(face) = pair.entry_face(&remembered, center_a, &sphere.center) else { return };
    let contact = sphere_inside_polyhedron(sphere, polyhedron, face.pushes());
    pair.emit_under(key, &contact, found, |out| {
        out.share(ball.end.is_some());
        out.status = status_of(containment);
        (out.entry_face, out.remembered) = (face.reached(), Some(remembered.range));
    });
}
