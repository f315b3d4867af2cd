//! Tunnelling: elements that pass through something between two commits. A frame knows only poses, not the
//! motion between them, so a fast point may be in front of a wall in one frame and behind it in the next
//! without any force. The forces are not changed, but the status reports every passage.
//!
//! The *points* of an element of A are followed along straight paths since the last commit, in B's frame: a
//! point, the centre of a sphere or ellipsoid, the origin of a ray, the ends and the middle of a segment,
//! capsule or cylinder. Against a capsule, a cylinder or a cone, the whole axis is followed. An element has
//! tunnelled in one of two cases:
//!
//! * Its path or axis enters a solid of B and leaves it again, or passes a sheet from the front, and no
//!   contact pushes the element back to the side that it came from.
//! * A contact that pushed the element to one side has ended, and the element is now on the other side or is
//!   pushed to it.
//!
//! Two solids have tunnelled if their convex parts have changed sides and overlapped in between ([`bodies`]).
//!
//! Paths are followed only if A may have moved farther than half the thickness of the thinnest element of B
//! ([`travel::least_travel_m`]). A shorter path may cut an edge or a corner, but passes through no wall. In
//! all other frames only ended contacts are checked.

mod bodies;
mod ended;
pub(crate) mod followed;
mod golden_section;
mod solids;
mod swept;
pub(crate) mod travel;

use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, WorkerInput};
use crate::frame::near_pairs::MOTIONS_AT_ONCE;
use crate::frame::output::order::OrderedContacts;
use followed::{Seen, TunnellingEvents};
use pong_arena::Arena;

/// Detects tunnelling since the last commit. If the frame visits more pairs than `input` holds motions of, the
/// motions of every pair are computed again and written to `input`.
#[inline]
pub(crate) fn watch(
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    input: &mut WorkerInput,
    contacts: OrderedContacts<'_>,
    scratch: &mut Arena,
) -> TunnellingEvents {
    let mut events = TunnellingEvents::default();
    let several = motions.near.list().len() > MOTIONS_AT_ONCE;
    for pairs in motions.near.list().chunks(MOTIONS_AT_ONCE) {
        if several {
            motions.relate(pairs, &mut input.motions);
        }
        follow(given, pairs, input, contacts, &mut events);
    }
    scratch.reset();
    ended::look_at_ended(given, motions, input, contacts, scratch, &mut events);
    events
}

/// Follows the paths of the given pairs, whose motions `input` holds, if their groups may have moved far
/// enough.
#[inline]
fn follow(
    given: &EvaluationInput<'_>,
    pairs: &[u32],
    input: &WorkerInput,
    contacts: OrderedContacts<'_>,
    events: &mut TunnellingEvents,
) {
    for (motions, &group_pair) in input.motions.iter().zip(pairs) {
        for (plan, direction) in given.sealed.plans_of(group_pair) {
            let motion = motions.of(direction);
            let lines = travel::may_go_through(plan, motion);
            let solids = travel::solids_may_go_through(plan, motion);
            if !lines && !solids {
                continue;
            }
            let seen = Seen::new(given.round(input), direction, motion, contacts);
            if lines {
                seen.follow_lines(plan, events);
            }
            if solids {
                seen.follow_solids(plan, events);
            }
        }
    }
}
