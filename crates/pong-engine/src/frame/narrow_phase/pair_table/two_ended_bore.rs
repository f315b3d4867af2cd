//! A line segment, a capsule or a cylinder in a bore: half a spring at each end of the part in the hole.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use crate::frame::narrow_phase::side_of_bore::role_in_bore;
use pong_geometry::interference::two_ended_bore::{capsule_bore, cylinder_bore, segment_bore};

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let bore = &pair.body_b().bores[pair.item_b.element as usize];
    let (body_a, element) = (pair.body_a(), pair.item_a.element as usize);
    let (contacts, ends) = match a {
        TransformedPrimitive::Segment(segment) => {
            (segment_bore(segment, bore), body_a.segments[element].ends)
        }
        TransformedPrimitive::Capsule(capsule) => {
            (capsule_bore(capsule, bore), body_a.capsules[element].ends)
        }
        TransformedPrimitive::Frustum(cylinder) => {
            (cylinder_bore(cylinder, bore), body_a.frusta[element].ends)
        }
        _ => wrong_kind(a),
    };
    for (end, (contacts, local)) in contacts.iter().zip(ends).enumerate() {
        for contact in contacts.iter().flatten() {
            let key = pair.key_at(end as u32);
            let remembered = pair.context.memory.under(&key);
            let role = role_in_bore(pair, &remembered, &local, contact);
            pair.emit_under(key, contact, found, |out| {
                out.share(true);
                (out.role, out.remembered) = (role, Some(remembered.range));
            });
        }
    }
}
