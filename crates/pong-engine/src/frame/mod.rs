//! One frame: the stages in order.

mod accounts;
mod block;
mod bounding;
mod buffers;
mod carried;
mod chunk;
mod crew;
mod forces;
mod input;
mod lane;
mod ledger;
mod listing;
mod nearest_side;
mod order;
mod passages;
mod pieces;
mod preload;
mod reach;
mod reduce;
mod relative;
mod sharing;
mod side_of_entry;
mod state_in;
mod testers;

pub(crate) use accounts::{Interval, contact_numbers};
pub(crate) use block::arena_bytes;
pub(crate) use bounding::ROUND;
pub(crate) use buffers::{Frame, FrameContact, Place};
pub(crate) use crew::Crew;
pub(crate) use input::{Block, FrameInput};
pub(crate) use passages::{Passed, least_travel_m, reach_m};
pub use preload::FrictionPreload;
pub(crate) use relative::Motion;
pub(crate) use state_in::require_states;

use crate::report::{Clock, Stage, Work, WorkTimes};
use crate::scene::{Scene, States};
use crate::sealed::Sealed;
use crate::state::ContactMemory;
use lane::Lane;
use std::sync::Arc;

/// What a frame is computed from.
pub(crate) struct Given<'a> {
    pub scene: &'a Scene,
    pub sealed: &'a Sealed,
    pub states: &'a States,
    pub memory: &'a Arc<ContactMemory>,
    pub clock: Clock,
}

/// Computes everything that the present states and the committed contact state say. Writes `frame` alone.
pub(crate) fn evaluate(given: &Given<'_>, crew: Option<&mut Crew>, frame: &mut Frame) {
    let Given { scene, sealed, states, memory, clock } = *given;
    frame.begin(sealed);
    let mut watch = clock.start();
    state_in::latch(sealed, states, frame);
    relative::relate(given, frame);
    watch.lap(Stage::Relative, &mut frame.times);
    find_contacts(given, crew, frame);
    watch.lap(Stage::Contacts, &mut frame.times);
    order::put_in_order(scene, sealed, frame);
    passages::watch(given, frame);
    watch.lap(Stage::Order, &mut frame.times);
    ledger::balance(scene, sealed, memory, frame);
    watch.lap(Stage::Ledger, &mut frame.times);
    reduce::sum(sealed, frame);
    watch.lap(Stage::Reduce, &mut frame.times);
}

/// Bounding, testers, sharing and forces: block by block, by all hands or by the caller alone.
fn find_contacts(given: &Given<'_>, mut crew: Option<&mut Crew>, frame: &mut Frame) {
    let Given { scene, sealed, states, memory, clock } = *given;
    let Frame { input, lane, counts, times, .. } = frame;
    (input.memory, input.clock) = (Arc::clone(memory), clock);
    if let Some(crew) = &mut crew {
        crew.begin_frame();
    }
    // What is between the rounds is the caller's.
    let (mut laps, mut layout) = (clock.start(), WorkTimes::default());
    bounding::lay_out(scene, sealed, &states.enabled, input, counts, &mut |input, cost_ns| {
        laps.lap_work(Work::Bounding, &mut layout);
        input.phase += 1;
        let shared = crew.as_mut().is_some_and(|crew| share_out(crew, input, cost_ns, lane));
        if !shared {
            for block in 0..input.blocks.len() {
                block::work_off(scene, sealed, input, block, lane);
            }
        }
        laps = clock.start();
    });
    laps.lap_work(Work::Bounding, &mut layout);
    lane.out.times.add(&layout);
    counts.add(&lane.out.counts);
    times.work = lane.out.times;
    if let Some(crew) = crew {
        crew.times().for_each(|lane| times.work.add(lane));
    }
}

/// Whether the crew has done this round. If it could not, the lane is as it was before.
fn share_out(crew: &mut Crew, input: &FrameInput, cost_ns: u64, lane: &mut Lane) -> bool {
    let before = lane.out.mark();
    let done = crew.work_off(input, cost_ns, lane);
    if !done {
        lane.out.return_to(&before);
    }
    done
}
