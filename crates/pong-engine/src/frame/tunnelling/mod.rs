//! Tunnelling: elements that pass through something between two commits. A frame knows only poses, not the
//! motion between them; a fast point may be in front of a wall in one frame and behind it in the next without
//! any force. The forces are not changed, but the status reports every passage.
//!
//! The *points* of an element of A are followed along straight paths since the last commit, in B's frame: a
//! point, the centre of a sphere or ellipsoid, the origin of a ray, the ends and the middle of a segment,
//! capsule or cylinder. Against a capsule, a cylinder or a cone, the whole axis is followed. An element has
//! tunnelled in one of two cases:
//!
//! * its path or axis enters a solid of B and leaves it again, or passes a sheet from the front, and no
//!   contact pushes the element back to the side that it came from;
//! * a contact that pushed the element to one side has ended, and the element is now on the other side or is
//!   pushed to it.
//!
//! Paths are followed only if the body may have moved farther than half the thickness of the thinnest element
//! of B ([`travel::least_travel_m`]). A shorter path may cut an edge or a corner, but passes through no wall.
//! In all other frames only ended contacts are checked.

mod ended;
pub(crate) mod events;
mod followed;
mod line;
mod sheets;
mod solids;
mod swept;
pub(crate) mod travel;

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::input::EvaluationInput;
use crate::frame::input::relative::Motions;
use crate::frame::near_pairs::MOTIONS_AT_ONCE;
use crate::report::StatusBits;
use events::TunnellingEvents;
use followed::Seen;

/// Detects tunnelling and sets the status.
#[inline]
pub(crate) fn watch(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
    frame.caller.scratch.reset();
    frame.tunnelling = follow(given, frame);
    let mut events = frame.tunnelling;
    ended::look_at_ended(given, frame, &mut events);
    frame.tunnelling = events;
    if frame.tunnelling.count > 0 {
        frame.report.status.set(StatusBits::TUNNELLED);
    }
}

/// Follows the paths of all near pairs whose groups may have moved far enough, and returns the events.
#[inline]
fn follow(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) -> TunnellingEvents {
    let mut events = TunnellingEvents::default();
    let rounds = frame.near.list().len().div_ceil(MOTIONS_AT_ONCE);
    for round in 0..rounds {
        let first = round * MOTIONS_AT_ONCE;
        let end = frame.near.list().len().min(first + MOTIONS_AT_ONCE);
        if rounds > 1 {
            let EvaluationBuffers { near, input, poses, twists, number, .. } = &mut *frame;
            let motions = Motions { sealed: given.sealed, poses, twists, committed: &given.memory.poses };
            motions.relate(&near.list()[first..end], *number, &mut input.motions);
        }
        for (slot, &group_pair) in frame.near.list()[first..end].iter().enumerate() {
            for (plan, direction) in given.sealed.plans_of(group_pair) {
                let motion = frame.input.motions[slot].of(direction);
                if travel::may_go_through(plan, motion) {
                    Seen::new(given, direction, motion, frame).follow_lines(plan, &mut events);
                }
            }
        }
    }
    events
}
