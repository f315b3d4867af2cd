//! Point (A) – polyhedron (B): contact with the face by which the point entered (docs/theory.md, 2.4).
//!
//! A point inside is pushed out through the face by which it entered, or through a neighbour of that face if
//! the neighbour is nearer. The engine remembers the face of entry. The functions here test the point against
//! one piece of a body.
//!
//! Degenerate cases: a point on an active face is outside. A point on an internal face belongs to the piece
//! whose face is `closed`. Of equally near faces, the one of lower index counts.

use super::highest_face::{Whereabouts, highest_of_many};
use super::{Feature, Interference};
#[cfg(doc)]
use crate::primitive::FacePlanes;
use crate::primitive::{PlaneBlock, Polyhedron};
use crate::simd::{LaneBits, Simd, Splat, run_at_level};
use crate::{Vec3, divisor};

/// Least cosine between the normals of two adjacent faces at which the remembered face may change from one to
/// the other. Across sharper edges it does not change (docs/theory.md, 2.4).
const FOLLOWED_COSINE_MIN: f64 = 0.3;

/// Returns the active face of least depth at a point; `None` if no face is active. The heights of the point
/// above the faces must be finite, as they are for coordinates up to 1e100.
#[inline]
pub fn shallowest_face(p: &Vec3, polyhedron: &Polyhedron) -> Option<usize> {
    run_at_level!(shallowest_face_in(p: Vec3, polyhedron: Polyhedron) -> Option<usize>)
}

#[inline(always)]
fn shallowest_face_in<S: Simd>(simd: S, p: &Vec3, polyhedron: &Polyhedron) -> Option<usize> {
    highest_of_many(simd, p, polyhedron.planes(), Whereabouts::Anywhere).map(|highest| highest.face)
}

/// Cosines up to this much below the largest count as equal to it, because normals rounded to single
/// precision differ by this much.
const SAME_COSINE: f64 = 1e-6;

/// Returns the active face whose normal is nearest to a direction; of equally near ones, the face of least
/// depth at the point. `None` if no face is active. Several normals are equally near if they are all
/// perpendicular to the direction, such as those of the sides of a piece that was entered through its base.
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

/// Place where the straight line from `from` (outside) to `to` (inside) enters a polyhedron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Face of entry, active or not.
    pub face: usize,
    /// Parameter along the line, 0…1.
    pub at: f64,
}

/// Returns the face through which a straight line enters the polyhedron; `None` if the line starts inside or
/// misses.
///
/// Internal faces are raised by their tolerance ([`FacePlanes::WALL_TOLERANCE`]). A line along an internal
/// face therefore enters by the active face, and a line between two adjacent pieces enters at least one of
/// them.
pub fn entry_of_line(from: &Vec3, to: &Vec3, polyhedron: &Polyhedron) -> Option<Entry> {
    // `entry` is not an `Option`, because a compiler may compare the number of an `Option` before its tag,
    // and an uninitialised number may raise a floating-point exception.
    let mut entry = Entry { face: usize::MAX, at: f64::NEG_INFINITY };
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
            if start >= 0.0 && at > entry.at {
                entry = Entry { face: index, at };
            }
        } else if start < end {
            leave = leave.min(start / divisor(start - end));
        }
    }
    (entry.face != usize::MAX && entry.at < leave).then_some(entry)
}

/// Result of [`follow`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// Face to remember next.
    pub face: usize,
    /// Face that pushes: the one of least depth among the remembered face and its active neighbours.
    pub pushes: usize,
    /// Depth below the face `pushes`, m.
    pub depth: f64,
}

/// Returns, for a point inside, the face to remember next and the face that pushes. `remembered` is the face
/// remembered so far. Step by step, it changes to its active neighbour of least depth, until one of these
/// holds:
///
/// * no neighbour is less deep;
/// * all less deep neighbours are across sharp edges;
/// * the step would increase the depth below the face that pushes. This face may be a sharp neighbour of the
///   present face but not of the next.
///
/// So the depth is at most that without a change, and between two commits it grows by no more than the point
/// has moved. The heights above the faces must be finite, as for [`shallowest_face`].
#[inline]
pub fn follow(p: &Vec3, polyhedron: &Polyhedron, remembered: usize) -> Reached {
    let mut here = Reached::at(p, polyhedron, remembered);
    // The loop ends, because every step lowers the depth below the remembered face. Usually the remembered
    // face itself pushes; then no neighbour has less depth.
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

/// Same as [`Reached::at`], for a polyhedron with all its faces in one block.
#[inline(always)]
fn reached_in_block<S: Simd>(simd: S, p: &Vec3, block: &PlaneBlock, &face: &usize) -> Reached {
    let candidates: LaneBits = block.beside[face] | 1 << face;
    let heights = block.heights(simd, &Splat::new(simd, p));
    let heights = simd.select(simd.mask(candidates), heights, simd.splat(f64::NEG_INFINITY));
    let top = simd.largest(heights);
    let pushes = simd.bits(simd.equal(heights, simd.splat(top))).trailing_zeros() as usize;
    Reached { face, pushes, depth: -top }
}

/// Returns the active neighbour of least depth across an edge that is not sharp. `None` if no such neighbour
/// has less depth than the face.
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

/// Returns the contact of a point inside with the face that pushes; `None` if the point lies on the face.
pub fn point_below_face(p: &Vec3, polyhedron: &Polyhedron, face: usize) -> Option<Interference> {
    let depth = -polyhedron.height(face, p);
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: polyhedron.faces[face].normal,
        deepest_b: *p,
        feature: Feature::face(face),
    })
}
