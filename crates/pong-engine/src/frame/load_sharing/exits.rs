//! Which piece of a body carries an end of a line segment that leaves the body where an inner wall ends.

use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use pong_geometry::interference::segment_at_walls::{ExitAtWall, exit_at_wall, part_inside};
use pong_geometry::primitive::LineSegment;

/// Of pieces that a segment leaves in one place only those count that hold at least this share of what the longest of them
/// holds of it: others only touch.
const SHARE_HELD: f64 = 0.5;

/// Whether a segment leaves by the edge in which a wall ends, but by the wall as rounding has it.
pub(super) fn is_exit_that_stands_in(contact: &ContactCandidate) -> bool {
    contact.half && contact.status == CandidateStatus::StandIn
}

/// Marks as dropped what a body lacks of the exits of one end (`group`: the contacts of the end with the pieces of one body).
///
/// Rounding lets a segment that leaves through the edge in which a wall ends leave the pieces on both sides of the wall, or
/// neither. Of the pieces that it leaves in one place, the first counts that holds much of it, and before others one that it
/// leaves by an active face. A piece that it leaves by the wall counts only if no piece holds what lies beyond. A tip that lies
/// there is decided alike.
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
    /// How the segment leaves the piece of a contact, if that is where a wall ends.
    fn of(&self, found: &ContactCandidate) -> Option<Exit> {
        let may_leave = found.status == CandidateStatus::AtWall || is_exit_that_stands_in(found);
        let piece = &self.context.body_b.polyhedra[found.element_b as usize];
        // What a segment crosses may be told of its other end.
        let at = |end: usize| Some(Exit { end, at_wall: exit_at_wall(&self.segment, piece, end)? });
        if may_leave { at(self.end).or_else(|| at(1 - self.end)) } else { None }
    }

    /// Whether the segment leaves a piece at the place of an exit, and does not end in all that it is in there.
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

    /// Whether another piece of the body holds more of the segment beyond an exit than rounding.
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

/// Where the segment leaves a piece.
struct Exit {
    end: usize,
    at_wall: ExitAtWall,
}

impl Exit {
    /// As a parameter along the segment.
    fn place(&self) -> f64 {
        self.at_wall.inside[self.end]
    }

    /// How much of the segment the piece holds, as a share of it.
    fn held(&self) -> f64 {
        self.at_wall.inside[1] - self.at_wall.inside[0]
    }

    fn is_at_place_of(&self, other: &Self) -> bool {
        let slack = self.at_wall.slack + other.at_wall.slack;
        self.end == other.end && (self.place() - other.place()).abs() <= slack
    }
}
