//! Line segment (A) – polyhedron (B) (docs/theory.md, 2.3).
//!
//! The part of the segment inside the solid has two ends. For each active face f, each end carries half a spring:
//!
//! * a *tip* of the segment, inside the solid or straight below the face, has its depth below f and pushes along
//!   the face's normal;
//! * where the segment leaves the solid through another face h, the *crossing* is the distance of the segment's line
//!   below the line in which the planes of f and h meet, and pushes along the common normal of both lines;
//! * where it leaves through f itself the end carries nothing.
//!
//! The face that stores the least energy pushes. An obvious rule asks instead where
//! the segment leaves the *polygon* of f. It was tried: on a box the two agree, except for a segment whose far endpoint
//! has risen above the top, which a side face then claims with half the force, so that closed paths gain energy; beside
//! obtuse edges it halves the force of a segment that lies flat (docs/decisions/0001).
//!
//! Degenerate cases: a segment parallel to a face crosses at its depth; two parallel planes meet nowhere and that
//! face takes no part; a segment that only touches has no contact; ties go to the lower face.

use super::Interference;
use super::segment_bounds::{Bounds, SegmentPlanes};
use super::segment_ends::{AtEnd, InsideEnd, Measured};
use crate::primitive::{FacePlanes, LineSegment, Polyhedron};
use crate::simd::{Finder, First, FirstOf, LANES, Simd, is_moderate, run_at_level};

/// The contact at each end: 0 towards the segment's first end, 1 towards its second.
pub type EndContacts = [Option<Interference>; 2];

/// Energies this close are a tie. Of a segment that enters by f and leaves by h both claim the one crossing, and
/// rounding must not decide which: the state key is the end.
const TIE: f64 = 1.0 - 1e-12;

/// Tests a segment against one convex piece. Each contact carries half of the pair's stiffness and damping.
#[inline]
pub fn line_segment_polyhedron(segment: &LineSegment, polyhedron: &Polyhedron) -> EndContacts {
    if polyhedron.planes().blocks.len() <= FEW {
        run_at_level!(test_few(segment: LineSegment, polyhedron: Polyhedron) -> EndContacts)
    } else {
        run_at_level!(test_many(segment: LineSegment, polyhedron: Polyhedron) -> EndContacts)
    }
}

/// For how many blocks of faces bounds of the energy are kept.
const FEW: usize = 2;
const SOME: usize = FacePlanes::IN_REGISTERS;
const MANY: usize = 16;

#[inline(always)]
fn test_few<S: Simd>(simd: S, segment: &LineSegment, polyhedron: &Polyhedron) -> EndContacts {
    test::<S, FirstOf<S, FEW>, FEW>(simd, segment, polyhedron)
}

#[inline(always)]
fn test_many<S: Simd>(simd: S, segment: &LineSegment, polyhedron: &Polyhedron) -> EndContacts {
    if polyhedron.planes().blocks.len() <= SOME {
        test::<S, FirstOf<S, SOME>, SOME>(simd, segment, polyhedron)
    } else {
        test::<S, First<S>, MANY>(simd, segment, polyhedron)
    }
}

#[inline(always)]
fn test<S: Simd, F: Finder<S>, const N: usize>(
    simd: S,
    segment: &LineSegment,
    polyhedron: &Polyhedron,
) -> EndContacts {
    let planes = SegmentPlanes::new(simd, segment, polyhedron);
    let Some(inside) = planes.inside_part::<F, N>() else { return [None, None] };
    let mut search = Search { segment, polyhedron, inside: inside.ends, best: None };
    let moderate =
        polyhedron.planes().moderate && is_moderate(&segment.ends[0]) && is_moderate(&segment.ends[1]);
    if polyhedron.planes().blocks.len() > N || !moderate {
        search.visit_all();
        return search.contacts();
    }
    let likely = if N > FacePlanes::IN_REGISTERS { planes.nearest_face::<N>(&inside) } else { None };
    let limit = match likely {
        Some(face) => limit_of(search.stored(face).as_ref()),
        None => f64::INFINITY,
    };
    search.visit_likely(&planes.bounds::<N>(&inside, limit), limit);
    search.contacts()
}

/// A face whose bound is so many times what another stores never decides. Far beyond rounding of the bounds, and beyond
/// any number of ties, each the next one's.
const BEYOND_ROUNDING: f64 = 1.0 + 1e-6;

/// The search for the face that stores the least energy.
struct Search<'a> {
    segment: &'a LineSegment,
    polyhedron: &'a Polyhedron,
    inside: [InsideEnd; 2],
    best: Option<Stored>,
}

/// What a face stores.
#[derive(Clone, Copy)]
struct Stored {
    face: usize,
    /// The sum of the squares of what its ends measure, m².
    energy: f64,
    ends: [Measured; 2],
}

impl Search<'_> {
    #[cold]
    fn visit_all(&mut self) {
        let polyhedron = self.polyhedron;
        for face in (0..polyhedron.faces.len()).filter(|&face| polyhedron.faces[face].active) {
            self.visit(self.stored(face));
        }
    }

    /// Visits the faces, in their order, whose bounds let them store as little as the likeliest one.
    #[inline(always)]
    fn visit_likely<S: Simd, const N: usize>(&mut self, bounds: &Bounds<S, N>, limit: f64) {
        let likeliest = bounds.least();
        let at_likeliest = match likeliest {
            Some(face) => self.stored(face),
            None => None,
        };
        let mut limit = limit.min(limit_of(at_likeliest.as_ref()));
        for block in 0..self.polyhedron.planes().blocks.len() {
            let mut faces = bounds.up_to(limit, block);
            while faces != 0 {
                let face = block * LANES + faces.trailing_zeros() as usize;
                let is_likeliest = likeliest == Some(face);
                self.visit(if is_likeliest { at_likeliest } else { self.stored(face) });
                limit = self.best.map_or(limit, |best| limit.min(best.energy * BEYOND_ROUNDING));
                faces &= faces - 1;
            }
        }
    }

    #[inline(always)]
    fn visit(&mut self, stored: Option<Stored>) {
        let Some(stored) = stored else { return };
        let least = self.best.map_or(f64::INFINITY, |best| best.energy);
        if stored.energy > 0.0 && stored.energy < least * TIE {
            self.best = Some(stored);
        }
    }

    /// What a face stores; `None` if it takes no part.
    ///
    /// An end at an inner wall counts, though the piece behind the wall carries it: without it the face would not be
    /// found where its other end does not touch.
    fn stored(&self, face: usize) -> Option<Stored> {
        let ends = [self.at_end(face, 0).measured()?, self.at_end(face, 1).measured()?];
        let square = |end: usize| ends[end].depth() * ends[end].depth();
        Some(Stored { face, energy: square(0) + square(1), ends })
    }

    #[inline(always)]
    fn at_end(&self, face: usize, end: usize) -> AtEnd<'_> {
        let tip = &self.segment.ends[end];
        AtEnd { segment: self.segment, polyhedron: self.polyhedron, face, inside: &self.inside[end], tip }
    }

    /// What the best face carries.
    fn contacts(&self) -> EndContacts {
        match &self.best {
            Some(best) => [self.carried(best, 0), self.carried(best, 1)],
            None => [None, None],
        }
    }

    #[inline(always)]
    fn carried(&self, best: &Stored, end: usize) -> Option<Interference> {
        let contact = self.at_end(best.face, end).contact(&best.ends[end])?;
        carries(self.polyhedron, &self.inside[end], &contact).then_some(contact)
    }
}

/// Above this no face decides, when one stores so much.
#[inline(always)]
fn limit_of(stored: Option<&Stored>) -> f64 {
    match stored {
        Some(stored) if stored.energy > 0.0 => stored.energy * BEYOND_ROUNDING,
        _ => f64::INFINITY,
    }
}

/// Whether an end carries what it measures. One at an inner wall does not, the piece behind the wall does; but where
/// the wall ends in a convex edge of the body, that edge pushes (2.1), once for all pieces that have it.
#[inline]
fn carries(polyhedron: &Polyhedron, end: &InsideEnd, measured: &Interference) -> bool {
    let at_wall = end.leaves_by.is_some_and(|h| !polyhedron.faces[h].active);
    let feature = measured.feature;
    !at_wall || (!feature.is_face() && polyhedron.edges[feature.index()].push.is_some())
}
