//! An ellipsoid on a piece of a body.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::ellipsoid_polyhedron::ellipsoid_piece;

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Ellipsoid(ellipsoid) = a else { wrong_kind(a) };
    let Some(contact) = ellipsoid_piece(ellipsoid, &pair.body_b().polyhedra[pair.item_b.element as usize])
    else {
        return;
    };
    pair.emit(&contact.interference, found, |out| {
        out.shares = true;
        out.status = if contact.stands_in { CandidateStatus::StandIn } else { CandidateStatus::Front };
    });
}
