//! A point in a polyhedron; only points inside or on an internal face get here.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::narrow_phase::element_pair::status_of;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::point_polyhedron::point_below_face;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Point(point) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    let status = match polyhedron.planes().all_active {
        true => CandidateStatus::Front,
        false => status_of(polyhedron.containment(&point.position)),
    };
    let local = &pair.body_a().points[pair.item_a.element as usize].position;
    let key = pair.key();
    let remembered = pair.context.memory.under(&key);
    let Some(face) = pair.entry_face(&remembered, local, &point.position) else { return };
    let contact = point_below_face(&point.position, polyhedron, face.pushes());
    if let Some(contact) = contact {
        pair.emit_under(key, &contact, found, |out| {
            (out.entry_face, out.remembered) = (face.reached(), Some(remembered.range));
            out.status = status;
        });
    }
}
