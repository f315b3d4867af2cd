//! Line segment (A) – polyhedron (B) (physics contract, 2.3).
//!
//! For each active face, the part of the segment over the face's polygon carries half a spring at each of its
//! two ends. A *tip* of the segment measures its depth straight below the face. Where the segment's line leaves
//! the polygon across an edge, the *crossing* measures the distance between the two lines. The face that stores
//! the least energy pushes.
//!
//! A face takes part only if its touching crossings lie on the solid: at a crossing of the edge between the faces f
//! and g the segment must be behind every other face. Without this, the side face of a box would claim a bar that lies
//! through the top from the moment the bar's far tip rises above the top's plane, with half the force, although
//! the bar leaves the box through the opposite side: closed paths would gain energy there. With it the energies of
//! the two faces are equal where the claim begins.
//!
//! Degenerate cases: a segment along the face's normal has two tips; one along an edge of the outline belongs to
//! the faces on both sides, of which the lower wins a tie; a segment that only touches has no contact.

use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{LineSegment, Polyhedron, PolyhedronFace, RimEdge};

/// The contact at each end of the part that carries: 0 towards the segment's first end, 1 towards its second.
pub type EndContacts = [Option<Interference>; 2];

/// Tests a segment against one convex piece. Each contact carries half of the pair's stiffness and damping.
pub fn line_segment_polyhedron(segment: &LineSegment, polyhedron: &Polyhedron) -> EndContacts {
    if !pierces(segment, polyhedron) {
        return [None, None];
    }
    let (mut on_solid, mut any) = (Claim::NONE, Claim::NONE);
    for (index, face) in polyhedron.faces.iter().enumerate().filter(|(_, face)| face.active) {
        if segment.ends.iter().all(|end| face.height(end) >= 0.0) {
            continue;
        }
        let Some(part) = part_over_face(segment, polyhedron, index) else { continue };
        let claim = claim(segment, polyhedron, index, &part);
        any.yield_to(&claim);
        if claim.energy < on_solid.energy && crossings_on_solid(segment, polyhedron, index, &part, &claim) {
            on_solid.yield_to(&claim);
        }
    }
    if on_solid.energy <= MOST_SPURNED * any.energy { on_solid.ends } else { any.ends }
}

/// A face whose crossings are not on the solid claims too little energy, but never less than half of the right one:
/// of the right face's two ends it misses the shallower. Below this share its claim is good after all: the crossing
/// has passed a corner of the solid, and the other faces measure the way through the solid.
const MOST_SPURNED: f64 = 4.0;

/// What a face would do with a segment.
struct Claim {
    /// In units of k/4.
    energy: f64,
    measured: EndContacts,
    ends: EndContacts,
}

impl Claim {
    const NONE: Self = Self { energy: f64::INFINITY, measured: [None, None], ends: [None, None] };

    fn yield_to(&mut self, other: &Self) {
        if other.energy > 0.0 && other.energy < self.energy {
            *self = Self { ..*other };
        }
    }
}

fn claim(segment: &LineSegment, polyhedron: &Polyhedron, index: usize, part: &[PartEnd; 2]) -> Claim {
    let face = &polyhedron.faces[index];
    let measured = [0, 1].map(|end| match part[end].cut_by {
        None => tip_contact(&segment.ends[end], face, index),
        Some(rim) => crossing_contact(segment, polyhedron, face, &rim),
    });
    // An end cut off by an inner wall counts here: it is the next piece's to carry, but without it the face would
    // not be found where its other end does not touch.
    let energy = measured.iter().flatten().map(|contact| contact.depth * contact.depth).sum();
    let ends = [0, 1].map(|end| measured[end].filter(|_| carries(polyhedron, &part[end])));
    Claim { energy, measured, ends }
}

/// Whether every crossing that touches lies on the solid.
fn crossings_on_solid(
    segment: &LineSegment,
    polyhedron: &Polyhedron,
    index: usize,
    part: &[PartEnd; 2],
    claim: &Claim,
) -> bool {
    let touching = [0, 1].into_iter().filter(|&end| claim.measured[end].is_some());
    touching.filter_map(|end| part[end].cut_by.map(|rim| (part[end].at, rim))).all(|(at, rim)| {
        crosses_on_solid(segment, polyhedron, index, at, &rim)
    })
}

/// An end cut off by an inactive face carries nothing: the piece behind that wall does.
fn carries(polyhedron: &Polyhedron, end: &PartEnd) -> bool {
    end.cut_by.is_none_or(|rim| polyhedron.faces[rim.neighbor as usize].active)
}

/// Whether some point of the segment lies inside.
fn pierces(segment: &LineSegment, polyhedron: &Polyhedron) -> bool {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for face in &polyhedron.faces {
        let heights = segment.ends.map(|end| face.height(&end));
        if heights[0] == heights[1] {
            let inside = heights[0] < 0.0 || (face.closed && heights[0] == 0.0);
            if !inside {
                return false;
            }
            continue;
        }
        let crossing = heights[0] / (heights[0] - heights[1]);
        if heights[1] < heights[0] {
            enter = enter.max(crossing);
        } else {
            leave = leave.min(crossing);
        }
        if enter >= leave {
            return false;
        }
    }
    true
}

/// Where the part of a segment over a face's polygon ends.
#[derive(Clone, Copy)]
struct PartEnd {
    /// Parameter along the segment.
    at: f64,
    /// The edge it is cut by; `None` at a tip.
    cut_by: Option<RimEdge>,
}

/// Whether the segment, where it crosses an edge of a face, is behind all faces that do not meet at this edge.
fn crosses_on_solid(segment: &LineSegment, polyhedron: &Polyhedron, index: usize, at: f64, rim: &RimEdge) -> bool {
    let place = segment.ends[0] + (segment.ends[1] - segment.ends[0]) * at;
    let others = polyhedron.faces.iter().enumerate().filter(|(i, _)| *i != index && *i != rim.neighbor as usize);
    others.map(|(_, face)| face.height(&place)).all(|height| height <= 0.0)
}

/// Clips the segment to the prism of a face along its normal; `None` if nothing is left.
fn part_over_face(segment: &LineSegment, polyhedron: &Polyhedron, index: usize) -> Option<[PartEnd; 2]> {
    let mut part = [PartEnd { at: 0.0, cut_by: None }, PartEnd { at: 1.0, cut_by: None }];
    for rim in polyhedron.rim(index) {
        let beyond = segment.ends.map(|end| rim.outward.dot(&(end - rim.anchor)));
        if beyond[0] <= 0.0 && beyond[1] <= 0.0 {
            continue;
        }
        if beyond[0] > 0.0 && beyond[1] > 0.0 {
            return None;
        }
        let at = beyond[0] / (beyond[0] - beyond[1]);
        if beyond[0] > 0.0 && at >= part[0].at {
            part[0] = PartEnd { at, cut_by: Some(*rim) };
        } else if beyond[1] > 0.0 && at <= part[1].at {
            part[1] = PartEnd { at, cut_by: Some(*rim) };
        }
    }
    (part[0].at < part[1].at).then_some(part)
}

fn tip_contact(tip: &Vec3, face: &PolyhedronFace, index: usize) -> Option<Interference> {
    let depth = -face.height(tip);
    (depth > 0.0).then(|| Interference {
        depth,
        normal: face.normal,
        point_a: *tip,
        feature: Feature::face(index),
    })
}

/// Distance of the segment's line below the edge's line, along the common normal of both.
fn crossing_contact(
    segment: &LineSegment,
    polyhedron: &Polyhedron,
    face: &PolyhedronFace,
    rim: &RimEdge,
) -> Option<Interference> {
    let edge = polyhedron.edges[rim.edge as usize].direction;
    let along = segment.ends[1] - segment.ends[0];
    let across = edge.cross(&along);
    // |edge × along|² is the determinant of the two lines' closest-point problem; it cannot vanish where the
    // segment crosses the edge's plane.
    let square = across.norm_squared();
    let normal = across.normalize() * across.dot(&face.normal).signum();
    let to_anchor = rim.anchor - segment.ends[0];
    let depth = normal.dot(&to_anchor);
    if depth <= 0.0 || square == 0.0 {
        return None;
    }
    let nearest = to_anchor.cross(&edge).dot(&along.cross(&edge)) / square;
    Some(Interference {
        depth,
        normal,
        point_a: segment.ends[0] + along * nearest,
        feature: Feature::edge(rim.edge as usize),
    })
}
