//! Culls contacts that a two-sided surface would report twice at its rim, which its front and its back share
//! (docs/theory.md, 2.2).

use super::pieces::{are_one_place, touched};
use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::state::ContactRole;
use pong_geometry::primitive::PrimitiveKind;

/// Culls a contact of a back with an edge or vertex of the rim if the front has the same contact.
///
/// Two cases make both sides push with the same edge or vertex. A centre in the plane of a two-sided
/// triangle, outside its rim, is in front of both sides. A centre beyond a vertex of a folded rim may be in
/// front of the front of one face and of the back of another.
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

/// Cosine below which two normals count as opposite; near the contact point, rounding turns the normal.
const OPPOSITE_COSINE_MAX: f64 = -0.999;

/// Culls contacts opposite to a face that has the centre behind it: those that touch the same point and push
/// the opposite way. Where such a face ends, its edge or vertex, or the other side of a two-sided triangle,
/// pushes the opposite way, and rounding may find both contacts.
pub(super) fn cull_opposite_at_points(found: &mut [ContactCandidate]) {
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

/// Returns true if the contact is at a triangle's face and the centre is behind this face.
fn is_behind_a_face(contact: &ContactCandidate) -> bool {
    contact.kind_b == PrimitiveKind::Triangle
        && contact.shares
        && contact.feature.is_face()
        && contact.role == ContactRole::Active
        && matches!(contact.status, CandidateStatus::BackFace | CandidateStatus::BackFaceFallback)
}

/// Returns true if the contact is at an edge or vertex of a back side.
fn is_of_a_back(contact: &ContactCandidate, context: &PairContext<'_>) -> bool {
    contact.kind_b == PrimitiveKind::Triangle
        && contact.shares
        && !contact.feature.is_face()
        && contact.element_b >= context.body_b.primitives[contact.primitive_b as usize].first_mirror
}

/// Relative difference by which rounding may change the depth between the two sides of one edge or vertex.
const SAME_DEPTH_SLACK: f64 = 1e-9;

/// Returns true if `front` is the same edge or vertex contact as `back`, up to rounding. The normals are not
/// compared: if the centre is on the rim, each side has its own normal.
fn is_front_of(front: &ContactCandidate, back: &ContactCandidate) -> bool {
    (front.key.primitive_a, front.key.end) == (back.key.primitive_a, back.key.end)
        && front.primitive_b == back.primitive_b
        && !front.feature.is_face()
        && (front.status, front.role) == (back.status, ContactRole::Active)
        && (front.depth - back.depth).abs() <= SAME_DEPTH_SLACK * back.depth
        && are_one_place(&touched(front), &touched(back))
}
