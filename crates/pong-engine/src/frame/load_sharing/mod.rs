//! Which of the interferences found for a chunk of A count, and with what weight.

mod capsules;
mod exits;
mod pieces;
mod ray_hits;
mod rims;
pub(crate) mod solver;

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

/// Relative: depths this close are as deep as each other.
const FALLBACK_DEPTH_SLACK: f64 = 1e-9;

/// Sorts the contacts of a chunk, whose elements are of one kind, into the order of every sum and assigns their weights. Those
/// that do not count are marked as dropped. All contacts of a key are among those of one chunk.
///
/// # Errors
/// `Full` if the scratch memory was too small for one surface: the deepest of its contacts were shared.
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
        // It has nothing to share with and keeps the weight 1; nor is there a piece behind the wall.
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
        // Front and back are two surfaces: what they have in common is told before each shares.
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

/// Assigns the weights of contacts of capsules, in the order of sums: the balls at their ends share as spheres do, each with half a
/// spring.
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
        // What lies on round solids and planes has three contacts with weights of their own.
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

/// Whether a contact is that of an edge which a capsule crosses.
fn is_under_capsule(contact: &ContactCandidate) -> bool {
    contact.shares && contact.half && contact.key.end == BETWEEN_ENDS
}

/// Of the contacts of a key, those that one body has.
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

/// Centre, in A's frame, and radius of the sphere, or of the ball at the end of a capsule, m.
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

/// A point (or a sphere's centre) at inner walls of a body is in one of its pieces, whatever rounding says: where several
/// walls meet, each piece works out by itself on which side of its own walls the point is.
///
/// Of the pieces that it is in, the first counts. If it is in none, it is where rounding opens a gap: the first piece
/// counts that has all its neighbours there. Without the neighbours it is not a gap but the outside, beside a convex edge
/// in which a wall ends.
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

/// The endpoint of a segment at inner walls of a body is in one of its pieces as well, and decided alike. Where a segment crosses an
/// edge differs from piece to piece and is another contact; its endpoint is the same to the bit.
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

/// An edge in which a wall ends is found by the pieces on both sides of the wall: the first counts.
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

/// Whether at each wall of a piece at which a place is there is another piece that it is in or at.
fn has_neighbors_at_walls(found: &ContactCandidate, place: &Vec3, context: &PairContext<'_>) -> bool {
    if found.status != CandidateStatus::BeyondWall {
        return false;
    }
    let body = context.body_b;
    let holds = |piece: &Polyhedron| piece.containment(place) != Containment::Outside;
    // Twins have the same plane to the bit.
    let has_twin = |wall: &PolyhedronFace| {
        let is_twin = |face: &PolyhedronFace| face.normal == -wall.normal && face.offset == -wall.offset;
        let pieces = body.polyhedra.iter().filter(|piece| piece.faces.iter().any(is_twin));
        pieces.into_iter().any(holds)
    };
    body.polyhedra[found.element_b as usize].walls_at(place).all(has_twin)
}

/// The weights of the contacts of one sphere or ellipsoid with one surface.
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

/// What carries nothing is only remembered, or does not count.
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

/// A fallback contact counts where no other has its place; then it is what rounding has made it miss.
///
/// Another wall that the same ball touches does not have the place, however deep it is. Of an ellipsoid a deeper contact in
/// the same place is another minimum there, and not what rounding has made this one miss.
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
    // Faces first: where rounding has made a face and its edge miss one place, the face yields to what is less deep, and an
    // edge would not.
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

/// An ellipsoid so deep that a face and another feature that meets it convexly both have a minimum is pushed by the less
/// deep alone, and so is one with its centre behind an edge or a vertex, however many triangles lie between the two. Which face that yields is in the model must not matter: a face
/// that is cut no longer has the edge to which it yields.
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

/// With the centre behind, a face yields to a less deep one that meets it convexly, as in a polyhedron, and to such an edge or
/// vertex: a centre on the rim of a face in front is behind the next by rounding alone.
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

/// Whether the triangles of two contacts meet convexly in an edge.
fn meet_in_an_edge(contact: &ContactCandidate, other: &ContactCandidate, triangles: &TriangleSet) -> bool {
    let neighbors = &triangles.triangles[contact.element_b as usize].neighbors;
    let edge = neighbors.iter().position(|neighbor| *neighbor == other.element_b);
    edge.is_some_and(|k| {
        let view = TriangleView::new(triangles, contact.element_b);
        matches!(view.classify_edge(triangles, k), EdgeClass::Convex { .. })
    })
}

/// Whether two faces meet convexly, however many triangles lie between the two that push: where each is touched lies below
/// the plane of the other. Beside a concave edge it lies above; in the wedge behind one both are touched in the edge, or
/// in pieces of it that lie in both planes.
fn meet_below(contact: &ContactCandidate, other: &ContactCandidate, triangles: &TriangleSet) -> bool {
    let on = |of: &ContactCandidate| nearest_in_plane(&touched(of), &triangles.corners(of.element_b));
    let (places, normals) = ([&on(contact), &on(other)], [&contact.normal_b, &other.normal_b]);
    are_convex(places, normals) && !are_in_both_planes(places, normals)
}

/// A stand-in counts only where nothing else is as deep.
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
