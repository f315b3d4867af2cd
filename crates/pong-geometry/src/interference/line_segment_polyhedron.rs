//! Line segment (A) – polyhedron (B) (docs/theory.md, 2.3).
//!
//! The part of the segment inside the solid has two ends. For each active face f, each end carries half a spring:
//!
//! * a *tip*, an end point of the segment that is inside the solid or straight below the polygon of f: its
//!   depth is measured below f, and it pushes along the normal of f;
//! * a *crossing*, where the segment leaves the solid through another face h: its depth is the distance of
//!   the segment's line below the line in which the planes of f and h intersect, and it pushes along the
//!   common normal of both lines;
//! * where the segment leaves through f itself, the end carries no force.
//!
//! The face that stores the least energy pushes. If the segment enters through f and leaves through h, both
//! faces measure the same crossing of their common edge, at opposite ends of the segment. The crossing is
//! assigned to the end whose tip is farther out, whichever of the two faces is evaluated.
//!
//! A simpler rule would test where the segment leaves the *polygon* of f. That rule gains energy on closed
//! paths, and halves the force of a segment that lies flat beside an obtuse edge (docs/decisions/0001).
//!
//! Degenerate cases: a crossing below a face parallel to the segment has the segment's depth below that face;
//! a face f parallel to the exit face h takes no part; a segment that only touches has no contact; of two
//! faces with equal energy, the one with the lower index pushes.

use super::Interference;
use super::segment_at_walls::{end_that_crosses, inside_of_wide_walls, leaves_at_wall};
use super::segment_bounds::{Bounds, Likely, Missed, SegmentPlanes};
use super::segment_ends::{AtEnd, InsideEnd, Measured, Wedge};
use crate::primitive::{Containment, FacePlanes, LineSegment, Polyhedron};
use crate::simd::{Finder, First, FirstOf, LANES, Simd, is_moderate, run_at_level};

/// Contact at each end: 0 towards the segment's first end, 1 towards its second.
pub type EndContacts = [Option<Interference>; 2];

/// Contact at each end for one piece of a body, with the role that the neighbouring pieces play in it.
pub type PieceContacts = [Option<(Interference, AtWall)>; 2];

/// Role that the neighbouring pieces play in a contact of one piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtWall {
    /// No role. Exception: if a tip may lie on an internal face, the caller must test
    /// [`Polyhedron::containment`], because another piece may contain the tip too.
    No,
    /// Crossing of an edge at which an internal face ends. The piece behind that face may report the same
    /// crossing.
    SharedEdge,
    /// Fallback for a tip that rounding puts beyond an internal face. It counts if no piece contains the tip.
    StandsIn,
    /// Exit through an active face where an internal face ends. The piece behind the internal face may report
    /// this end as well.
    Exit,
    /// Fallback for an exit as in `Exit`, if rounding lets the segment leave through the internal face
    /// instead of the active face. It counts if no other piece reports this end, and no other piece contains
    /// the segment beyond the exit.
    ExitStandsIn,
}

/// Energies within this factor count as equal, so that rounding does not choose between equal faces.
const TIE: f64 = 1.0 - 1e-12;

/// Tests a segment against one convex solid, or against one piece of a body by itself. A crossing of an edge
/// at which an internal face ends is returned only for the first piece that has the edge. Each contact
/// carries half of the pair's stiffness and damping.
#[inline]
pub fn line_segment_polyhedron(segment: &LineSegment, polyhedron: &Polyhedron) -> EndContacts {
    let counts = |(contact, at_wall): &(Interference, AtWall)| match at_wall {
        AtWall::No => true,
        AtWall::SharedEdge => polyhedron.edges[contact.feature.index()].push.is_some(),
        AtWall::Exit => true,
        AtWall::StandsIn | AtWall::ExitStandsIn => false,
    };
    line_segment_piece(segment, polyhedron).map(|found| found.filter(counts).map(|(contact, _)| contact))
}

/// Tests a segment against one piece of a body.
#[inline]
pub fn line_segment_piece(segment: &LineSegment, polyhedron: &Polyhedron) -> PieceContacts {
    if polyhedron.planes().blocks.len() <= FEW {
        run_at_level!(test_few(segment: LineSegment, polyhedron: Polyhedron) -> PieceContacts)
    } else {
        run_at_level!(test_many(segment: LineSegment, polyhedron: Polyhedron) -> PieceContacts)
    }
}

/// Returns the part of a segment inside a convex solid, as fractions of the segment's length; `None` if it is
/// empty.
#[inline]
pub(super) fn part_in_solid(segment: &LineSegment, polyhedron: &Polyhedron) -> Option<[f64; 2]> {
    let ends = match polyhedron.planes().blocks.len() {
        ..=FEW => {
            run_at_level!(inside_few(segment: LineSegment, polyhedron: Polyhedron) -> Option<[InsideEnd; 2]>)
        }
        _ => {
            run_at_level!(inside_many(segment: LineSegment, polyhedron: Polyhedron) -> Option<[InsideEnd; 2]>)
        }
    };
    ends.map(|ends| ends.map(|end| end.at))
}

#[inline(always)]
fn inside_few<S: Simd>(simd: S, segment: &LineSegment, polyhedron: &Polyhedron) -> Option<[InsideEnd; 2]> {
    let planes = SegmentPlanes::new(simd, segment, polyhedron);
    planes.inside_part::<FirstOf<S, FEW>, FEW>().ok().map(|inside| inside.ends)
}

#[inline(always)]
fn inside_many<S: Simd>(simd: S, segment: &LineSegment, polyhedron: &Polyhedron) -> Option<[InsideEnd; 2]> {
    let planes = SegmentPlanes::new(simd, segment, polyhedron);
    planes.inside_part::<First<S>, MANY>().ok().map(|inside| inside.ends)
}

/// Largest numbers of face blocks for which the three variants of the test are compiled. Above `MANY` blocks,
/// every face is evaluated.
const FEW: usize = 2;
const SOME: usize = FacePlanes::IN_REGISTERS;
const MANY: usize = 16;

#[inline(always)]
fn test_few<S: Simd>(simd: S, segment: &LineSegment, polyhedron: &Polyhedron) -> PieceContacts {
    test::<S, FirstOf<S, FEW>, FEW>(simd, segment, polyhedron)
}

#[inline(always)]
fn test_many<S: Simd>(simd: S, segment: &LineSegment, polyhedron: &Polyhedron) -> PieceContacts {
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
) -> PieceContacts {
    let planes = SegmentPlanes::new(simd, segment, polyhedron);
    let mut inside = match planes.inside_part::<F, N>() {
        Ok(inside) => inside,
        Err(missed) => {
            let has_walls = !polyhedron.planes().all_active;
            let may_be_at_walls = missed == Missed::Perhaps && has_walls && !planes.misses_wide_walls::<N>();
            return if may_be_at_walls { along_walls(segment, polyhedron) } else { [None, None] };
        }
    };
    let exits = if polyhedron.planes().all_active {
        [AtWall::No; 2]
    } else {
        assign_exits(segment, polyhedron, &mut inside.ends)
    };
    let mut search =
        Search { segment, polyhedron, inside: inside.ends, exits, best: None, least_energy: f64::INFINITY };
    let moderate =
        polyhedron.planes().moderate && is_moderate(&segment.ends[0]) && is_moderate(&segment.ends[1]);
    if polyhedron.planes().blocks.len() > N || !moderate {
        search.visit_all();
        return search.contacts();
    }
    // With many faces, the face nearest to a tip is evaluated first. Its energy is an upper limit for the
    // least energy, so only the few faces that may store less remain to be evaluated.
    let nearest = if N > FacePlanes::IN_REGISTERS { planes.nearest_face::<N>(&inside) } else { None };
    let at_nearest = match &nearest {
        Some(nearest) => search.stored(nearest.face),
        None => None,
    };
    let likely = match &nearest {
        Some(nearest) => planes.likely::<N>(nearest, limit_of(at_nearest.as_ref())),
        None => Likely::anywhere(polyhedron.planes().count::<N>()),
    };
    if likely.faces == 1 {
        search.best = at_nearest;
    } else {
        search.visit_likely(&planes.bounds::<N>(&inside, likely.blocks), at_nearest);
    }
    search.contacts()
}

/// Returns the contacts of a segment that runs along the line in which internal faces meet. Rounding may put
/// the segment outside all pieces there. Each piece therefore reports the tips as fallbacks, and load sharing
/// decides which one counts.
#[cold]
fn along_walls(segment: &LineSegment, polyhedron: &Polyhedron) -> PieceContacts {
    let Some(mut inside) = inside_of_wide_walls(segment, polyhedron) else { return [None, None] };
    let exits = assign_exits(segment, polyhedron, &mut inside);
    let mut search = Search { segment, polyhedron, inside, exits, best: None, least_energy: f64::INFINITY };
    search.visit_all();
    let contacts = search.contacts();
    [0, 1].map(|end: usize| {
        let (contact, at_wall) = contacts[end]?;
        match at_wall {
            AtWall::Exit | AtWall::ExitStandsIn => Some((contact, AtWall::ExitStandsIn)),
            _ if contact.deepest_b == segment.ends[end] => Some((contact, AtWall::StandsIn)),
            _ => None,
        }
    })
}

/// Changes exits at the boundary edge of an internal face to exits through the active face at that edge, even
/// if rounding named the internal face. Returns the role of the neighbouring pieces at each end.
fn assign_exits(segment: &LineSegment, polyhedron: &Polyhedron, inside: &mut [InsideEnd; 2]) -> [AtWall; 2] {
    [0, 1].map(|end: usize| match leaves_at_wall(segment, polyhedron, &inside[end], end) {
        None => AtWall::No,
        Some(by_active) => {
            let same_face = by_active.leaves_by == inside[end].leaves_by;
            inside[end] = by_active;
            if same_face { AtWall::Exit } else { AtWall::ExitStandsIn }
        }
    })
}

/// Factor on the energy of one face: a face whose lower bound exceeds the product cannot be the one of least
/// energy. The factor exceeds 1 by far more than the rounding of the bounds, and by far more than `TIE`
/// allows even if many faces in a row count as equal.
const BEYOND_ROUNDING: f64 = 1.0 + 1e-6;

/// Search for the face that stores the least energy.
struct Search<'a> {
    segment: &'a LineSegment,
    polyhedron: &'a Polyhedron,
    inside: [InsideEnd; 2],
    /// Role of the neighbouring pieces at each end.
    exits: [AtWall; 2],
    best: Option<Stored>,
    /// Energy of `best`, m²; infinite without one.
    least_energy: f64,
}

/// Energy stored by one face.
#[derive(Clone, Copy)]
struct Stored {
    face: usize,
    /// Sum of the squared depths at both ends, m².
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

    /// Evaluates, in face order, all faces whose lower bound is at most the least energy found so far. The
    /// first limit is the smaller energy of two faces: the face of least bound and the face nearest to a tip
    /// (`at_nearest`).
    #[inline(always)]
    fn visit_likely<S: Simd, const N: usize>(&mut self, bounds: &Bounds<S, N>, at_nearest: Option<Stored>) {
        let likeliest = bounds.least();
        let at_likeliest = match (likeliest, at_nearest) {
            (Some(face), Some(nearest)) if nearest.face == face => at_nearest,
            (Some(face), _) => self.stored(face),
            (None, _) => None,
        };
        let mut limit = limit_of(at_nearest.as_ref()).min(limit_of(at_likeliest.as_ref()));
        for block in 0..self.polyhedron.planes().blocks.len() {
            let mut faces = bounds.up_to(limit, block);
            while faces != 0 {
                let face = block * LANES + faces.trailing_zeros() as usize;
                let is_likeliest = likeliest == Some(face);
                self.visit(if is_likeliest { at_likeliest } else { self.stored(face) });
                limit = limit.min(self.least_energy * BEYOND_ROUNDING);
                faces &= faces - 1;
            }
        }
    }

    #[inline(always)]
    fn visit(&mut self, stored: Option<Stored>) {
        let Some(stored) = stored else { return };
        // A face with zero energy wins too. The segment then lies in the face or only touches it, and no face
        // pushes.
        if stored.energy < self.least_energy * TIE {
            self.least_energy = stored.energy;
            self.best = Some(stored);
        }
    }

    /// Returns the energy stored by a face; `None` if the face takes no part.
    ///
    /// At an end that leaves through an internal face the depth is included, although the piece behind that
    /// face carries this end. Otherwise the energy of the face would be too low, and the wrong face could
    /// push.
    fn stored(&self, face: usize) -> Option<Stored> {
        let ends = [self.at_end(face, 0).measured()?, self.at_end(face, 1).measured()?];
        let square = |end: usize| ends[end].depth() * ends[end].depth();
        Some(Stored { face, energy: square(0) + square(1), ends })
    }

    #[inline(always)]
    fn at_end(&self, face: usize, end: usize) -> AtEnd<'_> {
        let tip_b = &self.segment.ends[end];
        AtEnd { segment: self.segment, polyhedron: self.polyhedron, face, inside: &self.inside[end], tip_b }
    }

    /// Returns the contacts of the face of least energy.
    fn contacts(&self) -> PieceContacts {
        let Some(best) = &self.best else { return [None, None] };
        let at_ends = [self.carried(best, 0), self.carried(best, 1)];
        let is_lone = at_ends[0].is_some() != at_ends[1].is_some();
        let mut contacts = [None, None];
        for (found_at, found) in at_ends.into_iter().enumerate() {
            // A contact that is assigned to the other end counts only if that end has none of its own.
            // Otherwise the piece behind the internal face reports it.
            if let Some((found, end)) = found
                && (is_lone || end == found_at)
            {
                contacts[end] = Some(found);
            }
        }
        contacts
    }

    /// Returns the contact found at `end`, and the end to which it is assigned; `None` if there is none.
    #[inline(always)]
    fn carried(&self, best: &Stored, end: usize) -> Option<((Interference, AtWall), usize)> {
        let contact = self.at_end(best.face, end).contact(&best.ends[end]);
        let exit = self.inside[end].leaves_by;
        if exit.is_some_and(|exit| !self.polyhedron.faces[exit].active) {
            return self.carried_at_wall(best, end, contact);
        }
        let (contact, at_wall) = (contact?, self.exits[end]);
        let end = match (&best.ends[end], exit) {
            (Measured::Crossing(_), Some(exit)) if self.is_claimed_by_both(best, end, exit) => {
                Wedge::of_faces(self.polyhedron, best.face, exit).farther_out(self.segment, end)
            }
            _ => end,
        };
        Some(((contact, at_wall), end))
    }

    /// Returns `true` if two faces measure the same crossing: the best face, through which the segment
    /// enters, and `exit`, through which it leaves at `end`.
    #[inline(always)]
    fn is_claimed_by_both(&self, best: &Stored, end: usize, exit: usize) -> bool {
        let of_exit = || self.at_end(exit, 1 - end).measured();
        matches!(best.ends[1 - end], Measured::Leaves) && matches!(of_exit(), Some(Measured::Crossing(_)))
    }

    /// Returns the contact at an end that leaves through an internal face. As a rule `None`, because the
    /// piece behind that face reports this end. There are two exceptions: a crossing of a convex edge in
    /// which the internal face ends, and a tip at internal faces.
    #[cold]
    fn carried_at_wall(
        &self,
        best: &Stored,
        end: usize,
        contact: Option<Interference>,
    ) -> Option<((Interference, AtWall), usize)> {
        let crossing = contact.filter(|contact| !contact.feature.is_face());
        let carrier = |crossing: &Interference| {
            end_that_crosses(self.segment, self.polyhedron, best.face, end, crossing)
        };
        match crossing.and_then(|crossing| Some((crossing, carrier(&crossing)?))) {
            Some((crossing, carrier)) => Some(((crossing, AtWall::SharedEdge), carrier)),
            // A tip on internal faces within rounding is a fallback, because it cannot be decided whether it
            // is inside.
            None if self.polyhedron.containment(&self.segment.ends[end]) != Containment::Outside => {
                let stood_in = along_walls(self.segment, self.polyhedron)[end];
                stood_in.filter(|(_, at_wall)| *at_wall == AtWall::StandsIn).map(|found| (found, end))
            }
            None => None,
        }
    }
}

/// Returns the energy above which a face cannot be the one of least energy, given the energy that another
/// face stores. Infinite if that other face takes no part or stores none.
#[inline(always)]
fn limit_of(stored: Option<&Stored>) -> f64 {
    match stored {
        Some(stored) if stored.energy > 0.0 => stored.energy * BEYOND_ROUNDING,
        _ => f64::INFINITY,
    }
}
