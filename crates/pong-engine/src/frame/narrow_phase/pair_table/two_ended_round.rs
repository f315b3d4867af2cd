//! A line segment or a capsule on a capsule, a cylinder or a cone: half a spring at each end of the overlap,
//! and a contact at the deepest point for the remainder.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::two_ended_round::{
    EndContacts, capsule_capsule, capsule_frustum, segment_capsule, segment_frustum,
};

pub(crate) fn test_capsule(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let capsule = &pair.body_b().capsules[pair.item_b.element as usize];
    let contacts = match a {
        TransformedPrimitive::Segment(segment) => segment_capsule(segment, capsule),
        TransformedPrimitive::Capsule(own) => capsule_capsule(own, capsule),
        _ => wrong_kind(a),
    };
    emit(pair, &contacts, found);
}

/// Tests against a cylinder or a cone.
pub(crate) fn test_frustum(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let frustum = &pair.body_b().frusta[pair.item_b.element as usize];
    let contacts = match a {
        TransformedPrimitive::Segment(segment) => segment_frustum(segment, frustum),
        TransformedPrimitive::Capsule(capsule) => capsule_frustum(capsule, frustum),
        _ => wrong_kind(a),
    };
    emit(pair, &contacts, found);
}

fn emit(pair: &ElementPair<'_>, contacts: &EndContacts, found: &mut ChunkCandidates<'_>) {
    for (end, contact) in contacts.iter().enumerate() {
        let Some(contact) = contact else { continue };
        pair.emit(&contact.interference, found, |out| {
            out.key.end = end as u32;
            out.half = true;
            out.weight = contact.share;
        });
    }
}
