//! Selects the piece whose contact counts if a line segment leaves a body at an edge in which an internal
//! face ends.

use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use pong_geometry::interference::segment_at_walls::{ExitAtWall, exit_at_wall, part_inside};
use pong_geometry::primitive::LineSegment;

/// Least part of the segment inside a piece, relative to the longest part among the pieces that the segment
/// leaves at the same point. The segment only touches a piece with a shorter part, so the exit from it does
/// not count.
const SHARE_HELD: f64 = 0.5;

/// Returns true for an exit at the boundary edge of an internal face, if rounding lets the segment leave
/// through the internal face instead of the active face. The discs of a cylinder share their springs; segments do not.
pub(super) fn is_exit_that_stands_in(contact: &ContactCandidate) -> bool {
    contact.half && !contact.shares && contact.status == CandidateStatus::StandIn
}

/// Keeps one of the exits that several pieces report at one point, and culls the others. `group` has the
/// contacts of one end of a segment with the pieces of one body.
///
/// At the boundary edge of an internal face, rounding may make both pieces at that face report an exit of the
/// segment, or neither. These rules choose one:
///
/// * Only exits count whose piece contains a large part of the segment ([`SHARE_HELD`]).
/// * The first exit through an active face counts; if there is none, the first through an internal face.
/// * An exit through an internal face is culled if a piece contains the segment past the exit.
///
/// A segment end at the same point counts as an exit, unless the segment ends at this point in all pieces.
pub(super) fn keep_one_of_exits(group: &mut [ContactCandidate], context: &PairContext<'_>) {
    let Some(first) = group.first() else { return };
    let local = &context.body_a.segments[first.element_a as usize];
    let segment = LineSegment { ends: local.ends.map(|end| context.motion.x_ba.point(&end)) };
    let exits = Exits { segment, end: first.key.end as usize, context };
    for index in 0..group.len() {
        let exit = exits.of(&group[index]).filter(|exit| exits.leaves(exit, group));
        if exit.is_some_and(|exit| !exits.counts(index, &exit, group)) {
            group[index].status = CandidateStatus::Culled;
        }
    }
}

struct Exits<'a> {
    segment: LineSegment,
    end: usize,
    context: &'a PairContext<'a>,
}

impl Exits<'_> {
    /// Exit of the segment from a contact's piece; `None` if it is not at the boundary edge of an internal
    /// face.
    fn of(&self, found: &ContactCandidate) -> Option<Exit> {
        let may_leave = found.status == CandidateStatus::AtWall || is_exit_that_stands_in(found);
        let piece = &self.context.body_b.polyhedra[found.element_b as usize];
        // A contact of one end may come from an exit at the other end of the segment.
        let at = |end: usize| Some(Exit { end, at_wall: exit_at_wall(&self.segment, piece, end)? });
        if may_leave { at(self.end).or_else(|| at(1 - self.end)) } else { None }
    }

    /// Returns true if the segment continues past the exit of at least one piece. Otherwise the segment ends
    /// there in all pieces.
    fn leaves(&self, exit: &Exit, group: &[ContactCandidate]) -> bool {
        let mut others = group.iter().filter_map(|found| self.of(found));
        others.any(|other| !other.at_wall.is_tip && other.is_at_place_of(exit))
    }

    fn counts(&self, index: usize, exit: &Exit, group: &[ContactCandidate]) -> bool {
        let rivals = || {
            let exits = group.iter().enumerate().filter_map(|(index, found)| Some((index, self.of(found)?)));
            exits.filter(|(_, other)| other.is_at_place_of(exit))
        };
        let longest = rivals().map(|(_, other)| other.held()).fold(0.0, f64::max);
        let holds_much = |other: &Exit| other.held() >= SHARE_HELD * longest;
        let mut much = rivals().filter(|(_, other)| holds_much(other)).map(|(index, _)| index);
        let by_face = || {
            let mut faces = rivals().filter(|(index, _)| !is_exit_that_stands_in(&group[*index]));
            faces.find(|(_, other)| holds_much(other)).map(|(index, _)| index)
        };
        by_face().or_else(|| much.next()) == Some(index)
            && !(is_exit_that_stands_in(&group[index]) && self.goes_on(exit))
    }

    /// Returns true if a piece of the body contains the segment past an exit, for more than the rounding of
    /// positions along the segment.
    fn goes_on(&self, exit: &Exit) -> bool {
        let (place, slack) = (exit.place(), exit.at_wall.slack);
        let mut parts =
            self.context.body_b.polyhedra.iter().filter_map(|piece| part_inside(&self.segment, piece));
        parts.any(|[from, to]| match exit.end {
            1 => from <= place + slack && to > place + 2.0 * slack,
            _ => to >= place - slack && from < place - 2.0 * slack,
        })
    }
}

/// Exit of the segment from a piece.
struct Exit {
    end: usize,
    at_wall: ExitAtWall,
}

impl Exit {
    /// Parameter along the segment, 0 to 1.
    fn place(&self) -> f64 {
        self.at_wall.inside[self.end]
    }

    /// Share of the segment that lies in the piece.
    fn held(&self) -> f64 {
        self.at_wall.inside[1] - self.at_wall.inside[0]
    }

    fn is_at_place_of(&self, other: &Self) -> bool {
        let slack = self.at_wall.slack + other.at_wall.slack;
        self.end == other.end && (self.place() - other.place()).abs() <= slack
    }
}
