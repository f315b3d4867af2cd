//! Load sharing: decides which candidates of a chunk of A count, and with which weight.

mod capsules;
mod exits;
mod pieces;
mod ray_hits;
mod rims;
pub(crate) mod solver;
pub(crate) mod status;

use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::frame::narrow_phase::element_pair::BETWEEN_ENDS;
use crate::state::{ContactRole, NO_FACE};
use capsules::couple;
use exits::{is_exit_that_stands_in, keep_one_of_exits};
use pieces::{
    are_convex, are_in_both_planes, are_one_place, drop_second_of_edges, drop_what_the_body_lacks,
    next_deeper, pushes_before, touch_convexly, touched,
};
use pong_arena::{Arena, Full, Table};
use pong_geometry::Vec3;
use pong_geometry::interference::nearest_on_triangle::nearest_in_plane;
use pong_geometry::interference::triangle_features::{EdgeClass, TriangleView};
use pong_geometry::primitive::{Containment, Polyhedron, PolyhedronFace, PrimitiveKind, TriangleSet};
use ray_hits::keep_first_ray_hits;
use rims::{keep_one_side_of_rims, keep_one_way_at_places};
use solver::{SharedContact, share_within};

/// Relative difference below which two depths count as equal.
const FALLBACK_DEPTH_SLACK: f64 = 1e-9;

/// Sorts the candidates of a chunk into summation order, assigns their weights, and culls those that do not
/// count. All elements of the chunk are of one kind, and all contacts of a key are in one chunk.
///
/// # Errors
/// [`Full`] if the scratch memory was too small for one surface; then its deepest contacts have been shared
/// exactly.
pub(crate) fn assign_weights(
    context: &PairContext<'_>,
    kind_a: PrimitiveKind,
    found: &mut Table<ContactCandidate>,
    shared_contacts: &mut Table<SharedContact>,
    scratch: &mut Arena,
) -> Result<(), Full> {
    if let [alone] = &mut found[..]
        && !is_under_capsule(alone)
    {
        // A single contact keeps weight 1. If it lies beyond an internal face, no piece exists there.
        if alone.status == CandidateStatus::BeyondWall {
            alone.status = CandidateStatus::Culled;
        }
        return Ok(());
    }
    let mut outcome = Ok(());
    found.sort_unstable_by_key(ContactCandidate::order);
    match kind_a {
        PrimitiveKind::Ray => keep_first_ray_hits(found, context),
        PrimitiveKind::Sphere | PrimitiveKind::Ellipsoid => {
            keep_one_side_of_rims(found, context);
            keep_one_way_at_places(found);
        }
        // The front and the back are separate surfaces; resolve their common rim before each shares.
        PrimitiveKind::Capsule => keep_one_side_of_rims(found, context),
        _ => {}
    }
    if kind_a == PrimitiveKind::Capsule {
        return share_capsules(found, context, shared_contacts, scratch);
    }
    for group in found.chunk_by_mut(|a, b| a.key == b.key) {
        settle_group(group, kind_a, context);
        if group[0].shares && group.len() > 1 {
            outcome = outcome.and(find_shares(group, &context.body_b.triangles, shared_contacts, scratch));
            drop_idle(group);
        }
    }
    outcome
}

/// Assigns the weights of contacts of capsules, in summation order. The end spheres share as spheres do, each
/// with half a spring.
fn share_capsules(
    found: &mut [ContactCandidate],
    context: &PairContext<'_>,
    shared_contacts: &mut Table<SharedContact>,
    scratch: &mut Arena,
) -> Result<(), Full> {
    let mut outcome = Ok(());
    let surface = |found: &ContactCandidate| (found.key.head(), found.key.shell_b);
    for body in found.chunk_by_mut(|a, b| surface(a) == surface(b)) {
        let edges = body.partition_point(|found| found.key.end < BETWEEN_ENDS);
        // Contacts with round solids and planes already have their weights.
        if !body[0].shares {
            continue;
        }
        let (ends, middle) = body.split_at_mut(edges);
        for end in ends.chunk_by_mut(|a, b| a.key == b.key) {
            keep_one_way_at_places(end);
            settle_group(end, PrimitiveKind::Sphere, context);
            if end.len() > 1 {
                outcome = outcome.and(find_shares(end, &context.body_b.triangles, shared_contacts, scratch));
            }
        }
        if !middle.is_empty() {
            couple(ends, middle);
        }
        ends.chunk_by_mut(|a, b| a.key == b.key).filter(|end| end.len() > 1).for_each(drop_idle);
    }
    outcome
}

/// Returns true for the contact of a capsule's axis with an edge between its ends.
fn is_under_capsule(contact: &ContactCandidate) -> bool {
    contact.shares && contact.half && contact.key.end == BETWEEN_ENDS
}

/// Resolves the contacts of one key with one body before load sharing.
fn settle_group(group: &mut [ContactCandidate], kind_a: PrimitiveKind, context: &PairContext<'_>) {
    if group.iter().any(is_at_wall) {
        match group[0].half && !group[0].shares {
            true => choose_piece_of_end_at_walls(group, context),
            false => choose_piece_at_walls(group, context),
        }
    }
    if !group[0].shares || group.len() == 1 {
        return;
    }
    settle_fallbacks(group, kind_a);
    match (kind_a, group[0].kind_b) {
        (PrimitiveKind::Ellipsoid, PrimitiveKind::Polyhedron) => {
            drop_what_the_body_lacks(group, &context.body_b.polyhedra);
        }
        (PrimitiveKind::Sphere, PrimitiveKind::Polyhedron) => {
            let (_, radius) = ball_of(&group[0], context);
            drop_second_of_edges(group, radius, &context.body_b.polyhedra);
        }
        (PrimitiveKind::Ellipsoid, PrimitiveKind::Triangle) => drop_deeper_faces(group),
        _ => {}
    }
}

/// Centre in A's frame and radius of the sphere, or of a capsule's end sphere, m.
fn ball_of(contact: &ContactCandidate, context: &PairContext<'_>) -> (Vec3, f64) {
    let (body_a, element) = (context.body_a, contact.element_a as usize);
    if contact.half {
        let capsule = &body_a.capsules[element];
        return (capsule.ends[contact.key.end as usize], capsule.radius);
    }
    let sphere = &body_a.spheres[element];
    (sphere.center, sphere.radius)
}

fn is_at_wall(contact: &ContactCandidate) -> bool {
    matches!(contact.status, CandidateStatus::AtWall | CandidateStatus::BeyondWall)
        || is_exit_that_stands_in(contact)
}

/// Selects the piece for a point or sphere centre at internal faces of a body. Each piece decides for itself,
/// with rounding, on which side of its internal faces the point lies, so several pieces may claim it, or
/// none.
///
/// The first piece that contains the point counts. If none does, rounding has opened a gap between pieces:
/// the first piece whose neighbours are all present counts. Without these neighbours the point is outside the
/// body, beside a convex edge at which an internal face ends.
fn choose_piece_at_walls(group: &mut [ContactCandidate], context: &PairContext<'_>) {
    let in_piece = |contact: &ContactCandidate| {
        contact.entry_face != NO_FACE && contact.status != CandidateStatus::BeyondWall
    };
    let first = group.iter().position(in_piece).or_else(|| {
        let found = &group[0];
        let local = match found.shares {
            true => ball_of(found, context).0,
            false => context.body_a.points[found.element_a as usize].position,
        };
        let point = context.motion.x_ba.point(&local);
        group.iter().position(|contact| has_neighbors_at_walls(contact, &point, context))
    });
    for (index, contact) in group.iter_mut().enumerate() {
        if is_at_wall(contact) && first != Some(index) {
            contact.status = CandidateStatus::Culled;
        }
    }
}

/// Selects the piece for a segment's end at internal faces of a body, in the same way. Only contacts with
/// exactly this end point are compared; where the segment crosses an edge, each piece finds another point.
fn choose_piece_of_end_at_walls(group: &mut [ContactCandidate], context: &PairContext<'_>) {
    keep_one_of_exits(group, context);
    keep_first_of_edges(group, &context.body_b.polyhedra);
    let Some(endpoint) = group.iter().find(|found| is_at_wall(found) && found.feature.is_face()) else {
        return;
    };
    let endpoint = endpoint.deepest_b;
    let in_piece = |found: &ContactCandidate| {
        let counts = !matches!(found.status, CandidateStatus::BeyondWall | CandidateStatus::Culled);
        counts && found.deepest_b == endpoint
    };
    let first = group
        .iter()
        .position(in_piece)
        .or_else(|| group.iter().position(|found| has_neighbors_at_walls(found, &endpoint, context)));
    for (index, found) in group.iter_mut().enumerate() {
        if found.deepest_b == endpoint && first != Some(index) {
            found.status = CandidateStatus::Culled;
        }
    }
}

/// Keeps the first of equal edge contacts: the pieces on both sides of an internal face both find the edge in
/// which it ends.
fn keep_first_of_edges(group: &mut [ContactCandidate], polyhedra: &[Polyhedron]) {
    let is_edge =
        |found: &ContactCandidate| found.status == CandidateStatus::AtWall && !found.feature.is_face();
    let ends = |found: &ContactCandidate| {
        let piece = &polyhedra[found.element_b as usize];
        piece.edges[found.feature.index()].vertices.map(|vertex| piece.vertices[vertex as usize].position)
    };
    for index in 1..group.len() {
        let (before, found) = (&group[..index], &group[index]);
        if is_edge(found) && before.iter().any(|other| is_edge(other) && ends(other) == ends(found)) {
            group[index].status = CandidateStatus::Culled;
        }
    }
}

/// Returns true if another piece contains the point, or has it on its surface, at each of the piece's
/// internal faces there.
fn has_neighbors_at_walls(found: &ContactCandidate, place: &Vec3, context: &PairContext<'_>) -> bool {
    if found.status != CandidateStatus::BeyondWall {
        return false;
    }
    let body = context.body_b;
    let holds = |piece: &Polyhedron| piece.containment(place) != Containment::Outside;
    // The two sides of an internal face have bit-identical planes.
    let has_twin = |wall: &PolyhedronFace| {
        let is_twin = |face: &PolyhedronFace| face.normal == -wall.normal && face.offset == -wall.offset;
        let pieces = body.polyhedra.iter().filter(|piece| piece.faces.iter().any(is_twin));
        pieces.into_iter().any(holds)
    };
    body.polyhedra[found.element_b as usize].walls_at(place).all(has_twin)
}

/// Computes the weights of the contacts of one sphere or ellipsoid with one surface.
fn find_shares(
    group: &mut [ContactCandidate],
    triangles: &TriangleSet,
    shared_contacts: &mut Table<SharedContact>,
    scratch: &mut Arena,
) -> Result<(), Full> {
    drop_deeper_of_convex_faces(group, triangles);
    cull_idle_stand_ins(group);
    shared_contacts.clear();
    for contact in group.iter().filter(|contact| contact.takes_part()) {
        let shared_contact = SharedContact::new(contact.normal_b, contact.depth);
        shared_contacts.push(shared_contact).expect("as much room as for what was found");
    }
    let outcome = share_within(shared_contacts, scratch);
    for (contact, shared_contact) in group.iter_mut().filter(|c| c.takes_part()).zip(shared_contacts.iter()) {
        contact.weight = shared_contact.lambda / shared_contact.depth;
    }
    outcome
}

/// Contacts without load become `Tracked` if they have to be remembered, and are culled otherwise.
fn drop_idle(group: &mut [ContactCandidate]) {
    for contact in group.iter_mut().filter(|contact| contact.takes_part()) {
        if contact.weight > 0.0 {
            continue;
        }
        if contact.entry_face != NO_FACE || contact.status == CandidateStatus::BackFace {
            contact.role = ContactRole::Tracked;
        } else {
            contact.status = CandidateStatus::Culled;
        }
    }
}

/// Resolves fallback candidates: one becomes regular if no regular contact is at its point, because rounding
/// then made the regular one miss.
///
/// A sphere's contact at another point does not replace it, at whatever depth. For an ellipsoid, a deeper
/// contact at the same point is another minimum and does not replace it either.
fn settle_fallbacks(group: &mut [ContactCandidate], kind_a: PrimitiveKind) {
    let is_fallback = |contact: &ContactCandidate| {
        matches!(contact.status, CandidateStatus::Fallback | CandidateStatus::BackFaceFallback)
    };
    let counts = |contact: &ContactCandidate| {
        matches!(contact.status, CandidateStatus::Front | CandidateStatus::BackFace)
    };
    if !group.iter().any(is_fallback) {
        return;
    }
    // Faces first: if rounding made both a face and its edge miss one point, only the face gives way to a
    // less deep contact.
    let count = group.len();
    for (is_face, i) in [true, false].into_iter().flat_map(|is_face| (0..count).map(move |i| (is_face, i))) {
        let fallback = &group[i];
        if !is_fallback(fallback) || fallback.feature.is_face() != is_face {
            continue;
        }
        let (least, place) = (fallback.depth * (1.0 - FALLBACK_DEPTH_SLACK), touched(fallback));
        let most = match kind_a {
            PrimitiveKind::Ellipsoid => fallback.depth * (1.0 + FALLBACK_DEPTH_SLACK),
            _ => f64::INFINITY,
        };
        let has_place = |other: &ContactCandidate| {
            let pushes = counts(other) && other.role == ContactRole::Active;
            pushes && (least..=most).contains(&other.depth) && are_one_place(&touched(other), &place)
        };
        group[i].status = match (group.iter().any(has_place), fallback.status) {
            (true, _) => CandidateStatus::Culled,
            (false, CandidateStatus::BackFaceFallback) => CandidateStatus::BackFace,
            (false, _) => CandidateStatus::Front,
        };
    }
}

/// Drops the deeper of two convexly meeting features at which a deep ellipsoid has a minimum, if it is a
/// face, or if the centre is behind it. The test uses positions, not mesh adjacency, because a cut face may
/// have lost the edge that it shares with the other feature.
fn drop_deeper_faces(group: &mut [ContactCandidate]) {
    let counts = |contact: &ContactCandidate| {
        contact.role == ContactRole::Active
            && matches!(contact.status, CandidateStatus::Front | CandidateStatus::BackFace)
    };
    let mut last = None;
    while let Some(i) = next_deeper(group, last) {
        last = Some(i);
        let contact = &group[i];
        let may_yield = is_triangles_face(contact) || contact.status == CandidateStatus::BackFace;
        if !counts(contact) || !may_yield {
            continue;
        }
        let covers = |other: &ContactCandidate| {
            counts(other) && pushes_before(other, contact) && touch_convexly(contact, other)
        };
        if group.iter().any(covers) {
            match group[i].status {
                CandidateStatus::BackFace => group[i].role = ContactRole::Tracked,
                _ => group[i].status = CandidateStatus::Culled,
            }
        }
    }
}

/// With the centre behind it, a face yields to a less deep face that meets it convexly, as in a polyhedron,
/// and to such an edge or vertex. A centre on the rim of a front face is behind the next face only by
/// rounding.
fn drop_deeper_of_convex_faces(group: &mut [ContactCandidate], triangles: &TriangleSet) {
    if !group.iter().any(|contact| contact.status == CandidateStatus::BackFace) {
        return;
    }
    let mut last = None;
    while let Some(i) = next_deeper(group, last) {
        last = Some(i);
        let contact = &group[i];
        if contact.status != CandidateStatus::BackFace || !is_triangles_face(contact) {
            continue;
        }
        let is_covered = group.iter().any(|other| {
            let counts = other.role == ContactRole::Active && other.status != CandidateStatus::Culled;
            let meet = || match is_triangles_face(other) {
                true => meet_in_an_edge(contact, other, triangles) || meet_below(contact, other, triangles),
                false => touch_convexly(contact, other),
            };
            counts && pushes_before(other, contact) && meet()
        });
        if is_covered {
            group[i].role = ContactRole::Tracked;
        }
    }
}

fn is_triangles_face(contact: &ContactCandidate) -> bool {
    contact.kind_b == PrimitiveKind::Triangle && contact.feature.is_face()
}

/// Returns true if the triangles of two contacts share a convex edge.
fn meet_in_an_edge(contact: &ContactCandidate, other: &ContactCandidate, triangles: &TriangleSet) -> bool {
    let neighbors = &triangles.triangles[contact.element_b as usize].neighbors;
    let edge = neighbors.iter().position(|neighbor| *neighbor == other.element_b);
    edge.is_some_and(|k| {
        let view = TriangleView::new(triangles, contact.element_b);
        matches!(view.classify_edge(triangles, k), EdgeClass::Convex { .. })
    })
}

/// Returns true if two faces meet convexly, with any number of triangles between them: the contact point of
/// each lies below the plane of the other. At a concave edge it lies above. In the wedge behind a concave
/// edge both contact points are on the edge, or in coplanar pieces, and the faces do not count as convex.
fn meet_below(contact: &ContactCandidate, other: &ContactCandidate, triangles: &TriangleSet) -> bool {
    let on = |of: &ContactCandidate| nearest_in_plane(&touched(of), &triangles.corners(of.element_b));
    let (places, normals) = ([&on(contact), &on(other)], [&contact.normal_b, &other.normal_b]);
    are_convex(places, normals) && !are_in_both_planes(places, normals)
}

/// Culls `StandIn` candidates unless no regular contact is as deep.
fn cull_idle_stand_ins(group: &mut [ContactCandidate]) {
    let deepest = group
        .iter()
        .filter(|contact| !matches!(contact.status, CandidateStatus::StandIn | CandidateStatus::Culled))
        .filter(|contact| contact.role == ContactRole::Active)
        .map(|contact| contact.depth)
        .fold(0.0, f64::max);
    for contact in group.iter_mut().filter(|contact| contact.status == CandidateStatus::StandIn) {
        if deepest >= contact.depth * (1.0 - FALLBACK_DEPTH_SLACK) {
            contact.status = CandidateStatus::Culled;
        }
    }
}
