//! One frame: the stages in order.

mod block;
mod broad_phase;
mod buffers;
pub(crate) mod forces;
pub(crate) mod input;
pub(crate) mod load_sharing;
pub(crate) mod narrow_phase;
mod near_pairs;
mod output;
mod run_blocks;
mod single_element_blocks;
pub(crate) mod solids;
mod tunnelling;
pub(crate) mod worker_context;
mod worker_pool;

pub(crate) use broad_phase::blocks::{PendingParts, ROUND};
pub(crate) use buffers::EvaluationBuffers;
pub(crate) use forces::contact::FrameContact;
pub(crate) use forces::contact_buffer::DeepInMeshes;
pub(crate) use forces::contact_ref::{ContactRef, Slot};
pub(crate) use input::motion::PairMotions;
pub(crate) use input::{Block, EvaluationInput, WorkerInput, require_states};
pub(crate) use near_pairs::{MOTIONS_AT_ONCE, NearPairs};
pub(crate) use output::FrameResults;
pub(crate) use output::commit::{new_records, write_records};
pub use output::preload::FrictionPreload;
pub(crate) use run_blocks::arena_bytes;
pub(crate) use tunnelling::followed::{TunnellingEvent, TunnellingEvents};
pub(crate) use tunnelling::travel::{PrimitivesOf, least_travel_m, reach_m, travel_of_solids_m};
pub(crate) use worker_context::WorkerContext;
pub(crate) use worker_pool::WorkerPool;

use crate::energy::balance::balance;
use crate::report::{Stage, StatusBits, Work, WorkTimes};
use broad_phase::blocks::Layout;
use forces::found::{FoundContacts, WorkerBuffers};
use input::latch_states;
use input::relative::Motions;
use output::order::OrderedContacts;
use output::{order, reduce};
use run_blocks::run_blocks;

/// Computes a frame from the current states and the committed contact state, and writes it to `frame`.
/// Returns the index of a movable group to name in an error, if a wrench, a contact or the ledger is out of
/// range or close to it ([`reduce::overflow`]).
#[inline]
pub(crate) fn evaluate(
    given: &EvaluationInput<'_>,
    pool: Option<&mut WorkerPool>,
    frame: &mut EvaluationBuffers,
) -> Option<usize> {
    let EvaluationInput { scene, sealed, states, memory, clock } = *given;
    frame.begin(sealed);
    let EvaluationBuffers { poses, twists, near, input, pending, caller, workers, .. } = frame;
    let EvaluationBuffers { order, tunnelling, energy, wrenches, report, times, .. } = frame;
    let mut watch = clock.start();

    latch_states(sealed, states, poses, twists);
    input.latch_surfaces(states, &memory.poses);
    near.find(sealed, &states.enabled, poses, &memory.poses);
    let motions = Motions { sealed, frame: frame.number, near, poses, twists, committed: &memory.poses };
    watch.lap(Stage::Input, times);

    times.work = find_contacts(given, &motions, pool, Search { input, pending, caller, workers });
    watch.lap(Stage::Contacts, times);

    order::list(FoundContacts { caller: &caller.out, workers }, order);
    if sealed.rays_meet_groups {
        order::keep_first_ray_hits(scene, sealed, caller, order);
    }
    if order::keep_deepest(sealed, &mut caller.out, order, report) {
        forces::recompute_forces(given, &motions, input, order, &mut caller.out);
    }
    let contacts = OrderedContacts::new(order, &caller.out, workers);
    *tunnelling = tunnelling::watch(given, &motions, input, contacts, &mut caller.scratch);
    if tunnelling.count > 0 {
        report.status.set(StatusBits::TUNNELLED);
    }
    if caller.out.demand.deep_in_meshes.facets > 0 {
        report.status.set(StatusBits::DEEP_IN_MESH);
    }
    watch.lap(Stage::Order, times);

    balance(given, &motions, input, order, caller, energy);
    watch.lap(Stage::Energy, times);

    let contacts = OrderedContacts::new(order, &caller.out, workers);
    let beyond_range = reduce::sum(&motions, input, contacts, wrenches);
    let overflow = reduce::overflow(sealed, wrenches, beyond_range, &energy.total);
    watch.lap(Stage::Output, times);
    overflow
}

/// Buffers of the search for contacts.
struct Search<'f> {
    /// Input of the workers; it receives the motions and the blocks of each round.
    input: &'f mut WorkerInput,
    /// Stack of the parts of A's trees that have not been laid out as blocks yet.
    pending: &'f mut PendingParts,
    /// Context of the calling thread.
    caller: &'f mut WorkerContext,
    /// Contacts of the workers in the last round.
    workers: &'f mut WorkerBuffers,
}

/// Finds all contacts: broad phase, narrow phase, load sharing and forces, block by block. The caller works
/// alone or together with workers. Returns the time of each kind of work, summed over all threads.
#[inline]
fn find_contacts(
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    mut pool: Option<&mut WorkerPool>,
    search: Search<'_>,
) -> WorkTimes {
    let EvaluationInput { scene, sealed, clock, .. } = *given;
    let Search { input, pending, caller, workers } = search;
    input.clock = clock;
    if let Some(pool) = &mut pool {
        pool.begin_frame();
    }
    // Between the rounds the caller lays out blocks; this time counts as broad phase.
    let (mut laps, mut layout_times) = (clock.start(), WorkTimes::default());
    for pairs in motions.near.list().chunks(MOTIONS_AT_ONCE) {
        motions.relate(pairs, &mut input.motions);
        let mut layout = Layout::new(scene, sealed, pairs, pending);
        while let Some(cost_ns) = layout.next_round(&input.motions, &mut input.blocks, &mut caller.out.counts)
        {
            laps.lap_work(Work::BroadPhase, &mut layout_times);
            input.phase += 1;
            if !run_on_workers(given, pool.as_deref_mut(), input, cost_ns, caller, workers) {
                run_blocks(&given.round(input), 0..input.blocks.len(), caller);
            }
            laps = clock.start();
        }
    }
    laps.lap_work(Work::BroadPhase, &mut layout_times);
    caller.out.flush();
    caller.out.times.add(&layout_times);
    for worker in workers.iter().filter(|worker| worker.holds_a_phase()) {
        caller.out.demand.add(&worker.demand);
    }
    let mut times = caller.out.times;
    if let Some(pool) = pool.filter(|pool| pool.has_worked()) {
        pool.times().for_each(|worker| times.add(worker));
    }
    times
}

/// Runs a round on the caller and the workers. Returns false if sharing the round would not pay, or has
/// failed; the caller then runs the whole round alone. `cost_ns` is the estimated cost of the round, ns.
fn run_on_workers(
    given: &EvaluationInput<'_>,
    pool: Option<&mut WorkerPool>,
    input: &WorkerInput,
    cost_ns: u64,
    caller: &mut WorkerContext,
    workers: &mut WorkerBuffers,
) -> bool {
    let Some(pool) = pool else { return false };
    // A frame may have several rounds, and each uses the workers' buffers. So the contacts that the workers
    // found in the last round are copied into the caller's buffer first.
    for worker in workers.iter().filter(|worker| worker.holds_a_phase()) {
        assert!(caller.out.merge(worker), "the caller's buffer has room for the contacts of the workers");
    }
    workers.empty();
    let asked = pool.worth_asking(given.memory.records.len(), input.blocks.len(), cost_ns);
    if asked == 0 {
        return false;
    }
    let before = caller.out.checkpoint();
    let is_complete = pool.run_parallel(given.memory, (input, asked), caller, workers.put_to_use());
    if !is_complete {
        caller.out.restore(&before);
    }
    is_complete
}
