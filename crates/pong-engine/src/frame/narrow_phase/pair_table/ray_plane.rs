//! A ray into a half-space.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::ray_plane::{ray_contact, ray_plane};

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Ray(ray) = a else { wrong_kind(a) };
    if let Some(hit) = ray_plane(ray, &pair.body_b().planes[pair.item_b.element as usize]) {
        pair.emit(&ray_contact(ray, &hit), found, |out| out.ray_distance = hit.distance);
    }
}
