//! Load sharing: decides which candidates of a chunk of A count, and with which weight.

mod axes;
mod capsules;
mod exits;
mod joint;
mod pieces;
mod ray_hits;
mod rims;
pub(crate) mod solver;
pub(crate) mod status;

use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::frame::narrow_phase::element_pair::{BETWEEN_DISCS, BETWEEN_ENDS};
use crate::state::{ContactRole, NO_FACE};
use capsules::couple;
use exits::{is_exit_that_stands_in, keep_one_of_exits};
use joint::{is_joint, judge_by_kind};
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
use rims::{cull_opposite_at_points, keep_one_side_of_rims};
use solver::{SharedContact, share_within};

/// Relative difference below which two depths count as equal.
const FALLBACK_DEPTH_SLACK: f64 = 1e-9;

/// Sorts the candidates of a chunk into summation order, assigns their weights, and culls those that do not
/// count. All elements of the chunk are of one kind, and all candidates with one key are in one chunk.
///
/// # Errors
/// [`Full`] if the scratch memory was too small for the contacts of one surface. Then only the deepest of
/// them, as many as fit, have been shared exactly; the others have weight zero.
pub(crate) fn assign_weights(
    context: &PairContext<'_>,
    kind_a: PrimitiveKind,
    found: &mut Table<ContactCandidate>,
    shared_contacts: &mut Table<SharedContact>,
    scratch: &mut Arena,
) -> Result<(), Full> {
    if let [alone] = &mut found[..]
        && !is_between_ends(alone)
        && !(kind_a == PrimitiveKind::LineSegment && is_joint(alone, context))
    {
        // A single candidate keeps the weight that its tester gave. If it is `BeyondWall`, B has no piece on
        // the other side of the internal face, so there is no contact.
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
            cull_opposite_at_points(found);
        }
        // The front and the back of a two-sided triangle are separate surfaces with one rim: only one of them
        // keeps a contact at the rim.
        PrimitiveKind::Capsule | PrimitiveKind::Cylinder | PrimitiveKind::Cone => {
            keep_one_side_of_rims(found, context);
        }
        _ => {}
    }
    match kind_a {
        // A capsule ends in two balls, a cylinder or cone in two discs, which touch as flat ellipsoids do.
        PrimitiveKind::Capsule => {
            return share_bars(
                found,
                (PrimitiveKind::Sphere, BETWEEN_ENDS),
                context,
                shared_contacts,
                scratch,
            );
        }
        PrimitiveKind::Cylinder | PrimitiveKind::Cone => {
            let kind = (PrimitiveKind::Ellipsoid, BETWEEN_DISCS);
            return share_bars(found, kind, context, shared_contacts, scratch);
        }
        _ => {}
    }
    for group in found.chunk_by_mut(|a, b| a.key == b.key) {
        let shares = !matches!(kind_a, PrimitiveKind::Ray | PrimitiveKind::Custom);
        let joint = shares
            && (group.len() > 1 || kind_a == PrimitiveKind::LineSegment)
            && is_joint(&group[0], context);
        match joint {
            true => judge_by_kind(group, kind_a, context, judge_before_sharing),
            false => judge_before_sharing(group, kind_a, context),
        }
        if group[0].shares && group.len() > 1 {
            outcome = outcome.and(find_shares(group, &context.body_b.triangles, shared_contacts, scratch));
            drop_idle(group);
        }
        if joint {
            group.sort_unstable_by_key(ContactCandidate::order);
        }
    }
    outcome
}

/// Assigns the weights of the contacts of capsules, cylinders and cones. `found` must be in summation order. The contacts
/// of one end ball or disc with one surface share half a spring. `kind_of_end` tells how an end touches, `between` is
/// the end in the keys of contacts between the ends.
fn share_bars(
    found: &mut Table<ContactCandidate>,
    (kind_of_end, between): (PrimitiveKind, u32),
    context: &PairContext<'_>,
    shared_contacts: &mut Table<SharedContact>,
    scratch: &mut Arena,
) -> Result<(), Full> {
    let mut outcome = Ok(());
    let surface = |found: &ContactCandidate| (found.key.head(), found.key.shell_b);
    let (mut next, of_testers) = (0, found.len());
    while next < of_testers {
        let first = next;
        let of_one = surface(&found[first]);
        next += found[first..of_testers].iter().take_while(|other| surface(other) == of_one).count();
        let room = found.capacity() - found.len();
        let body = &mut found[first..next];
        let edges = body.partition_point(|found| found.key.end < between);
        let joint = body.len() > 1 && is_joint(&body[0], context);
        if joint {
            body.iter_mut().for_each(|found| found.shares = true);
        }
        // Contacts with round solids and planes already have their weights.
        if !body[0].shares {
            continue;
        }
        let (ends, middle) = body.split_at_mut(edges);
        for end in ends.chunk_by_mut(|a, b| a.key == b.key) {
            cull_opposite_at_points(end);
            match joint {
                true => judge_by_kind(end, kind_of_end, context, judge_before_sharing),
                false => judge_before_sharing(end, kind_of_end, context),
            }
            if end.len() > 1 {
                outcome = outcome.and(find_shares(end, &context.body_b.triangles, shared_contacts, scratch));
            }
        }
        let touch = axes::Touch::new(ends, middle, kind_of_end == PrimitiveKind::Ellipsoid);
        if !joint && touch != axes::Touch::Apart {
            let mut added = axes::Added::default();
            let shared = match room >= added.len() {
                true => axes::share(context, touch, (&mut *ends, &mut *middle), &mut added, scratch),
                false => Err(Full { asked: 0, free: 0, capacity: 0 }),
            };
            let is_shared = matches!(shared, Ok(true));
            outcome = outcome.and(shared.map(|_| ()));
            if is_shared {
                drop_idle(ends);
                for contact in added.into_iter().flatten() {
                    found.push(contact)?;
                }
                continue;
            }
        }
        // On triangles a stand-in only tells that an edge is beside the axis.
        let tells = |contact: &&mut ContactCandidate| {
            contact.status == CandidateStatus::StandIn && contact.kind_b == PrimitiveKind::Triangle
        };
        middle.iter_mut().filter(tells).for_each(|contact| contact.status = CandidateStatus::Culled);
        if !middle.is_empty() {
            let two = ends.partition_point(|end| end.key.end < 2);
            couple(&mut ends[..two], middle);
        }
        ends.chunk_by_mut(|a, b| a.key == b.key).filter(|end| end.len() > 1).for_each(drop_idle);
        if joint {
            ends.sort_unstable_by_key(ContactCandidate::order);
        }
    }
    if found.len() > of_testers {
        found.sort_unstable_by_key(ContactCandidate::order);
    }
    outcome
}

/// Returns true for a contact between the ends of a capsule, a cylinder or a cone with an edge.
fn is_between_ends(contact: &ContactCandidate) -> bool {
    contact.shares && contact.half && contact.key.end >= BETWEEN_ENDS
}

/// Runs passes 4 to 6 of the table in `status.rs` on the contacts of one key.
fn judge_before_sharing(group: &mut [ContactCandidate], kind_a: PrimitiveKind, context: &PairContext<'_>) {
    if group.iter().any(is_at_wall) {
        match group[0].half && !group[0].shares {
            true => choose_piece_of_end_at_walls(group, context),
            false => choose_piece_at_walls(group, context),
        }
    }
    if !group[0].shares || group.len() == 1 {
        return;
    }
    resolve_fallbacks(group, kind_a);
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

/// Centre, in A's frame, and radius of a contact's sphere or capsule end sphere, m.
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

/// Keeps at most one of the contacts that a point, or a sphere's centre, has at internal faces with the
/// pieces of a body; culls the others. Each piece computes by itself on which side of its internal faces the
/// point lies, so rounding may put the point in several pieces or in none.
///
/// The first piece that contains the point counts. If no piece contains it, the first piece counts that has a
/// neighbour behind each of its internal faces at the point. If there is none, no contact counts: the point
/// is outside the body, beside a convex edge at which an internal face ends.
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

/// Keeps at most one of the contacts that one end of a segment has at internal faces with the pieces of a
/// body, by the rules of [`choose_piece_at_walls`]. Only contacts with the same deepest point are compared:
/// where the segment crosses an edge, each piece finds a different point.
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

/// Culls all but the first contact at each edge in which an internal face ends. The pieces on both sides of
/// the internal face have this edge, and each reports a contact there.
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

/// Returns true for a `BeyondWall` contact if, behind each of its piece's internal faces at `place`, the body
/// has another piece that contains `place` within the tolerance of internal faces.
fn has_neighbors_at_walls(found: &ContactCandidate, place: &Vec3, context: &PairContext<'_>) -> bool {
    if found.status != CandidateStatus::BeyondWall {
        return false;
    }
    let body = context.body_b;
    let holds = |piece: &Polyhedron| piece.containment(place) != Containment::Outside;
    // The two sides of an internal face have the same plane, bit for bit, with opposite signs.
    let has_neighbor = |wall: &PolyhedronFace| {
        let is_other_side =
            |face: &PolyhedronFace| face.normal == -wall.normal && face.offset == -wall.offset;
        let pieces = body.polyhedra.iter().filter(|piece| piece.faces.iter().any(is_other_side));
        pieces.into_iter().any(holds)
    };
    body.polyhedra[found.element_b as usize].walls_at(place).all(has_neighbor)
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

/// Makes a contact with zero weight `Tracked` if it has a face of entry or is `BackFace`, because the next
/// frame needs it. Culls all other contacts with zero weight.
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

/// Makes a fallback candidate regular if no regular contact of at least the same depth touches the same
/// point: rounding has then made the regular contact miss. Culls all other fallback candidates.
///
/// For an ellipsoid, only a regular contact of the same depth culls a fallback, because a deeper contact at
/// the same point is another local minimum of the depth.
fn resolve_fallbacks(group: &mut [ContactCandidate], kind_a: PrimitiveKind) {
    let is_fallback = |contact: &ContactCandidate| {
        matches!(contact.status, CandidateStatus::Fallback | CandidateStatus::BackFaceFallback)
    };
    let counts = |contact: &ContactCandidate| {
        matches!(contact.status, CandidateStatus::Front | CandidateStatus::BackFace)
    };
    if !group.iter().any(is_fallback) {
        return;
    }
    // Faces first: if both a face and its edge have a fallback at one point, the face becomes regular. Later
    // passes can cull a face in favour of a less deep contact, but not an edge.
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

/// Drops the deeper of two contacts of an ellipsoid with triangles if their features meet convexly; a deep
/// ellipsoid may have both (docs/theory.md, 2.2). Only a face, or a feature with the centre of A behind it,
/// is dropped.
///
/// The contact points show whether two features meet convexly. Mesh adjacency would not: a face that is cut
/// into triangles may no longer share an edge with the other feature.
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

/// Makes a `BackFace` face `Tracked` if a less deep feature meets it convexly: as on a convex polyhedron,
/// only the less deep of the two pushes. The less deep feature may be `Front`, because a centre on the edge
/// between two faces is behind one of them only by rounding.
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
/// each face lies below the plane of the other face. At a concave edge the contact points lie above these
/// planes. Behind a concave edge each contact point may lie in both planes; then the answer is false.
fn meet_below(contact: &ContactCandidate, other: &ContactCandidate, triangles: &TriangleSet) -> bool {
    let on = |of: &ContactCandidate| nearest_in_plane(&touched(of), &triangles.corners(of.element_b));
    let (places, normals) = ([&on(contact), &on(other)], [&contact.normal_b, &other.normal_b]);
    are_convex(places, normals) && !are_in_both_planes(places, normals)
}

/// Culls `StandIn` candidates that are no deeper than the deepest regular contact.
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
