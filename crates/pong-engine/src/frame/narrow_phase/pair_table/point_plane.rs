//! A point in a half-space.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::point_plane::point_plane;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Point(point) = a else { wrong_kind(a) };
    pair.whole(point_plane(point, &pair.body_b().planes[pair.item_b.element as usize]), found);
}
