//! A sphere on or in a piece of a body.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::status_of;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::sphere_polyhedron::{sphere_inside_polyhedron, sphere_outside_polyhedron};
use pong_geometry::primitive::Containment;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Sphere(sphere) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    let containment = polyhedron.containment(&sphere.center);
    if matches!(containment, Containment::Outside | Containment::BeyondWall) {
        pair.sharing(sphere_outside_polyhedron(sphere, polyhedron), found);
    }
    if containment == Containment::Outside {
        return;
    }
    let local = pair.body_a().spheres[pair.item_a.element as usize].center;
    let Some(face) = pair.entry_face(&local, &sphere.center) else { return };
    let contact = sphere_inside_polyhedron(sphere, polyhedron, face.pushes);
    pair.emit(&contact, found, |out| {
        out.shares = true;
        out.status = status_of(containment);
        out.entry_face = face.reached as u32;
    });
}
