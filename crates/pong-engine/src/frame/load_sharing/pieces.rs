//! Which contacts of one ellipsoid with the pieces of one body count: those that the uncut body would have.

use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use pong_geometry::Vec3;
use pong_geometry::primitive::Polyhedron;

/// Relative: depths this close are one depth, so that rounding does not choose between two features.
const DEPTH_SLACK: f64 = 1e-12;
/// Relative to the distance of two places: how far in front of a plane a place counts as in it. A fold that single
/// precision can hold is steeper.
const PLANE_SLACK: f64 = 1e-9;
/// Relative to the coordinates: places this close are one place, where the pieces of a flat face meet.
const PLACE_SLACK: f64 = 1e-9;

/// Marks as dropped what an ellipsoid would not have on the uncut body (`group`: its contacts with the pieces of one
/// body).
///
/// A piece finds the least overlap among its own features. Of two pieces' features that meet convexly, only the less
/// deep is the minimum translation; features that meet concavely, as two walls of a corner, are overcome each for itself.
/// A contact that only stands in for a piece counts if there is none but such.
pub(crate) fn drop_what_the_body_lacks(group: &mut [ContactCandidate], pieces: &[Polyhedron]) {
    let stands_in = |contact: &ContactCandidate| contact.status == CandidateStatus::StandIn;
    if !group.iter().all(stands_in) {
        group
            .iter_mut()
            .filter(|contact| stands_in(contact))
            .for_each(|contact| contact.status = CandidateStatus::Culled);
    }
    for i in 0..group.len() {
        let contact = &group[i];
        let is_covered = group.iter().any(|other| {
            let counts = other.status != CandidateStatus::Culled;
            counts && pushes_before(other, contact) && meet_convexly(contact, other, pieces)
        });
        if contact.status != CandidateStatus::Culled && is_covered {
            group[i].status = CandidateStatus::Culled;
        }
    }
}

/// Whether the first contact is less deep; of two equally deep ones the first in the order of sums is.
pub(crate) fn pushes_before(contact: &ContactCandidate, other: &ContactCandidate) -> bool {
    let rounding = DEPTH_SLACK * other.depth;
    let difference = contact.depth - other.depth;
    difference < -rounding || (difference <= rounding && contact.order() < other.order())
}

/// Whether what is touched belongs to one convex body.
fn meet_convexly(contact: &ContactCandidate, other: &ContactCandidate, pieces: &[Polyhedron]) -> bool {
    if contact.status == CandidateStatus::StandIn && other.status == CandidateStatus::StandIn {
        // The feet lie beside the pieces and say nothing; the faces themselves do.
        return lies_below(contact, other, pieces) && lies_below(other, contact, pieces);
    }
    touch_convexly(contact, other)
}

/// Whether the features of two contacts belong to one convex body, by the places that are touched.
///
/// Of two that are touched in one place neither lies below the other. An edge or a vertex that pushes is convex; two faces
/// may meet flat or concavely there.
pub(super) fn touch_convexly(contact: &ContactCandidate, other: &ContactCandidate) -> bool {
    let (here, there) = (touched(contact), touched(other));
    if are_one_place(&here, &there) {
        return !contact.feature.is_face() || !other.feature.is_face();
    }
    are_convex([&here, &there], [&contact.normal, &other.normal])
}

/// Whether two places belong to one convex body: each lies below the plane through the other across its normal, or in it.
/// To push out of either is then to push out of both. One place does not.
pub(super) fn are_convex([here, there]: [&Vec3; 2], [normal, other_normal]: [&Vec3; 2]) -> bool {
    let apart = there - here;
    let distance = apart.norm();
    !are_one_place(here, there)
        && normal.dot(&apart) <= PLANE_SLACK * distance
        && other_normal.dot(&apart) >= -PLANE_SLACK * distance
}

/// Whether only rounding keeps two places apart.
pub(super) fn are_one_place(here: &Vec3, there: &Vec3) -> bool {
    (there - here).norm() <= PLACE_SLACK * (here.amax() + there.amax())
}

/// Where A's deepest point comes to lie once it is pushed out.
pub(super) fn touched(contact: &ContactCandidate) -> Vec3 {
    contact.point_a + contact.normal * contact.depth
}

/// Whether the face of one contact lies below the plane of another, or in it.
fn lies_below(of: &ContactCandidate, other: &ContactCandidate, pieces: &[Polyhedron]) -> bool {
    let piece = &pieces[of.element_b as usize];
    let plane = &pieces[other.element_b as usize].faces[other.feature.index()];
    let corners = piece.rim(of.feature.index()).iter().map(|rim| piece.vertices[rim.start as usize].position);
    corners.map(|corner| plane.height(&corner)).fold(f64::NEG_INFINITY, f64::max)
        <= PLANE_SLACK * piece.diameter
}
