//! A line segment in a half-space: each end carries half of the spring.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::line_segment_plane::line_segment_plane;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Segment(segment) = a else { wrong_kind(a) };
    let ends = line_segment_plane(segment, &pair.body_b().planes[pair.item_b.element as usize]);
    for (end, contact) in ends.iter().enumerate() {
        let Some(contact) = contact else { continue };
        pair.emit(contact, found, |out| {
            out.key.end = end as u32;
            out.half = true;
        });
    }
}
