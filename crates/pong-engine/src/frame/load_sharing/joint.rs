//! Contacts with a surface that B's model declares (`one_surface`). It may consist of several kinds of primitives,
//! which may also coincide or overlap (docs/theory.md, 2.2, declared surfaces).

use super::pieces::touched;
use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use pong_geometry::Vec3;
use pong_geometry::primitive::{Polyhedron, PrimitiveKind};

/// Distance past the exit of a segment from a piece at which the surface is searched, in diameters of the piece:
/// above the tolerance of internal faces.
const PAST_EXIT: f64 = 4e-6;

/// Returns true if B's model declares the surface of a contact.
pub(super) fn is_joint(contact: &ContactCandidate, context: &PairContext<'_>) -> bool {
    context.body_b.is_joint(contact.key.shell_b)
}

/// Runs `judge`, passes 4 to 6 of the table in `status.rs`, on the contacts of one key with a declared surface, by kind of B.
/// Afterwards the contacts that count share one spring, whatever the kind of A: where primitives of the surface
/// coincide, a point is pushed once.
pub(super) fn judge_by_kind(
    group: &mut [ContactCandidate],
    kind_a: PrimitiveKind,
    context: &PairContext<'_>,
    judge: impl Fn(&mut [ContactCandidate], PrimitiveKind, &PairContext<'_>),
) {
    group.sort_unstable_by_key(|found| (found.kind_b as u8, found.order()));
    for of_kind in group.chunk_by_mut(|a, b| a.kind_b == b.kind_b) {
        judge(of_kind, kind_a, context);
    }
    if kind_a == PrimitiveKind::LineSegment {
        drop_exits_into_the_surface(group, context);
    }
    group.iter_mut().for_each(|found| found.shares = true);
}

/// Culls two kinds of contacts that a segment has with one piece of the surface and would not have with the whole:
/// where it leaves the piece into another primitive of the surface, and where an end of it is pushed through a face
/// of the piece into another primitive that has a contact with this end as well.
fn drop_exits_into_the_surface(group: &mut [ContactCandidate], context: &PairContext<'_>) {
    let body = context.body_b;
    for index in 0..group.len() {
        let found = &group[index];
        if found.kind_b != PrimitiveKind::Polyhedron {
            continue;
        }
        let segment = &context.body_a.segments[found.element_a as usize];
        let ends = segment.ends.map(|end| context.motion.x_ba.point(&end));
        let piece = &body.polyhedra[found.element_b as usize];
        let step = PAST_EXIT * piece.diameter;
        let leads_on = |past: Vec3| {
            !is_inside(piece, &past) && body.is_in_another(found.key.shell_b, found.element_b, &past)
        };
        let is_dropped = if ends.iter().any(|end| (end - found.deepest_b).norm() <= step) {
            let has_end = |other: &ContactCandidate| {
                other.takes_part()
                    && (other.kind_b as u8, other.element_b) != (found.kind_b as u8, found.element_b)
                    && (other.deepest_b - found.deepest_b).norm() <= step
            };
            leads_on(touched(found) + found.normal_b * step) && group.iter().any(has_end)
        } else {
            let along = (ends[1] - ends[0]).normalize() * step;
            leads_on(found.deepest_b + along) || leads_on(found.deepest_b - along)
        };
        if is_dropped {
            group[index].status = CandidateStatus::Culled;
        }
    }
}

fn is_inside(piece: &Polyhedron, place: &Vec3) -> bool {
    piece.faces.iter().all(|face| face.height(place) <= 0.0)
}
