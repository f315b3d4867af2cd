//! Ends of a line segment at an internal face of a piece (see
//! [`line_segment_polyhedron`](super::line_segment_polyhedron)): its tip lies there, or it leaves the piece
//! there. The contact of such an end belongs to the next piece, on the other side of the internal face, with
//! two exceptions:
//!
//! * If the internal face ends in a convex edge of the body, that edge pushes, once for all pieces at it.
//! * Where several internal faces meet, rounding may put a tip in none of the pieces. Then a piece counts
//!   that contains the tip within the tolerance of its internal faces.
//!
//! A segment may leave the body through the edge between an active face and an internal face. Rounding then
//! decides by which of the two faces it leaves a piece, and whether the next piece contains a part of it. So
//! every such piece lets the segment leave by its active face, and load sharing chooses the piece whose
//! contact counts ([`exit_at_wall`]).

use super::Interference;
use super::segment_ends::{InsideEnd, Wedge};
use crate::primitive::{LineSegment, Polyhedron};
use crate::{Vec3, divisor};

/// Returns the part of a segment inside a piece whose internal faces are raised by their tolerance; `None` if
/// no part is inside.
pub(super) fn inside_of_wide_walls(segment: &LineSegment, polyhedron: &Polyhedron) -> Option<[InsideEnd; 2]> {
    inside_of(segment, polyhedron, polyhedron.planes().wall_slack)
}

/// Returns the part of a segment inside a piece whose internal faces are raised by `room` (m); `None` if no
/// part is inside.
fn inside_of(segment: &LineSegment, polyhedron: &Polyhedron, room: f64) -> Option<[InsideEnd; 2]> {
    let mut ends = [0.0, 1.0].map(|at| InsideEnd { at, leaves_by: None });
    for (index, face) in polyhedron.faces.iter().enumerate() {
        let room = if face.active { 0.0 } else { room };
        let [first, second] = segment.ends.map(|end| face.height(&end) - room);
        if first >= 0.0 && second >= 0.0 {
            return None;
        }
        let leaving = |end: &InsideEnd, is_nearer: fn(f64, f64) -> bool| {
            let at = first / divisor(first - second);
            is_nearer(at, end.at).then_some(InsideEnd { at, leaves_by: Some(index) })
        };
        if second < first {
            ends[0] = leaving(&ends[0], |at, before| at > before).unwrap_or(ends[0]);
        } else if first < second {
            ends[1] = leaving(&ends[1], |at, before| at < before).unwrap_or(ends[1]);
        }
    }
    (ends[0].at < ends[1].at).then_some(ends)
}

/// Returns the end of the segment to which the crossing of a convex edge is assigned, for an edge in which an
/// internal face ends. At that edge `face` meets a face of the next piece, here called the other face.
///
/// * `end`, if the tip there is above the other face, and `face` would store no more energy than the other
///   face;
/// * the opposite end, if the tip there is above `face`, and the other face would store no more energy than
///   `face`;
/// * if both conditions hold, the end that extends farther out;
/// * `None`, if neither holds. For example, if both tips are below both faces, each piece has a contact at
///   its own tip, and the crossing would be a third contact.
pub(super) fn end_that_crosses(
    segment: &LineSegment,
    polyhedron: &Polyhedron,
    face: usize,
    end: usize,
    crossing: &Interference,
) -> Option<usize> {
    let wedge = Wedge::of_edge(polyhedron, face, crossing.feature.index())?;
    let (beyond, before) = (&segment.ends[end], &segment.ends[1 - end]);
    let [leaves, enters] = [wedge.height(1, beyond) >= 0.0, wedge.height(0, before) >= 0.0];
    let below = |plane: usize, tip: &Vec3| {
        let height = wedge.height(plane, tip).min(0.0);
        height * height
    };
    let crossed = crossing.depth * crossing.depth;
    let of_face =
        if enters { 0.0 } else { below(0, before) } + if leaves { crossed } else { below(0, beyond) };
    let of_other =
        if leaves { 0.0 } else { below(1, beyond) } + if enters { crossed } else { below(1, before) };
    match (leaves && of_face <= of_other, enters && of_other <= of_face) {
        (true, true) => Some(wedge.farther_out(segment, end)),
        (true, false) => Some(end),
        (false, true) => Some(1 - end),
        (false, false) => None,
    }
}

/// Place at which a segment leaves the body through the edge between an active face and an internal face, or
/// at which its tip lies on an internal face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExitAtWall {
    /// True for a tip, false for an exit.
    pub is_tip: bool,
    /// Interval of the segment inside the piece, as parameters along the segment (no unit).
    pub inside: [f64; 2],
    /// Difference up to which parameters along the segment count as equal (no unit).
    pub slack: f64,
}

/// Returns the exit of a segment from a piece at `end` if it lies on the edge between an active face and an
/// internal face. If the segment ends inside, returns its tip if that lies on an internal face. Otherwise
/// `None`.
pub fn exit_at_wall(segment: &LineSegment, polyhedron: &Polyhedron, end: usize) -> Option<ExitAtWall> {
    let inside = inside_of(segment, polyhedron, 0.0).or_else(|| inside_of_wide_walls(segment, polyhedron))?;
    let is_tip = inside[end].leaves_by.is_none();
    if is_tip {
        polyhedron.walls_at(&segment.ends[end]).next()?;
    } else {
        leaves_at_wall(segment, polyhedron, &inside[end], end)?;
    }
    let length = (segment.ends[1] - segment.ends[0]).norm();
    Some(ExitAtWall {
        is_tip,
        inside: inside.map(|end| end.at),
        slack: polyhedron.planes().wall_slack / if length > 0.0 { length } else { 1.0 },
    })
}

/// Returns the interval of a segment inside a piece, as fractions of the segment's length; `None` if it is
/// empty.
pub fn part_inside(segment: &LineSegment, polyhedron: &Polyhedron) -> Option<[f64; 2]> {
    inside_of(segment, polyhedron, 0.0).map(|ends| ends.map(|end| end.at))
}

/// Returns the exit through the active face, if the segment leaves through the edge between an active face
/// and an internal face; otherwise `None`. By rounding `inside.leaves_by` may be either of the two faces.
pub(super) fn leaves_at_wall(
    segment: &LineSegment,
    polyhedron: &Polyhedron,
    inside: &InsideEnd,
    end: usize,
) -> Option<InsideEnd> {
    let leaves_by = inside.leaves_by?;
    let (from, to) = (&segment.ends[1 - end], &segment.ends[end]);
    let place = segment.ends[0] + (segment.ends[1] - segment.ends[0]) * inside.at;
    if polyhedron.faces[leaves_by].active {
        return polyhedron.walls_at(&place).next().is_some().then_some(*inside);
    }
    // `leaves_by` is the internal face. The segment leaves at the edge only if it also leaves through an
    // active face, and that exit is not farther beyond `place` than the tolerance, measured along the
    // segment.
    let (length, slack) = ((to - from).norm(), polyhedron.planes().wall_slack);
    let exit = |other: usize| {
        let [before, beyond] = [from, to].map(|tip| polyhedron.height(other, tip));
        let is_there = beyond >= 0.0
            && before < 0.0
            && -polyhedron.height(other, &place) * length <= slack * (beyond - before);
        is_there.then(|| {
            let share = before / divisor(before - beyond);
            InsideEnd { at: if end == 1 { share } else { 1.0 - share }, leaves_by: Some(other) }
        })
    };
    let nearer = |a: &InsideEnd, b: &InsideEnd| if end == 1 { a.at <= b.at } else { a.at >= b.at };
    // All internal faces at the exit are searched, because `leaves_by` may be any of several coplanar ones.
    let rims = polyhedron.walls_at(&place).flat_map(|wall| polyhedron.rims_of(wall));
    let beside = rims.map(|rim| rim.neighbor as usize).filter(|&other| polyhedron.faces[other].active);
    beside.filter_map(exit).reduce(|a, b| if nearer(&a, &b) { a } else { b })
}
