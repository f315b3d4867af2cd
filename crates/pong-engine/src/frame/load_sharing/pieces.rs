//! Which contacts of one ellipsoid or sphere with the pieces of one body count: those that the uncut body would have.

use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::state::{ContactRole, NO_FACE};
use pong_geometry::Vec3;
use pong_geometry::interference::FeatureKind;
use pong_geometry::primitive::Polyhedron;

/// Relative: depths this close are one depth, so that rounding does not choose between two features.
const DEPTH_SLACK: f64 = 1e-12;
/// Relative to the distance of two places: how far in front of a plane a place counts as in it. A fold that single
/// precision can hold is steeper.
const PLANE_SLACK: f64 = 1e-9;
/// Relative to the coordinates: by how much rounding alone moves a place, some tens of units in the last place.
const ROUNDING: f64 = 1e-14;
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
    let mut last = None;
    while let Some(i) = next_deeper(group, last) {
        last = Some(i);
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

/// The least deep of the contacts that are deeper than the one at `last`; of equally deep ones they follow each other in
/// their order. What covers a contact is thus known to count itself before it is asked: otherwise the order of the model
/// would decide where one contact is covered by a second, and the second by a third.
pub(super) fn next_deeper(group: &[ContactCandidate], last: Option<usize>) -> Option<usize> {
    let place = |index: usize| (group[index].depth, index);
    let follows = |index: &usize| last.is_none_or(|last| place(*index) > place(last));
    let less = |a: usize, b: usize| if place(b) < place(a) { b } else { a };
    (0..group.len()).filter(follows).reduce(less)
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
    if contact.feature.is_face()
        && other.feature.is_face()
        && are_one_place(&touched(contact), &touched(other))
    {
        // Where the pieces meet, two faces are touched in one place: that says nothing, the faces themselves do.
        return lies_below(contact, other, pieces) && lies_below(other, contact, pieces);
    }
    is_part_of(contact, other, pieces) || is_part_of(other, contact, pieces) || touch_convexly(contact, other)
}

/// Whether the first contact is of an edge or a vertex of the face or the edge of the second. What pushes there is convex; the
/// places say less, since corners in single precision may lie in front of the plane.
fn is_part_of(contact: &ContactCandidate, other: &ContactCandidate, pieces: &[Polyhedron]) -> bool {
    let piece = &pieces[contact.element_b as usize];
    let is_corner = |vertex: u32| has_corner(other, &piece.vertices[vertex as usize].position, pieces);
    match contact.feature.kind() {
        FeatureKind::Face => false,
        FeatureKind::Edge => piece.edges[contact.feature.index()].vertices.iter().all(|v| is_corner(*v)),
        FeatureKind::Vertex => is_corner(contact.feature.index() as u32),
    }
}

/// Whether a face or an edge that pushes has a corner at a place.
fn has_corner(contact: &ContactCandidate, place: &Vec3, pieces: &[Polyhedron]) -> bool {
    let (piece, index) = (&pieces[contact.element_b as usize], contact.feature.index());
    let is_there = |vertex: u32| piece.vertices[vertex as usize].position == *place;
    match contact.feature.kind() {
        FeatureKind::Face => piece.rim(index).iter().any(|rim| is_there(rim.start)),
        FeatureKind::Edge => piece.edges[index].vertices.iter().any(|vertex| is_there(*vertex)),
        FeatureKind::Vertex => false,
    }
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
    are_convex([&here, &there], [&contact.normal_b, &other.normal_b])
}

/// Whether two places belong to one convex body: each lies below the plane through the other across its normal, or in it.
/// To push out of either is then to push out of both. One place does not.
pub(super) fn are_convex([here, there]: [&Vec3; 2], [normal, other_normal]: [&Vec3; 2]) -> bool {
    let apart = there - here;
    let slack = plane_slack(here, there);
    !are_one_place(here, there) && normal.dot(&apart) <= slack && other_normal.dot(&apart) >= -slack
}

/// Whether each of two places lies in the plane through the other across its normal.
pub(super) fn are_in_both_planes([here, there]: [&Vec3; 2], normals: [&Vec3; 2]) -> bool {
    let apart = there - here;
    let slack = plane_slack(here, there);
    normals.iter().all(|normal| normal.dot(&apart).abs() <= slack)
}

/// How far in front of a plane through one place another counts as in it, m.
fn plane_slack(here: &Vec3, there: &Vec3) -> f64 {
    PLANE_SLACK * (there - here).norm() + ROUNDING * (here.amax() + there.amax())
}

/// Whether only rounding keeps two places apart.
pub(super) fn are_one_place(here: &Vec3, there: &Vec3) -> bool {
    (there - here).norm() <= PLACE_SLACK * (here.amax() + there.amax())
}

/// Where A's deepest point comes to lie once it is pushed out.
pub(super) fn touched(contact: &ContactCandidate) -> Vec3 {
    contact.deepest_b + contact.normal_b * contact.depth
}

/// Whether the face of one contact lies below the plane of another, or in it.
fn lies_below(of: &ContactCandidate, other: &ContactCandidate, pieces: &[Polyhedron]) -> bool {
    let piece = &pieces[of.element_b as usize];
    let plane = &pieces[other.element_b as usize].faces[other.feature.index()];
    let corners = piece.rim(of.feature.index()).iter().map(|rim| piece.vertices[rim.start as usize].position);
    corners.map(|corner| plane.height(&corner)).fold(f64::NEG_INFINITY, f64::max)
        <= PLANE_SLACK * piece.diameter
}

/// Marks as dropped what a sphere has twice on a convex edge in which a wall ends (`group`: its contacts with the pieces of one
/// body).
///
/// A centre on such an edge lies in the planes of the faces on both sides, and each of them belongs to another piece. Where
/// corners are rounded to single precision, the outlines of the two overlap. The uncut body has one contact there: the less deep
/// counts.
pub(super) fn drop_second_of_edges(group: &mut [ContactCandidate], radius: f64, pieces: &[Polyhedron]) {
    let is_on_surface = |contact: &ContactCandidate| {
        let slack = pieces[contact.element_b as usize].planes().wall_slack;
        let counts = contact.status != CandidateStatus::Culled && contact.role == ContactRole::Active;
        counts && (contact.depth - radius).abs() <= slack
    };
    for i in 0..group.len() {
        let contact = &group[i];
        if !is_on_surface(contact) {
            continue;
        }
        let is_second = group.iter().any(|other| {
            is_on_surface(other)
                && other.element_b != contact.element_b
                && pushes_before(other, contact)
                && share_an_edge(contact, other, radius, pieces)
        });
        if is_second && contact.entry_face != NO_FACE {
            group[i].role = ContactRole::Tracked;
        } else if is_second {
            group[i].status = CandidateStatus::Culled;
        }
    }
}

/// Whether the centre of a sphere lies on one convex edge for both of its contacts.
fn share_an_edge(
    contact: &ContactCandidate,
    other: &ContactCandidate,
    radius: f64,
    pieces: &[Polyhedron],
) -> bool {
    edges_under(contact, radius, pieces)
        .any(|ends| edges_under(other, radius, pieces).any(|other_ends| ends == other_ends))
}

/// The ends of the convex edges that the centre of a sphere lies on, of those that what pushes it has.
fn edges_under<'p>(
    contact: &ContactCandidate,
    radius: f64,
    pieces: &'p [Polyhedron],
) -> impl Iterator<Item = [Vec3; 2]> + use<'p> {
    let piece = &pieces[contact.element_b as usize];
    let (feature, center) = (contact.feature, contact.deepest_b + contact.normal_b * radius);
    let slack = piece.planes().wall_slack;
    let face = if feature.is_face() { piece.rim(feature.index()) } else { &[] };
    let of_face = face.iter().filter(move |rim| rim.outward.dot(&(center - rim.anchor)).abs() <= slack);
    let alone = (feature.kind() == FeatureKind::Edge).then_some(feature.index());
    of_face
        .map(|rim| rim.edge as usize)
        .chain(alone)
        .map(|edge| &piece.edges[edge])
        .filter(|edge| edge.convex.is_some())
        .map(|edge| edge.vertices.map(|vertex| piece.vertices[vertex as usize].position))
}
