//! One frame: the stages in order.

mod block;
mod broad_phase;
mod buffers;
mod energy;
mod forces;
mod input;
pub(crate) mod load_sharing;
mod narrow_phase;
mod output;
mod tunnelling;
mod worker_context;
mod worker_pool;

pub(crate) use block::arena_bytes;
pub(crate) use broad_phase::blocks::ROUND;
pub(crate) use buffers::{Frame, FrameContact, Place};
pub(crate) use energy::accounts::{Interval, contact_numbers};
pub(crate) use input::motion::Motion;
pub(crate) use input::states::require_states;
pub(crate) use input::{Block, FrameInput};
pub use output::preload::FrictionPreload;
pub(crate) use tunnelling::{Passed, least_travel_m, reach_m};
pub(crate) use worker_pool::Crew;

use crate::report::{Clock, Stage, Work, WorkTimes};
use crate::scene::{Scene, States};
use crate::seal::Sealed;
use crate::state::ContactMemory;
use broad_phase::blocks;
use input::{motion, states};
use output::{order, reduce};
use std::sync::Arc;
use worker_context::Lane;

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
    states::latch(sealed, states, frame);
    motion::relate(given, frame);
    watch.lap(Stage::Relative, &mut frame.times);
    find_contacts(given, crew, frame);
    watch.lap(Stage::Contacts, &mut frame.times);
    order::put_in_order(scene, sealed, frame);
    tunnelling::watch(given, frame);
    watch.lap(Stage::Order, &mut frame.times);
    energy::balance(scene, sealed, memory, frame);
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
    blocks::lay_out(scene, sealed, &states.enabled, input, counts, &mut |input, cost_ns| {
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
