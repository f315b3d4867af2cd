//! Testers of primitives with two ends: line segments, capsules, cylinders and cones.

use super::balls::{InBore, ball_on_piece, ball_on_triangle};
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::narrow_phase::element_pair::{
    BETWEEN_DISCS, BETWEEN_ENDS, Ball, ChunkCandidates, ElementPair, end_spheres, wrong_kind,
};
use crate::frame::narrow_phase::on_triangle::{Centre, on_triangle, thickness_for_disc};
use crate::state::ContactRole;
use pong_geometry::interference::axis_triangle::{AxisLine, is_beside_edge};
use pong_geometry::interference::bar_polyhedron::{capsule_solid, segment_solid};
use pong_geometry::interference::capsule_edge::{ConvexEdge, capsule_edge};
use pong_geometry::interference::capsule_polyhedron::CapsuleAtPiece;
use pong_geometry::interference::ellipsoid_polyhedron::ellipsoid_piece;
use pong_geometry::interference::end_disc::EndDisc;
use pong_geometry::interference::frustum_solid::frustum_solid;
use pong_geometry::interference::line_segment_polyhedron::{AtWall, line_segment_piece};
use pong_geometry::interference::side_edge::{axis_passes_through, flat_way_out, side_edge, surely_overlaps};
use pong_geometry::interference::sphere_polyhedron::sphere_inside_polyhedron;
use pong_geometry::interference::triangle_features::{EdgeClass, TriangleView};
use pong_geometry::interference::two_ended_bore::{capsule_bore, cylinder_bore, segment_bore};
use pong_geometry::interference::two_ended_round::EndContact;
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::{Capsule, Containment, Frustum, Polyhedron, Sphere};

/// Adds the contacts of a capsule with a piece of a body: those of the end spheres, and those of the convex
/// edges that the axis crosses between them.
pub(super) fn capsule_polyhedron(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Capsule(capsule) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    if let Some((pair, solid)) = pair.on_solid() {
        return capsule_on_solid(&pair, capsule, solid, found);
    }
    let Some(at_piece) = CapsuleAtPiece::new(capsule, polyhedron) else { return };
    for ball in Ball::at_ends(&end_spheres(capsule)) {
        ball_on_piece(pair, &ball, found);
    }
    at_piece.each_crossing(|crossing| pair.between(BETWEEN_ENDS, crossing, CandidateStatus::Front, found));
}

/// Adds the contacts of a capsule with a convex solid. An end whose centre is inside has the face by which it
/// entered; once the axis is sunk in, only these faces, their neighbours and edges push.
fn capsule_on_solid(
    pair: &ElementPair<'_>,
    capsule: &Capsule,
    polyhedron: &Polyhedron,
    found: &mut ChunkCandidates<'_>,
) {
    if pair.is_done(found) {
        return;
    }
    let locals = &pair.body_a().capsules[pair.item_a.element as usize].ends;
    let keys = [0, 1].map(|end| pair.key_at(end));
    let entries = [0, 1].map(|end: usize| {
        let is_inside = polyhedron.contains(&capsule.ends[end]);
        let remembered = is_inside.then(|| pair.context.memory.under(&keys[end]))?;
        let face = pair.entry_face(polyhedron, &remembered, &locals[end], &capsule.ends[end])?;
        Some((face, remembered.range))
    });
    let entered: [Option<usize>; 2] = entries.map(|entry| entry.map(|(face, _)| face.pushes()));
    let contacts = match entered {
        [None, None] => capsule_solid(capsule, polyhedron, &[]),
        [Some(face), None] | [None, Some(face)] => capsule_solid(capsule, polyhedron, &[face]),
        [Some(one), Some(other)] => capsule_solid(capsule, polyhedron, &[one, other]),
    };
    for end in 0..2 {
        let contact = contacts[end].as_ref();
        // An end inside that carries nothing keeps its face.
        let idle = || {
            let (face, _) = entries[end]?;
            let center = capsule.ends[end];
            let sphere = Sphere { center, radius: capsule.radius };
            Some(sphere_inside_polyhedron(&sphere, polyhedron, face.pushes()))
        };
        let Some(interference) = contact.map(|contact| contact.interference).or_else(idle) else { continue };
        pair.emit(keys[end], &interference, found, |out| {
            out.half = true;
            match contact {
                Some(contact) => out.weight = contact.share,
                None => out.role = ContactRole::Tracked,
            }
            if let Some((face, range)) = entries[end] {
                (out.entry_face, out.remembered) = (face.reached(), Some(range));
            }
        });
    }
}

/// Adds the contacts of a capsule with a triangle: those of the end spheres, and those of the convex and free
/// edges that the axis crosses. An edge that is beside the axis, but not crossed by it, gives a `StandIn`.
pub(super) fn capsule_triangle(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Capsule(capsule) = a else { wrong_kind(a) };
    for ball in Ball::at_ends(&end_spheres(capsule)) {
        ball_on_triangle(pair, &ball, false, found);
    }
    if !has_edges_beside(pair, capsule) {
        return;
    }
    let mut is_told = false;
    each_edge_of_triangle(pair, |edge| {
        if let Some(crossing) = capsule_edge(capsule, edge) {
            is_told = true;
            pair.between(BETWEEN_ENDS, &crossing, CandidateStatus::Front, found);
        } else {
            is_told = is_told || tell_beside(pair, (capsule, edge), BETWEEN_ENDS, found);
        }
    });
}

/// Capsule around the axis of a cylinder, which has the cylinder's side between the end discs; `None` for a cone.
fn side_of(frustum: &Frustum) -> Option<Capsule> {
    let [first, last] = frustum.radii;
    (first == last).then_some(Capsule { ends: frustum.ends, radius: first })
}

/// Returns `true` if the way over an edge is not longer than that over a face, `over_face`, m, but for rounding. Where it is
/// longer, the edge lies below an end disc, as under a drum that stands on a block, and only the disc touches it.
fn is_way_out(crossing: &Interference, over_face: f64) -> bool {
    const SLACK: f64 = 1e-9;
    crossing.depth <= over_face * (1.0 + SLACK)
}

/// Adds the contacts of a cylinder or a cone with a piece of a body: those of a convex solid at the places of its rims;
/// else those of its end discs, and those of the convex edges that its side crosses between them.
pub(super) fn frustum_polyhedron(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Frustum(frustum) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    if let Some((pair, solid)) = pair.on_solid() {
        return match pair.is_done(found) {
            true => (),
            false => emit_halves(&pair, frustum, frustum_solid(frustum, solid), found),
        };
    }
    // Shortest way out over a face.
    let mut over_face = f64::INFINITY;
    for face in &polyhedron.faces {
        let way_out = frustum.support(&-face.normal) + face.offset;
        if way_out <= 0.0 {
            return;
        }
        over_face = over_face.min(if face.active { way_out } else { f64::INFINITY });
    }
    let mut is_pushed = false;
    for end in 0..2 {
        let disc = EndDisc { frustum, end };
        let Some(contact) = ellipsoid_piece(&frustum.flat_ellipsoid(end), polyhedron) else { continue };
        let Some(lowest) = disc.exact(&contact.interference) else { continue };
        let status = if contact.stands_in { CandidateStatus::StandIn } else { CandidateStatus::Front };
        is_pushed = true;
        let mut places = [Some(lowest), None];
        if lowest.feature.is_face() {
            let rims = polyhedron.rim(lowest.feature.index()).iter();
            let is_edge = |neighbor: u32| polyhedron.faces[neighbor as usize].active;
            let rims = rims.map(|rim| (rim.outward, rim.anchor, is_edge(rim.neighbor)));
            let is_whole = polyhedron.planes().all_active && !contact.stands_in;
            places = disc.on_face(&lowest, rims, is_whole);
        }
        for (place, end) in places.iter().zip([end, end + 2]) {
            let Some(place) = place else { continue };
            pair.emit(pair.key_at(end as u32), place, found, |out| {
                out.share(true);
                out.status = status;
            });
        }
    }
    let mut push_side = |crossing: &Interference| {
        if is_way_out(crossing, over_face) {
            is_pushed = true;
            pair.between(BETWEEN_DISCS, crossing, CandidateStatus::Front, found);
        }
    };
    if let Some(side) = side_of(frustum) {
        if let Some(at_piece) = CapsuleAtPiece::new(&side, polyhedron) {
            at_piece.each_crossing(|crossing| {
                if crossing.depth < side.radius {
                    push_side(crossing);
                }
            });
        }
    } else {
        for (index, edge) in polyhedron.edges.iter().enumerate() {
            let Some(push) = &edge.push else { continue };
            let ends_b = edge.vertices.map(|vertex| polyhedron.vertices[vertex as usize].position);
            let feature = Feature::edge(index);
            let edge = ConvexEdge {
                ends_b,
                normals_b: push.normals,
                outwards_b: Some(push.outwards),
                free_outward_b: None,
                feature,
            };
            side_edge(frustum, &edge).iter().for_each(&mut push_side);
        }
    }
    push_sunk_side(pair, (frustum, polyhedron), is_pushed, found);
}

/// Adds the contact of a side whose axis has sunk past an edge of a piece, and of a body that overlaps the piece without any
/// other contact (`is_pushed` is false).
fn push_sunk_side(
    pair: &ElementPair<'_>,
    (frustum, polyhedron): (&Frustum, &Polyhedron),
    is_pushed: bool,
    found: &mut ChunkCandidates<'_>,
) {
    let may_push = if is_pushed {
        axis_passes_through(frustum, polyhedron)
    } else {
        surely_overlaps(frustum, polyhedron)
    };
    if !may_push {
        return;
    }
    let Some((way_out, is_sunk)) = flat_way_out(frustum, polyhedron) else { return };
    if is_sunk || !is_pushed {
        let is_whole = polyhedron.planes().all_active;
        let status = if is_whole { CandidateStatus::Front } else { CandidateStatus::StandIn };
        pair.between(BETWEEN_DISCS, &way_out, status, found);
    }
}

/// Adds the contacts of a cylinder or a cone with a triangle: those of its end discs, and those of the convex and
/// free edges that its side crosses. An edge beside the axis that the side does not cross gives a `StandIn`, as does the
/// face under the middle of a disc that stands on it.
pub(super) fn frustum_triangle(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Frustum(frustum) = a else { wrong_kind(a) };
    let (set, triangle) = (&pair.body_b().triangles, pair.item_b.element);
    let local = &pair.body_a().frusta[pair.item_a.element as usize];
    for end in 0..2 {
        let disc = EndDisc { frustum, end };
        let center = |key: usize| Centre {
            center_a: local.ends[end],
            center_b: frustum.ends[end],
            end: Some(key as u32),
        };
        let thickness = thickness_for_disc(pair.context, pair.item_b, &disc);
        disc.on_triangle(set, triangle, thickness, &mut |contact| {
            on_triangle(pair, &center(end), contact, found);
        });
        let (highest, middle) = disc.below_triangle(set, triangle, thickness);
        if let Some(highest) = highest {
            on_triangle(pair, &center(end + 2), highest, found);
        }
        if let Some(middle) = middle {
            pair.between(BETWEEN_DISCS, &middle, CandidateStatus::StandIn, found);
        }
    }
    let around = Capsule { ends: frustum.ends, radius: frustum.radii[0].max(frustum.radii[1]) };
    if !has_edges_beside(pair, &around) {
        return;
    }
    let side = side_of(frustum);
    let mut is_told = false;
    each_edge_of_triangle(pair, |edge| {
        let crossing = match &side {
            Some(side) => capsule_edge(side, edge),
            None => side_edge(frustum, edge),
        };
        let over_face =
            edge.normals_b.iter().map(|normal| frustum.support(&-normal) + normal.dot(&edge.ends_b[0]));
        let over_face = over_face.fold(f64::INFINITY, f64::min);
        if let Some(crossing) = crossing.filter(|crossing| is_way_out(crossing, over_face)) {
            is_told = true;
            pair.between(BETWEEN_DISCS, &crossing, CandidateStatus::Front, found);
        } else {
            is_told = is_told || tell_beside(pair, (&around, edge), BETWEEN_DISCS, found);
        }
    });
}

/// Returns `false` if no edge of a triangle that pushes is less than the radius away from the line of a capsule's axis.
fn has_edges_beside(pair: &ElementPair<'_>, capsule: &Capsule) -> bool {
    let (set, triangle) = (&pair.body_b().triangles, pair.item_b.element);
    let may_push = set.triangles[triangle as usize].may_push;
    (0..3).any(|k| may_push.edge(k)) && !AxisLine::new(capsule).misses(&set.corners(triangle))
}

/// Adds a `StandIn` if an edge is beside the axis of a capsule, and returns true then.
fn tell_beside(
    pair: &ElementPair<'_>,
    (capsule, edge): (&Capsule, &ConvexEdge),
    part: u32,
    found: &mut ChunkCandidates<'_>,
) -> bool {
    let is_beside = is_beside_edge(capsule, edge);
    if is_beside {
        let beside = Interference {
            depth: capsule.radius,
            normal_b: edge.normals_b[0],
            deepest_b: edge.ends_b[0],
            feature: edge.feature,
        };
        pair.between(part, &beside, CandidateStatus::StandIn, found);
    }
    is_beside
}

/// Calls `visit` with the convex and free edges of a triangle that push.
fn each_edge_of_triangle(pair: &ElementPair<'_>, mut visit: impl FnMut(&ConvexEdge)) {
    let (set, triangle) = (&pair.body_b().triangles, pair.item_b.element);
    let may_push = set.triangles[triangle as usize].may_push;
    for k in (0..3).filter(|&k| may_push.edge(k)) {
        let view = TriangleView::new(set, triangle);
        let (normals, free_outward_b) = match view.classify_edge(set, k) {
            EdgeClass::Free => ([view.normal; 2], Some(view.outward(k))),
            EdgeClass::Convex { normal, .. } if view.owns_edge(set, k) => ([view.normal, normal], None),
            EdgeClass::Convex { .. } | EdgeClass::Silent { .. } => continue,
        };
        let feature = Feature::edge(triangle as usize * 3 + k);
        let ends_b = view.edge_ends(k);
        visit(&ConvexEdge { ends_b, normals_b: normals, outwards_b: None, free_outward_b, feature });
    }
}

/// Adds the contacts of a line segment with a piece of a body. Each end has half of the spring.
pub(super) fn line_segment_polyhedron(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Segment(segment) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    if let Some((pair, solid)) = pair.on_solid() {
        return match pair.is_done(found) {
            true => (),
            false => emit_shares(&pair, segment, segment_solid(segment, solid), found),
        };
    }
    for (end, found_there) in line_segment_piece(segment, polyhedron).iter().enumerate() {
        let Some((contact, at_wall)) = found_there else { continue };
        let status = status_of_end(contact, *at_wall, polyhedron);
        pair.emit(pair.key_at(end as u32), contact, found, |out| {
            out.half = true;
            out.status = status;
        });
    }
}

/// Candidate status of the contact at one end of a segment, with a piece of a body.
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

/// Adds the contacts of a line segment, a capsule or a cylinder with a bore. Each end of the part that lies
/// in the hole has half a spring.
pub(super) fn axis_in_bore(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let bore = &pair.body_b().bores[pair.item_b.element as usize];
    let (body_a, element) = (pair.body_a(), pair.item_a.element as usize);
    let (contacts, ends) = match a {
        TransformedPrimitive::Segment(segment) => {
            (segment_bore(segment, bore), body_a.segments[element].ends)
        }
        TransformedPrimitive::Capsule(capsule) => {
            (capsule_bore(capsule, bore), body_a.capsules[element].ends)
        }
        TransformedPrimitive::Frustum(cylinder) => {
            (cylinder_bore(cylinder, bore), body_a.frusta[element].ends)
        }
        _ => wrong_kind(a),
    };
    for ((contacts, local), end) in contacts.iter().zip(&ends).zip(0..) {
        let at_end = contacts.map(|contact| {
            contact.map(|at| (at, InBore::new(pair, pair.key_at(end), local, &at.interference)))
        });
        let is_active = |(_, at): &&(EndContact, InBore)| at.role == ContactRole::Active;
        let active = at_end.iter().flatten().filter(is_active).count();
        for (contact, at) in at_end.iter().flatten() {
            pair.emit(at.key, &contact.interference, found, |out| {
                out.half = true;
                // What came from behind one wall is pushed by the other alone.
                out.weight = if active > 1 { contact.share } else { 1.0 };
                (out.role, out.remembered) = (at.role, Some(at.remembered));
            });
        }
    }
}

/// Adds the contacts at the ends of an axis, or at points of its end discs. Each contact has half a spring.
pub(super) fn emit_halves<A>(
    pair: &ElementPair<'_>,
    _: &A,
    contacts: impl AsRef<[Option<Interference>]>,
    found: &mut ChunkCandidates<'_>,
) {
    for (end, contact) in contacts.as_ref().iter().enumerate() {
        let Some(contact) = contact else { continue };
        pair.emit(pair.key_at(end as u32), contact, found, |out| out.half = true);
    }
}

/// Adds the contacts of a body with two ends on a round solid: of a segment or capsule at each end of the overlap, of a
/// cylinder or cone at places of its rims. Each contact has half a spring, and its share as weight.
pub(super) fn emit_shares<A>(
    pair: &ElementPair<'_>,
    _: &A,
    contacts: impl AsRef<[Option<EndContact>]>,
    found: &mut ChunkCandidates<'_>,
) {
    for (end, contact) in contacts.as_ref().iter().enumerate() {
        let Some(contact) = contact else { continue };
        pair.emit(pair.key_at(end as u32), &contact.interference, found, |out| {
            out.half = true;
            out.weight = contact.share;
        });
    }
}
