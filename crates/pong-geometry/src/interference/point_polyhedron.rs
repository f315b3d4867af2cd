//! Point (A) – polyhedron (B): the side of entry (docs/theory.md, 2.4).
//!
//! A point inside is pushed out through the face that it came in by, or through a neighbour of that face when
//! this is nearer. Which face that is, is remembered by the engine; here are the questions it asks of one piece.
//!
//! Degenerate cases: a point on an active face is outside; one on an inner wall belongs to the piece whose face
//! is `closed`. Ties go to the lower index.

use super::highest_face::{Whereabouts, highest_of_many};
use super::{Feature, Interference};
#[cfg(doc)]
use crate::primitive::FacePlanes;
use crate::primitive::{PlaneBlock, Polyhedron};
use crate::simd::{LaneBits, Simd, Splat, run_at_level};
use crate::{Vec3, divisor};

/// Memory follows a faceted curve across an edge only where the cosine between the two normals exceeds this;
/// across anything sharper it stays (docs/theory.md, 2.4).
const FOLLOWED_COSINE_MIN: f64 = 0.3;

/// The active face under which the point lies least deep; `None` if no face is active. Heights above the faces must be
/// finite, as those of numbers within 1e100 are.
#[inline]
pub fn shallowest_face(p: &Vec3, polyhedron: &Polyhedron) -> Option<usize> {
    run_at_level!(shallowest_face_in(p: Vec3, polyhedron: Polyhedron) -> Option<usize>)
}

#[inline(always)]
fn shallowest_face_in<S: Simd>(simd: S, p: &Vec3, polyhedron: &Polyhedron) -> Option<usize> {
    highest_of_many(simd, p, polyhedron.planes(), Whereabouts::Anywhere).map(|highest| highest.face)
}

/// Cosines this close to the largest are equal: single precision leaves two normals of one direction so far apart.
const SAME_COSINE: f64 = 1e-6;

/// The active face whose normal is nearest to a direction, of equal ones that below which the point is least deep: it is
/// of faces all across the direction, as the sides of a piece that is entered through its floor. `None` if no face is active.
pub fn face_most_along(direction: &Vec3, p: &Vec3, polyhedron: &Polyhedron) -> Option<usize> {
    let active = || polyhedron.faces.iter().enumerate().filter(|(_, face)| face.active);
    let most = active().map(|(_, face)| face.normal.dot(direction)).fold(f64::NEG_INFINITY, f64::max);
    let nearest = active().filter(|(_, face)| face.normal.dot(direction) >= most - SAME_COSINE);
    let mut best: Option<(usize, f64)> = None;
    for (index, face) in nearest {
        let height = face.height(p);
        if best.is_none_or(|(_, highest)| height > highest) {
            best = Some((index, height));
        }
    }
    best.map(|(index, _)| index)
}

/// Where the straight line from `from` (outside) to `to` (inside) enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The face, active or not.
    pub face: usize,
    /// How far along the line, 0…1.
    pub at: f64,
}

/// The face through which a straight line enters; `None` if it starts inside or misses.
///
/// Inner walls count as if they stood out by what is within rounding of them ([`FacePlanes::WALL_TOLERANCE`]): a line that
/// runs along a wall enters by the active face, and lines between abutting pieces miss neither.
pub fn entry_of_line(from: &Vec3, to: &Vec3, polyhedron: &Polyhedron) -> Option<Entry> {
    let mut entry: Option<Entry> = None;
    let mut leave = f64::INFINITY;
    let slack = polyhedron.planes().wall_slack;
    for (index, face) in polyhedron.faces.iter().enumerate() {
        let room = if face.active { 0.0 } else { slack };
        let (start, end) = (face.height(from) - room, face.height(to) - room);
        if start >= 0.0 && end >= 0.0 && !(face.closed && end == 0.0) {
            return None;
        }
        if start > end {
            let at = start / divisor(start - end);
            if start >= 0.0 && entry.is_none_or(|best| at > best.at) {
                entry = Some(Entry { face: index, at });
            }
        } else if start < end {
            leave = leave.min(start / divisor(start - end));
        }
    }
    entry.filter(|entry| entry.at < leave)
}

/// What memory reaches from a remembered face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// The face that is remembered next.
    pub face: usize,
    /// The face that pushes: of the reached face and its active neighbours, the one of least depth.
    pub pushes: usize,
    /// Its depth, m.
    pub depth: f64,
}

/// From a remembered face memory walks to the neighbour of least depth while that lowers the depth, never round a sharp
/// rim, and never to where the face that pushes is deeper: a face reached may lack a sharp neighbour that pushed before.
///
/// So the depth that comes out is at most that of the face that pushes without the walk, and between two commits it grows
/// by no more than the point has moved. Heights above the faces must be finite, as for [`shallowest_face`].
#[inline]
pub fn follow(p: &Vec3, polyhedron: &Polyhedron, remembered: usize) -> Reached {
    let mut here = Reached::at(p, polyhedron, remembered);
    // Every step lowers the depth below the face reached, so no face is met twice. Where that face pushes itself, no
    // neighbour is less deep, and most contacts end here.
    while here.pushes != here.face
        && let Some(next) = less_deep_neighbor(p, polyhedron, here.face)
    {
        let there = Reached::at(p, polyhedron, next);
        if there.depth > here.depth {
            break;
        }
        here = there;
    }
    here
}

impl Reached {
    #[inline]
    fn at(p: &Vec3, polyhedron: &Polyhedron, index: usize) -> Self {
        let face = &index;
        match polyhedron.planes().only_block() {
            Some(block) => {
                run_at_level!(reached_in_block(p: Vec3, block: PlaneBlock, face: usize) -> Reached)
            }
            None => Self::at_face_of_many(p, polyhedron, index),
        }
    }

    fn at_face_of_many(p: &Vec3, polyhedron: &Polyhedron, face: usize) -> Self {
        let mut best = Self { face, pushes: face, depth: -polyhedron.height(face, p) };
        for rim in polyhedron.rim(face) {
            let neighbor = rim.neighbor as usize;
            let depth = -polyhedron.height(neighbor, p);
            let nearer = depth < best.depth || (depth == best.depth && neighbor < best.pushes);
            if polyhedron.faces[neighbor].active && nearer {
                (best.pushes, best.depth) = (neighbor, depth);
            }
        }
        best
    }
}

/// The same where all faces are in one block.
#[inline(always)]
fn reached_in_block<S: Simd>(simd: S, p: &Vec3, block: &PlaneBlock, &face: &usize) -> Reached {
    let asked: LaneBits = block.beside[face] | 1 << face;
    let heights = block.heights(simd, &Splat::new(simd, p));
    let heights = simd.select(simd.mask(asked), heights, simd.splat(f64::NEG_INFINITY));
    let top = simd.largest(heights);
    let pushes = simd.bits(simd.equal(heights, simd.splat(top))).trailing_zeros() as usize;
    Reached { face, pushes, depth: -top }
}

/// The active neighbour across a blunt edge below which the point is least deep, if that is less than below the face.
fn less_deep_neighbor(p: &Vec3, polyhedron: &Polyhedron, face: usize) -> Option<usize> {
    let mut next = None;
    let mut depth = -polyhedron.height(face, p);
    for rim in polyhedron.rim(face) {
        let neighbor = rim.neighbor as usize;
        let other = &polyhedron.faces[neighbor];
        let followed = other.normal.dot(&polyhedron.faces[face].normal) > FOLLOWED_COSINE_MIN;
        let candidate = -other.height(p);
        let better = candidate < depth || (candidate == depth && next.is_some_and(|best| neighbor < best));
        if other.active && followed && better {
            depth = candidate;
            next = Some(neighbor);
        }
    }
    next
}

/// The contact of a point inside with the face that pushes; `None` if the point lies on it.
pub fn point_below_face(p: &Vec3, polyhedron: &Polyhedron, face: usize) -> Option<Interference> {
    let depth = -polyhedron.height(face, p);
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: polyhedron.faces[face].normal,
        deepest_b: *p,
        feature: Feature::face(face),
    })
}
