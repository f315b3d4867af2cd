//! What went right through something between two commits. A frame knows poses, not what was between them: a fast point
//! may be in front of a wall in one frame and behind it in the next, and no force ever told it. The forces stay what they
//! are; the status says it, so that no passage goes unnoticed.
//!
//! An element of A is followed at its *places*: a point, the centre of a ball, the origin of a ray, the ends and the
//! middle of a segment, a capsule or a cylinder, each along its straight line since the last commit, seen from B. Past a capsule,
//! a cylinder or a cone its whole axis is followed, with both ends along their lines. It went through where
//!
//! * the line or the axis goes into a solid of B and out again, or from the front through a sheet, and no contact pushes the element
//!   back to the side it came from;
//! * a contact that pushed it to one side ended with the place on the other side, or now pushes it there.
//!
//! Lines are followed where the body may have moved farther than half of what is thinnest in B ([`travel::least_travel_m`]): a
//! shorter line may cut an edge or a corner, it goes through no wall. In all other frames only contacts that ended are
//! looked at.

mod curved;
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

/// Tells the status of what went through.
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

/// Follows the lines of all pairs that are near.
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
