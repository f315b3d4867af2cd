//! Line segment (A) – polyhedron (B) (physics contract, 2.3).
//!
//! The part of the segment inside the solid has two ends. For each active face f, each end carries half a spring:
//!
//! * a *tip* of the segment, inside the solid or straight below the face, has its depth below f and pushes along
//!   the face's normal;
//! * where the segment leaves the solid through another face h, the *crossing* is the distance of the segment's line
//!   below the line in which the planes of f and h meet, and pushes along the common normal of both lines;
//! * where it leaves through f itself the end carries nothing.
//!
//! The face that stores the least energy pushes. Where f and h share an edge the crossing is that of the contract.
//! The contract's rule asks instead where the segment leaves the *polygon* of f. On a box the two agree, but for a
//! bar whose far tip has risen above the top: there the contract lets a side face claim it with half the force, and
//! closed paths gain energy. Beside obtuse edges the contract's rule halves the force of a bar that lies flat; see
//! docs/decisions/0001.
//!
//! Degenerate cases: a segment parallel to a face crosses at its depth; two parallel planes meet nowhere and that
//! face takes no part; a segment that only touches has no contact; ties go to the lower face.

use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{LineSegment, Polyhedron, PolyhedronFace};

/// The contact at each end: 0 towards the segment's first end, 1 towards its second.
pub type EndContacts = [Option<Interference>; 2];

/// Energies this close are a tie. Of a segment that enters by f and leaves by h both claim the one crossing, and
/// rounding must not decide which: the state key is the end.
const TIE: f64 = 1.0 - 1e-12;

/// Tests a segment against one convex piece. Each contact carries half of the pair's stiffness and damping.
pub fn line_segment_polyhedron(segment: &LineSegment, polyhedron: &Polyhedron) -> EndContacts {
    let Some(inside) = inside_part(segment, polyhedron) else { return [None, None] };
    let mut best = (f64::INFINITY, [None, None]);
    for (index, face) in polyhedron.faces.iter().enumerate().filter(|(_, face)| face.active) {
        let end = |end| measure(segment, polyhedron, index, face, &inside[end], end);
        let Some(measured) = end(0).zip(end(1)) else { continue };
        // An end at an inner wall counts here, though the piece behind the wall carries it: without it the face
        // would not be found where its other end does not touch.
        let energy =
            [measured.0, measured.1].iter().flatten().map(|contact| contact.depth * contact.depth).sum();
        if energy > 0.0 && energy < best.0 * TIE {
            let carried = |m: Measured, end: &InsideEnd| m.filter(|m| carries(polyhedron, end, m));
            best = (energy, [carried(measured.0, &inside[0]), carried(measured.1, &inside[1])]);
        }
    }
    best.1
}

/// Whether an end carries what it measures. One at an inner wall does not, the piece behind the wall does; but where
/// the wall ends in a convex edge of the body, that edge pushes (2.1), once for all pieces that have it.
fn carries(polyhedron: &Polyhedron, end: &InsideEnd, measured: &Interference) -> bool {
    let at_wall = end.leaves_by.is_some_and(|h| !polyhedron.faces[h].active);
    let feature = measured.feature;
    !at_wall || (!feature.is_face() && polyhedron.edges[feature.index()].push.is_some())
}

/// One end of the part of the segment inside the solid.
#[derive(Clone, Copy)]
struct InsideEnd {
    /// Parameter along the segment, 0…1.
    at: f64,
    /// The face through which the segment leaves; `None` if its tip is inside.
    leaves_by: Option<usize>,
}

/// Clips the segment to the solid; `None` if no point of it lies inside.
fn inside_part(segment: &LineSegment, polyhedron: &Polyhedron) -> Option<[InsideEnd; 2]> {
    let mut ends = [0.0, 1.0].map(|at| InsideEnd { at, leaves_by: None });
    for (index, face) in polyhedron.faces.iter().enumerate() {
        let heights = segment.ends.map(|end| face.height(&end));
        if heights[0] == heights[1] {
            if heights[0] < 0.0 || (face.closed && heights[0] == 0.0) {
                continue;
            }
            return None;
        }
        let at = heights[0] / (heights[0] - heights[1]);
        let leaving = InsideEnd { at, leaves_by: Some(index) };
        if heights[1] < heights[0] && at > ends[0].at {
            ends[0] = leaving;
        } else if heights[1] > heights[0] && at < ends[1].at {
            ends[1] = leaving;
        }
        if heights[0] >= 0.0 && heights[1] >= 0.0 {
            return None;
        }
    }
    (ends[0].at < ends[1].at).then_some(ends)
}

/// What an end measures below a face: `None` if it does not touch.
type Measured = Option<Interference>;

fn if_touching(contact: Interference) -> Measured {
    (contact.depth > 0.0).then_some(contact)
}

/// Measures one end below one face; `None` if the face takes no part.
fn measure(
    segment: &LineSegment,
    polyhedron: &Polyhedron,
    index: usize,
    face: &PolyhedronFace,
    inside: &InsideEnd,
    end: usize,
) -> Option<Measured> {
    let tip = &segment.ends[end];
    match inside.leaves_by {
        Some(leaves_by) if leaves_by == index => Some(None),
        Some(leaves_by) if !is_over_face(tip, polyhedron, index) => {
            crossing(segment, polyhedron, index, leaves_by, inside.at).map(if_touching)
        }
        _ => Some(if_touching(Interference {
            depth: -face.height(tip),
            normal: face.normal,
            point_a: *tip,
            feature: Feature::face(index),
        })),
    }
}

/// Whether a point lies over (or under) a face's polygon, seen along the face's normal.
fn is_over_face(p: &Vec3, polyhedron: &Polyhedron, index: usize) -> bool {
    polyhedron.rim(index).iter().all(|rim| rim.outward.dot(&(p - rim.anchor)) <= 0.0)
}

/// Distance of the segment's line below the line in which two faces' planes meet, with the segment leaving through
/// the second face at parameter `at`; `None` if the planes do not meet.
///
/// With s along the segment and q where it leaves, the common normal of the two lines is u ∝ n_f·(n_h·s) − n_h·(n_f·s);
/// a point of the edge less q has no part along n_h, so the distance is the depth of q below f times (n_h·s)/|…|.
fn crossing(
    segment: &LineSegment,
    polyhedron: &Polyhedron,
    index: usize,
    leaves_by: usize,
    at: f64,
) -> Option<Interference> {
    let (face, exit) = (&polyhedron.faces[index], &polyhedron.faces[leaves_by]);
    let along = segment.ends[1] - segment.ends[0];
    let (slope, exit_slope) = (face.normal.dot(&along), exit.normal.dot(&along));
    let across = (face.normal * exit_slope - exit.normal * slope) * exit_slope.signum();
    let length = across.norm();
    let leaving = segment.ends[0] + along * at;
    let depth = -face.height(&leaving) * exit_slope.abs() / length;
    if !depth.is_finite() {
        return None;
    }
    let normal = (across / length).normalize();
    // The nearest point lies where the edge's line, δ·u above it, is in the plane of the exit face.
    let nearest = leaving - along * (depth * exit.normal.dot(&normal) / exit_slope);
    let shared = polyhedron.rim(index).iter().find(|rim| rim.neighbor as usize == leaves_by);
    let feature = shared.map_or(Feature::face(index), |rim| Feature::edge(rim.edge as usize));
    Some(Interference { depth, normal, point_a: nearest, feature })
}
