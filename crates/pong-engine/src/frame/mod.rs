//! One frame: the stages in order.

mod block;
mod broad_phase;
mod buffers;
mod energy;
mod forces;
mod input;
pub(crate) mod load_sharing;
pub(crate) mod narrow_phase;
mod near_pairs;
mod output;
mod run_blocks;
mod single_element_blocks;
mod tunnelling;
mod worker_context;
mod worker_pool;

pub(crate) use broad_phase::blocks::{PendingParts, ROUND};
pub(crate) use buffers::EvaluationBuffers;
pub(crate) use energy::interval::Interval;
pub(crate) use forces::contact::FrameContact;
pub(crate) use forces::contact_ref::ContactRef;
pub(crate) use forces::wrench_term::WrenchTerm;
pub(crate) use input::motion::PairMotions;
pub(crate) use input::states::require_states;
pub(crate) use input::{Block, EvaluationInput, WorkerInput};
pub(crate) use near_pairs::{MOTIONS_AT_ONCE, NearPairs};
pub use output::preload::FrictionPreload;
pub(crate) use output::remember::{fresh, remember};
pub(crate) use run_blocks::arena_bytes;
pub(crate) use tunnelling::events::{TunnellingEvent, TunnellingEvents};
pub(crate) use tunnelling::travel::{least_travel_m, reach_m};
pub(crate) use worker_context::WorkerContext;
pub(crate) use worker_pool::WorkerPool;

use crate::report::{Stage, Work, WorkTimes};
use broad_phase::blocks::Layout;
use forces::found::WorkerBuffers;
use input::relative::Motions;
use input::states;
use output::{order, reduce};
use run_blocks::run_blocks;

/// Computes a frame from the current states and the committed contact state. Writes only `frame`.
#[inline]
pub(crate) fn evaluate(
    given: &EvaluationInput<'_>,
    pool: Option<&mut WorkerPool>,
    frame: &mut EvaluationBuffers,
) {
    let EvaluationInput { sealed, states, memory, clock, .. } = *given;
    frame.begin(sealed);
    let mut watch = clock.start();
    states::latch(sealed, states, &mut frame.poses, &mut frame.twists);
    frame.near.find(sealed, &states.enabled, &frame.poses, &memory.poses);
    watch.lap(Stage::Input, &mut frame.times);
    find_contacts(given, pool, frame);
    watch.lap(Stage::Contacts, &mut frame.times);
    order::put_in_order(given, frame);
    tunnelling::watch(given, frame);
    watch.lap(Stage::Order, &mut frame.times);
    energy::balance(given, frame);
    watch.lap(Stage::Energy, &mut frame.times);
    reduce::sum(given, frame);
    watch.lap(Stage::Output, &mut frame.times);
}

/// Finds all contacts: broad phase, narrow phase, load sharing and forces, block by block, on the workers or
/// on the caller.
#[inline]
fn find_contacts(
    given: &EvaluationInput<'_>,
    mut pool: Option<&mut WorkerPool>,
    frame: &mut EvaluationBuffers,
) {
    let EvaluationInput { scene, sealed, memory, clock, .. } = *given;
    let EvaluationBuffers { input, caller, workers, times, near, poses, twists, number, pending, .. } = frame;
    let motions = Motions { sealed, poses, twists, committed: &memory.poses };
    input.clock = clock;
    if let Some(pool) = &mut pool {
        pool.begin_frame();
    }
    // Time between the rounds is spent by the caller in the broad phase.
    let (mut laps, mut layout_times) = (clock.start(), WorkTimes::default());
    for pairs in near.list().chunks(MOTIONS_AT_ONCE) {
        motions.relate(pairs, *number, &mut input.motions);
        let mut layout = Layout::new(scene, sealed, pairs, pending);
        while let Some(cost_ns) = layout.next_round(&input.motions, &mut input.blocks, &mut caller.out.counts)
        {
            laps.lap_work(Work::BroadPhase, &mut layout_times);
            input.phase += 1;
            run_round(given, pool.as_deref_mut(), (input, cost_ns), caller, workers);
            laps = clock.start();
        }
    }
    laps.lap_work(Work::BroadPhase, &mut layout_times);
    caller.out.flush();
    caller.out.times.add(&layout_times);
    for worker in workers.iter().filter(|worker| worker.holds_a_phase()) {
        caller.out.demand.add(&worker.demand);
    }
    times.work = caller.out.times;
    if let Some(pool) = pool.filter(|pool| pool.has_worked()) {
        pool.times().for_each(|worker| times.work.add(worker));
    }
}

/// Runs a round on the workers or, if that does not pay or fails, on the caller; `cost_ns` is its estimated
/// cost.
fn run_round(
    given: &EvaluationInput<'_>,
    pool: Option<&mut WorkerPool>,
    (input, cost_ns): (&WorkerInput, u64),
    caller: &mut WorkerContext,
    workers: &mut WorkerBuffers,
) {
    // A frame may have several rounds: move the workers' contacts of the last round into the caller's buffer
    // first.
    for worker in workers.iter().filter(|worker| worker.holds_a_phase()) {
        assert!(caller.out.merge(worker), "the caller's buffer has room for the contacts of the workers");
    }
    workers.empty();
    let shared = pool.is_some_and(|pool| run_parallel(given, pool, (input, cost_ns), caller, workers));
    if !shared {
        run_blocks(&given.round(input), 0..input.blocks.len(), caller);
    }
}

/// Runs a round on the workers; `cost_ns` is its estimated cost. Returns false, with the buffers unchanged,
/// if the caller has to run the round.
fn run_parallel(
    given: &EvaluationInput<'_>,
    pool: &mut WorkerPool,
    (input, cost_ns): (&WorkerInput, u64),
    caller: &mut WorkerContext,
    workers: &mut WorkerBuffers,
) -> bool {
    let asked = pool.worth_asking(given.memory.records.len(), input.blocks.len(), cost_ns);
    if asked == 0 {
        return false;
    }
    let before = caller.out.checkpoint();
    let done = pool.run_parallel(given.memory, (input, asked), caller, workers.put_to_use());
    if !done {
        caller.out.restore(&before);
    }
    done
}
