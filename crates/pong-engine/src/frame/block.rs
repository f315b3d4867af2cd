//! One block of work: broad phase, narrow phase, load sharing and forces for some elements of A against one
//! movable group B.

use crate::frame::broad_phase::blocks::batches_of_b;
use crate::frame::broad_phase::chunk::{Chunk, ChunksOfA};
use crate::frame::broad_phase::group_search::{GroupSearch, Reach, SUPERCHUNK, chunks_in_reach};
use crate::frame::forces::ElementsOfA;
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::input::motion::Motion;
use crate::frame::input::{Block, PairContext, Round};
use crate::frame::load_sharing::solver::SharedContact;
use crate::frame::narrow_phase::element_pair::ChunkCandidates;
use crate::frame::narrow_phase::testers::{Target, test_deferred};
use crate::frame::worker_context::WorkerContext;
use crate::frame::{forces, load_sharing};
use crate::report::{Laps, Work};
use crate::seal::{Direction, Plan, Sealed};
use pong_arena::{Arena, Table};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::simd::{Kernel, LANES, LaneBits, Simd};
use pong_model::Batch;
use pong_model::box_tree::lanes;
use std::sync::atomic::{Ordering, compiler_fence};

/// The arena rounds each piece up to a multiple of this, bytes.
pub(crate) const GRAIN: usize = 16;

/// Arena bytes that a block needs against trees with this many nodes and batches.
pub(crate) fn arena_bytes(nodes: usize, batches: usize) -> usize {
    let pieces = batches * (size_of::<&Batch>() + size_of::<Reach<'_>>()) + nodes * size_of::<u32>();
    pieces + 3 * GRAIN
}

/// Tester plan and relative motion of a block.
#[inline(always)]
pub(crate) fn plan_of<'a>(round: &Round<'a>, block: &Block) -> (&'a Plan, &'a Motion) {
    let Round { sealed, input, .. } = *round;
    let Direction { group_pair, flipped } = block.direction;
    let plan = sealed.group_pairs[group_pair as usize].plans[flipped as usize];
    (&sealed.plans[plan as usize], input.motions[block.slot as usize].of(block.direction))
}

/// Computes load sharing and forces for the candidates of a chunk of A, then empties the list of candidates.
#[inline(always)]
pub(crate) fn finish_chunk(
    (context, sealed): (&PairContext<'_>, &Sealed),
    chunk: &Chunk<'_>,
    found: &mut ChunkCandidates<'_>,
    (scratch, shared, out): (&mut Arena, &mut Table<SharedContact>, &mut ContactBuffer),
    laps: &mut impl Laps,
) {
    if found.overflowed {
        out.demand.overflowed = true;
        out.demand.at_once = out.demand.at_once.max(found.seen);
    }
    if !found.list.is_empty() {
        let shared = load_sharing::assign_weights(context, chunk.kind, found.list, shared, scratch);
        out.demand.unshared |= shared.is_err();
        laps.lap(Work::LoadSharing, &mut out.times);
        forces::compute_forces(context, sealed, ElementsOfA::of(chunk), found.list, out);
        found.clear();
        laps.lap(Work::Forces, &mut out.times);
    }
}

/// Kernel that runs one block and writes its results to the worker's context.
pub(crate) struct BlockWork<'a, L> {
    pub round: &'a Round<'a>,
    pub block: Block,
    pub worker: &'a mut WorkerContext,
    pub laps: L,
}

impl<L: Laps> Kernel for BlockWork<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { round, block, worker, mut laps } = self;
        let (plan, motion) = plan_of(round, &block);
        let context = PairContext::new(round, block.direction, motion);
        let batch_a = &context.body_a.tree.batches[block.batch as usize];
        let WorkerContext { arena, scratch, group_search, carried, deferred, found, shared, out, .. } =
            worker;
        let room = "sealing has sized the arena";
        let tree_b = &context.body_b.tree;
        let mut batches_b = arena.list(tree_b.batches.len()).expect(room);
        batches_of_b((&context, plan), &block, arena, &mut out.counts, |batch| {
            batches_b.push(batch).expect(room);
        });
        let mut reach = arena.list(batches_b.len()).expect(room);
        let mut found = ChunkCandidates::new(found, deferred);
        let meets_triangles = batches_b.iter().any(|batch| batch.kind == PrimitiveKind::Triangle);
        let chunks_of_a = ChunksOfA::new(context.body_a, batch_a, &motion.x_ba, meets_triangles);
        for group in block.first / SUPERCHUNK..block.end.div_ceil(SUPERCHUNK) {
            chunks_in_reach(simd, &context, &block, group, &batches_b, &mut reach, &mut out.counts);
            let (mut first, mut width) = (0, LANES);
            while first < LANES {
                group_search.begin(LaneBits::MAX >> (LANES - width) << first);
                let is_whole = group_search.go_on(simd, &reach, &mut out.counts);
                laps.lap(Work::BroadPhase, &mut out.times);
                // If the candidate pairs do not fit in the list, the search is repeated for half as many
                // chunks. The pairs of a single chunk are tested part by part (`test_chunk`).
                if !is_whole && width > 1 {
                    width /= 2;
                    continue;
                }
                first += width;
                for lane in lanes(group_search.pairs.chunks) {
                    let start = group * SUPERCHUNK + (lane * LANES) as u32;
                    let chunk = chunks_of_a.carry(simd, start, carried);
                    let (at, search) = ((&context, &chunk, lane), (&mut *group_search, is_whole));
                    test_chunk(simd, at, &reach, search, &mut found, out, &mut laps);
                    let memory = (&mut *scratch, &mut *shared, &mut *out);
                    finish_chunk((&context, round.sealed), &chunk, &mut found, memory, &mut laps);
                }
            }
        }
        laps.lap(Work::BroadPhase, &mut out.times);
    }
}

/// Tests chunk number `lane` of its superchunk against the candidates that `search` holds. If these are not
/// all candidates of the chunk (`is_whole` is false), continues the search and tests the others too.
#[inline(always)]
fn test_chunk<S: Simd>(
    simd: S,
    (context, chunk, lane): (&PairContext<'_>, &Chunk<'_>, usize),
    reach: &[Reach<'_>],
    (search, mut is_whole): (&mut GroupSearch, bool),
    found: &mut ChunkCandidates<'_>,
    out: &mut ContactBuffer,
    laps: &mut impl Laps,
) {
    loop {
        for candidate in search.pairs.of(lane) {
            let batch = reach[candidate.reach as usize].batch;
            // Keeps the compiler from loading all boxes of the chunk before the loop: most chunks have one or
            // two candidates, so that most of these loads would be in vain.
            compiler_fence(Ordering::SeqCst);
            let near = chunk.reach(simd, &candidate.box_b);
            if near != 0 {
                let item_b = context.body_b.tree.items[(batch.items.start + candidate.place) as usize];
                let target = Target { context, item_b, kind_b: batch.kind };
                target.test_lanes(simd, chunk, near, found, &mut out.counts);
            }
        }
        if found.has_deferred() {
            test_deferred(context, *chunk, found, &mut out.counts);
        }
        laps.lap(Work::NarrowPhase, &mut out.times);
        if is_whole {
            break;
        }
        is_whole = search.go_on(simd, reach, &mut out.counts);
        laps.lap(Work::BroadPhase, &mut out.times);
    }
}
