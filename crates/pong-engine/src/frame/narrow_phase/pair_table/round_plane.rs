//! A capsule, a cylinder or a cone in a half-space: half a spring at each end sphere, and at the lowest and
//! highest point of each end disc.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::Interference;
use pong_geometry::interference::round_plane::{capsule_plane, frustum_plane};

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let plane = &pair.body_b().planes[pair.item_b.element as usize];
    match a {
        TransformedPrimitive::Capsule(capsule) => emit(pair, &capsule_plane(capsule, plane), found),
        TransformedPrimitive::Frustum(frustum) => emit(pair, &frustum_plane(frustum, plane), found),
        _ => wrong_kind(a),
    }
}

fn emit(pair: &ElementPair<'_>, contacts: &[Option<Interference>], found: &mut ChunkCandidates<'_>) {
    for (end, contact) in contacts.iter().enumerate() {
        let Some(contact) = contact else { continue };
        pair.emit(contact, found, |out| {
            out.key.end = end as u32;
            out.half = true;
        });
    }
}
