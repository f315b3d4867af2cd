//! A ray into a polyhedron.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::ray_plane::ray_contact;
use pong_geometry::interference::ray_polyhedron::ray_polyhedron;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Ray(ray) = a else { wrong_kind(a) };
    if let Some(hit) = ray_polyhedron(ray, &pair.body_b().polyhedra[pair.item_b.element as usize]) {
        pair.emit(&ray_contact(ray, &hit), found, |out| out.ray_distance = hit.distance);
    }
}
