//! A line segment in a piece of a body: each end carries half of the spring.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::narrow_phase::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use pong_geometry::interference::Interference;
use pong_geometry::interference::line_segment_polyhedron::{AtWall, line_segment_piece};
use pong_geometry::primitive::{Containment, Polyhedron};

pub(crate) fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
    let TransformedPrimitive::Segment(segment) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    for (end, found_there) in line_segment_piece(segment, polyhedron).iter().enumerate() {
        let Some((contact, at_wall)) = found_there else { continue };
        let status = status_of_end(contact, *at_wall, polyhedron);
        pair.emit(contact, found, |out| {
            out.key.end = end as u32;
            out.half = true;
            out.status = status;
        });
    }
}

/// Candidate status of a segment's end in a piece of a body.
fn status_of_end(contact: &Interference, at_wall: AtWall, piece: &Polyhedron) -> CandidateStatus {
    match at_wall {
        AtWall::SharedEdge | AtWall::Exit => CandidateStatus::AtWall,
        AtWall::StandsIn => CandidateStatus::BeyondWall,
        AtWall::ExitStandsIn => CandidateStatus::StandIn,
        AtWall::No if piece.planes().all_active || !contact.feature.is_face() => CandidateStatus::Front,
        AtWall::No => match piece.containment(&contact.deepest_b) {
            Containment::AtWall | Containment::BeyondWall => CandidateStatus::AtWall,
            Containment::Inside | Containment::Outside => CandidateStatus::Front,
        },
    }
}
