//! What an end of a line segment at an inner wall of a piece carries (see
//! [`line_segment_polyhedron`](super::line_segment_polyhedron)). The piece behind the wall carries the end, with two
//! exceptions: a convex edge of the body in which the wall ends pushes, once for all pieces that have it, and a tip where
//! several walls meet may lie in none of the pieces there.

use super::Interference;
use super::segment_ends::{InsideEnd, Wedge};
use crate::Vec3;
use crate::primitive::{LineSegment, Polyhedron};

/// The part of a segment inside a piece whose inner walls stand out by what is within rounding of them.
pub(super) fn inside_of_wide_walls(segment: &LineSegment, polyhedron: &Polyhedron) -> Option<[InsideEnd; 2]> {
    let mut ends = [0.0, 1.0].map(|at| InsideEnd { at, leaves_by: None });
    for (index, face) in polyhedron.faces.iter().enumerate() {
        let room = if face.active { 0.0 } else { polyhedron.planes().wall_slack };
        let [first, second] = segment.ends.map(|end| face.height(&end) - room);
        if first >= 0.0 && second >= 0.0 {
            return None;
        }
        let leaving = |end: &InsideEnd, is_nearer: fn(f64, f64) -> bool| {
            let at = first / (first - second);
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

/// Which end carries the crossing of a convex edge in which an inner wall ends, as the whole body has it: where the segment
/// leaves the body beyond that edge, and the face that it is measured for stores the less. `None` if neither does.
///
/// With both tips below both faces each piece carries its own; the edge between them would be a third.
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
