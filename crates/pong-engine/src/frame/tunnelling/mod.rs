//! What went right through something between two commits. A frame knows poses, not what was between them: a fast point
//! may be in front of a wall in one frame and behind it in the next, and no force ever told it. The forces stay what they
//! are; the status says it, so that no passage goes unnoticed.
//!
//! An element of A is followed at its *places*: a point, the centre of a ball, the origin of a ray, the ends and the
//! middle of a segment, each along its straight line since the last commit, seen from B. It went through where
//!
//! * the line goes into a solid of B and out again, or from the front through a sheet, and no contact pushes the element
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
pub(crate) mod travel;

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::input::EvaluationInput;
use crate::report::StatusBits;
use events::TunnellingEvents;
use followed::Seen;

/// Tells the status of what went through.
pub(crate) fn watch(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
    frame.caller.scratch.reset();
    frame.tunnelling = find(given, frame);
    if frame.tunnelling.count > 0 {
        frame.report.status.set(StatusBits::TUNNELLED);
    }
}

fn find(given: &EvaluationInput<'_>, frame: &EvaluationBuffers) -> TunnellingEvents {
    let mut events = TunnellingEvents::default();
    for plan in &given.sealed.plans {
        let motion = &frame.input.motions[plan.group_pair as usize][plan.flipped as usize];
        let enabled = given.states.enabled[given.sealed.group_pairs[plan.group_pair as usize].pair];
        if enabled && travel::may_go_through(plan, motion) {
            Seen::new(given, plan, frame).follow_lines(plan, &mut events);
        }
    }
    ended::look_at_ended(given, frame, &mut events);
    events
}
