//! The rim of a two-sided surface, which its front and its back have in common (docs/theory.md, 2.2).

use super::pieces::{are_one_place, touched};
use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::state::ContactRole;
use pong_geometry::primitive::PrimitiveKind;

/// Where a centre lies in the plane of a two-sided triangle, beyond its rim, it is in front of both sides, and beyond a
/// vertex of the rim that is folded it may be in front of two faces on different sides. Both sides then push with the
/// one edge or vertex: the front counts.
pub(super) fn keep_one_side_of_rims(found: &mut [ContactCandidate], context: &PairContext<'_>) {
    for index in 0..found.len() {
        if is_of_a_back(&found[index], context) {
            let back = found[index];
            if found.iter().any(|front| is_front_of(front, &back) && !is_of_a_back(front, context)) {
                found[index].status = CandidateStatus::Culled;
            }
        }
    }
}

/// Cosine below which two normals count as opposite: where the centre is near the place, rounding turns the direction.
const OPPOSITE_COSINE_MAX: f64 = -0.999;

/// No place pushes both ways. Where a face ends that has the centre behind it, the edge or vertex there pushes what is on the
/// other side the opposite way, and so does the other side of a two-sided triangle; on the border rounding may find both:
/// the face that has the centre behind it counts.
pub(super) fn keep_one_way_at_places(found: &mut [ContactCandidate]) {
    for index in 0..found.len() {
        if !is_behind_a_face(&found[index]) {
            continue;
        }
        let behind = found[index];
        let place = touched(&behind);
        let is_opposite = |other: &ContactCandidate| {
            (other.key.primitive_a, other.element_a) == (behind.key.primitive_a, behind.element_a)
                && (other.kind_b, other.role) == (PrimitiveKind::Triangle, ContactRole::Active)
                && other.normal_b.dot(&behind.normal_b) < OPPOSITE_COSINE_MAX
                && are_one_place(&touched(other), &place)
        };
        for other in found.iter_mut().filter(|other| is_opposite(other)) {
            other.status = CandidateStatus::Culled;
        }
    }
}

/// Whether a face pushes a centre that is behind it.
fn is_behind_a_face(contact: &ContactCandidate) -> bool {
    contact.kind_b == PrimitiveKind::Triangle
        && contact.shares
        && contact.feature.is_face()
        && contact.role == ContactRole::Active
        && matches!(contact.status, CandidateStatus::BackFace | CandidateStatus::BackFaceFallback)
}

/// Whether an edge or a vertex of a back pushes.
fn is_of_a_back(contact: &ContactCandidate, context: &PairContext<'_>) -> bool {
    contact.kind_b == PrimitiveKind::Triangle
        && contact.shares
        && !contact.feature.is_face()
        && contact.element_b >= context.body_b.primitives[contact.primitive_b as usize].first_mirror
}

/// Relative: what rounding leaves between the depths of one place, seen from both sides.
const SAME_DEPTH_SLACK: f64 = 1e-9;

/// Whether the same edge or vertex pushes as much, for all that rounding can tell: where a centre is on the rim itself, the
/// direction is each side's own.
fn is_front_of(front: &ContactCandidate, back: &ContactCandidate) -> bool {
    (front.key.primitive_a, front.key.end) == (back.key.primitive_a, back.key.end)
        && front.primitive_b == back.primitive_b
        && !front.feature.is_face()
        && (front.status, front.role) == (back.status, ContactRole::Active)
        && (front.depth - back.depth).abs() <= SAME_DEPTH_SLACK * back.depth
        && are_one_place(&touched(front), &touched(back))
}
