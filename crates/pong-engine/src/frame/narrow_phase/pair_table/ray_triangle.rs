//! A ray through a triangle.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::ray_plane::ray_contact;
use pong_geometry::interference::ray_triangle::ray_triangle;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Ray(ray) = a else { wrong_kind(a) };
    let reach = ray.reach.or(pair.info_b().thickness).unwrap_or(0.0);
    if let Some(hit) = ray_triangle(ray, &pair.body_b().triangles, pair.item_b.element, reach) {
        pair.emit(&ray_contact(ray, &hit), found, |out| out.ray_distance = hit.distance);
    }
}
