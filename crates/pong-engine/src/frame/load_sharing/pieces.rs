//! Drops contacts that an ellipsoid or sphere has with the pieces of a body, but would not have with the
//! uncut body.

use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::state::{ContactRole, NO_FACE};
use pong_geometry::Vec3;
use pong_geometry::interference::FeatureKind;
use pong_geometry::primitive::Polyhedron;

/// Relative difference up to which two depths count as equal, so that rounding does not select the feature.
const DEPTH_SLACK: f64 = 1e-12;
/// Height above a plane up to which a point counts as in the plane, relative to its distance from the point
/// that defines the plane. A fold that single precision can represent is steeper, so it does not count as
/// flat.
const PLANE_SLACK: f64 = 1e-9;
/// Rounding error of a position, relative to the coordinates: some tens of units in the last place.
const ROUNDING: f64 = 1e-14;
/// Distance up to which two points count as equal, relative to the coordinates; it covers the rounding where
/// pieces of a flat face meet.
const PLACE_SLACK: f64 = 1e-9;

/// Culls contacts that an ellipsoid would not have with the uncut body. `group` has the ellipsoid's contacts
/// with the pieces of one body.
///
/// Each piece reports the minimum translation over its own features. If two features of different pieces meet
/// convexly, only the less deep one is a minimum translation of the whole body. Features that meet concavely,
/// such as two walls of a corner, each push. `StandIn` candidates count only if there are no others.
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

/// Index of the next contact after `last`, by increasing depth and then by index; `None` after the last
/// contact. In this order every contact is judged after all contacts that may cull it, so the result does not
/// depend on the order of the model.
pub(super) fn next_deeper(group: &[ContactCandidate], last: Option<usize>) -> Option<usize> {
    let place = |index: usize| (group[index].depth, index);
    let follows = |index: &usize| last.is_none_or(|last| place(*index) > place(last));
    let less = |a: usize, b: usize| if place(b) < place(a) { b } else { a };
    (0..group.len()).filter(follows).reduce(less)
}

/// Returns true if `contact` is less deep than `other` or, at equal depths, comes first in summation order.
pub(crate) fn pushes_before(contact: &ContactCandidate, other: &ContactCandidate) -> bool {
    let rounding = DEPTH_SLACK * other.depth;
    let difference = contact.depth - other.depth;
    difference < -rounding || (difference <= rounding && contact.order() < other.order())
}

/// Returns true if the features of two contacts meet convexly.
fn meet_convexly(contact: &ContactCandidate, other: &ContactCandidate, pieces: &[Polyhedron]) -> bool {
    if contact.status == CandidateStatus::StandIn && other.status == CandidateStatus::StandIn {
        // The foot points of `StandIn` candidates lie outside their faces and show nothing, so the faces
        // themselves are compared.
        return lies_below(contact, other, pieces) && lies_below(other, contact, pieces);
    }
    if contact.feature.is_face()
        && other.feature.is_face()
        && are_one_place(&touched(contact), &touched(other))
    {
        // Equal contact points, where pieces meet, show nothing about the angle between two faces, so the
        // faces themselves are compared.
        return lies_below(contact, other, pieces) && lies_below(other, contact, pieces);
    }
    is_part_of(contact, other, pieces) || is_part_of(other, contact, pieces) || touch_convexly(contact, other)
}

/// Returns true if `contact` is at an edge or vertex that belongs to the face or edge of `other`. Two such
/// features meet convexly. Vertices are compared instead of heights, because corners in single precision may
/// lie above the plane of their face.
fn is_part_of(contact: &ContactCandidate, other: &ContactCandidate, pieces: &[Polyhedron]) -> bool {
    let piece = &pieces[contact.element_b as usize];
    let is_corner = |vertex: u32| has_corner(other, &piece.vertices[vertex as usize].position, pieces);
    match contact.feature.kind() {
        FeatureKind::Face => false,
        FeatureKind::Edge => piece.edges[contact.feature.index()].vertices.iter().all(|v| is_corner(*v)),
        FeatureKind::Vertex => is_corner(contact.feature.index() as u32),
    }
}

/// Returns true if the face or edge of a contact has a vertex at a position.
fn has_corner(contact: &ContactCandidate, place: &Vec3, pieces: &[Polyhedron]) -> bool {
    let (piece, index) = (&pieces[contact.element_b as usize], contact.feature.index());
    let is_there = |vertex: u32| piece.vertices[vertex as usize].position == *place;
    match contact.feature.kind() {
        FeatureKind::Face => piece.rim(index).iter().any(|rim| is_there(rim.start)),
        FeatureKind::Edge => piece.edges[index].vertices.iter().any(|vertex| is_there(*vertex)),
        FeatureKind::Vertex => false,
    }
}

/// Returns true if the features of two contacts meet convexly, judged by their contact points.
///
/// If both contacts have the same contact point, the answer is true if one feature is an edge or a vertex,
/// because an edge or vertex that pushes is convex. It is false for two faces, which may meet flat or
/// concavely.
pub(super) fn touch_convexly(contact: &ContactCandidate, other: &ContactCandidate) -> bool {
    let (here, there) = (touched(contact), touched(other));
    if are_one_place(&here, &there) {
        return !contact.feature.is_face() || !other.feature.is_face();
    }
    are_convex([&here, &there], [&contact.normal_b, &other.normal_b])
}

/// Returns true if two different contact points each lie in or below the plane through the other point and
/// perpendicular to the normal there. Pushing a convex A out at one point then pushes it out at the other
/// too.
pub(super) fn are_convex([here, there]: [&Vec3; 2], [normal, other_normal]: [&Vec3; 2]) -> bool {
    let apart = there - here;
    let slack = plane_slack(here, there);
    !are_one_place(here, there) && normal.dot(&apart) <= slack && other_normal.dot(&apart) >= -slack
}

/// Returns true if each point lies in the plane through the other point and perpendicular to the normal
/// there.
pub(super) fn are_in_both_planes([here, there]: [&Vec3; 2], normals: [&Vec3; 2]) -> bool {
    let apart = there - here;
    let slack = plane_slack(here, there);
    normals.iter().all(|normal| normal.dot(&apart).abs() <= slack)
}

/// Height above a plane through one point up to which the other point counts as in the plane, m.
fn plane_slack(here: &Vec3, there: &Vec3) -> f64 {
    PLANE_SLACK * (there - here).norm() + ROUNDING * (here.amax() + there.amax())
}

/// Returns true if two points differ only by rounding.
pub(super) fn are_one_place(here: &Vec3, there: &Vec3) -> bool {
    (there - here).norm() <= PLACE_SLACK * (here.amax() + there.amax())
}

/// Contact point on the feature of B (the foot), m: the deepest point of A, moved out along the normal by the
/// depth.
pub(super) fn touched(contact: &ContactCandidate) -> Vec3 {
    contact.deepest_b + contact.normal_b * contact.depth
}

/// Returns true if the face of `of` lies in or below the plane of the face of `other`.
fn lies_below(of: &ContactCandidate, other: &ContactCandidate, pieces: &[Polyhedron]) -> bool {
    let piece = &pieces[of.element_b as usize];
    let plane = &pieces[other.element_b as usize].faces[other.feature.index()];
    let corners = piece.rim(of.feature.index()).iter().map(|rim| piece.vertices[rim.start as usize].position);
    corners.map(|corner| plane.height(&corner)).fold(f64::NEG_INFINITY, f64::max)
        <= PLANE_SLACK * piece.diameter
}

/// Drops the deeper of two contacts of a sphere whose centre lies on a convex edge in which an internal face
/// ends. `group` has the sphere's contacts with the pieces of one body.
///
/// The two faces at this edge belong to different pieces, and the centre lies in both of their planes.
/// Corners are rounded to single precision, so the outlines of the faces may overlap, and both faces push.
/// The uncut body has one contact there: the less deep one.
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

/// Returns true if the sphere's centre lies on a convex edge common to the features of both contacts. Edges
/// of two pieces are the same if their end points are equal.
fn share_an_edge(
    contact: &ContactCandidate,
    other: &ContactCandidate,
    radius: f64,
    pieces: &[Polyhedron],
) -> bool {
    edges_under(contact, radius, pieces)
        .any(|ends| edges_under(other, radius, pieces).any(|other_ends| ends == other_ends))
}

/// End points, m, of the convex edges of a contact's feature on which the sphere's centre lies. A face counts
/// with all its edges, an edge as itself.
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
