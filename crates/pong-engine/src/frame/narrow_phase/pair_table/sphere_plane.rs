//! A sphere in a half-space.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::sphere_plane::sphere_plane;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Sphere(sphere) = a else { wrong_kind(a) };
    pair.whole(sphere_plane(sphere, &pair.body_b().planes[pair.item_b.element as usize]), found);
}
