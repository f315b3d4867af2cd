//! Runs blocks of one element each, such as the wheels of a rover, several at a time.
//!
//! Each step of an element needs the result of the step before: down a tree, from a triangle to its vertices,
//! through the test whether the two may touch. So the steps of several elements alternate, and while one
//! waits for memory, the others proceed. Their pairs together also fill the SIMD lanes.

use crate::frame::block::{GRAIN, finish_chunk, plan_of};
use crate::frame::broad_phase::blocks::batches_of_b;
use crate::frame::broad_phase::chunk::{Chunk, ChunkSpace, ChunksOfA};
use crate::frame::broad_phase::element_search::SEARCHES_MAX;
use crate::frame::input::{Block, PairContext, Round};
use crate::frame::narrow_phase::element_pair::ChunkCandidates;
use crate::frame::narrow_phase::single_element::{ElementAndBatch, narrow_down, test_element};
use crate::frame::worker_context::WorkerContext;
use crate::report::{FrameCounts, Laps, Work};
use pong_arena::{Arena, List};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::simd::{Kernel, Simd};
use pong_model::Batch;

/// Kernel that runs the first of some single-element blocks, together with as many of the next ones as
/// [`Elements::transform`] accepts. Returns the number of blocks done.
pub(crate) struct SingleElementBlocks<'a, L> {
    pub round: &'a Round<'a>,
    pub blocks: &'a [Block],
    pub worker: &'a mut WorkerContext,
    pub laps: L,
}

/// Element of A in B's frame.
struct TransformedElement<'a> {
    context: PairContext<'a>,
    chunk: Chunk<'a>,
}

/// Batch of B that an element of A may touch.
#[derive(Clone, Copy)]
struct Reached<'a> {
    /// Index of the element in the list of elements.
    element: usize,
    batch: &'a Batch,
    /// True for the last batch of the element.
    is_last: bool,
}

/// Elements of A, and the batches of B that they may touch, element by element.
struct Elements<'a, 's> {
    list: [Option<TransformedElement<'a>>; SEARCHES_MAX],
    count: usize,
    reached: List<'s, Reached<'a>>,
}

/// Arena bytes that the blocks of one run need against trees with this many nodes and batches.
pub(crate) fn arena_bytes(nodes: usize, batches: usize) -> usize {
    let stacks = SEARCHES_MAX * (nodes * size_of::<u32>() + GRAIN);
    SEARCHES_MAX.max(batches) * size_of::<Reached<'_>>() + GRAIN + stacks
}

impl<L: Laps> Kernel for SingleElementBlocks<'_, L> {
    type Output = usize;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> usize {
        let Self { round, blocks, worker, mut laps } = self;
        let WorkerContext { arena, scratch, searches, spaces, deferred, found, shared, out, .. } = worker;
        let searches = &mut **searches;
        let all = Elements::transform(simd, (round, blocks), arena, spaces, &mut out.counts);
        let mut found = ChunkCandidates::new(found, deferred);
        for reached in all.reached.chunks(SEARCHES_MAX) {
            let mut pairs = [None; SEARCHES_MAX];
            for ((pair, search), reached) in pairs.iter_mut().zip(&mut *searches).zip(reached) {
                *pair = all.pair(reached);
                if let Some(ElementAndBatch { chunk, batch, .. }) = pair {
                    search.begin(chunk, &batch.boxes);
                }
            }
            let pairs = &pairs[..reached.len()];
            // One step of each search in turn, until each has ended or has no room for more results.
            let mut goes_on = true;
            while goes_on {
                goes_on = false;
                for (search, pair) in searches.iter_mut().zip(pairs) {
                    goes_on |= pair.is_some_and(|pair| search.step(simd, &pair.batch.boxes));
                }
            }
            laps.lap(Work::BroadPhase, &mut out.times);
            narrow_down(simd, pairs, searches, found.deferred, &mut out.counts);
            laps.lap(Work::NarrowPhase, &mut out.times);
            for ((pair, search), reached) in pairs.iter().zip(&mut *searches).zip(reached) {
                let Some(pair) = *pair else { continue };
                test_element(simd, pair, search, &mut found, out, &mut laps);
                if reached.is_last {
                    let (memory, chunk) = ((&mut *scratch, &mut *shared, &mut *out), pair.chunk);
                    finish_chunk((pair.context, round.sealed), chunk, &mut found, memory, &mut laps);
                }
            }
        }
        all.count
    }
}

impl<'a, 's> Elements<'a, 's> {
    /// Transforms the elements of the first block and of the following blocks into B's frame, and finds the
    /// batches of B that each of them may touch. Stops at [`SEARCHES_MAX`] elements, or before a block whose
    /// tree of B has more batches than the list of batches has room for.
    #[inline(always)]
    fn transform<'l: 'a, S: Simd>(
        simd: S,
        (round, blocks): (&Round<'l>, &[Block]),
        arena: &'s Arena,
        spaces: &'l mut [ChunkSpace; SEARCHES_MAX],
        counts: &mut FrameCounts,
    ) -> Self {
        let (_, first_b) = round.sealed.bodies_of(blocks[0].direction);
        let capacity = SEARCHES_MAX.max(round.scene.body(first_b).tree.batches.len());
        let room = "sealing has sized the arena";
        let mut reached = arena.list(capacity).expect(room);
        let (mut list, mut count) = ([const { None }; SEARCHES_MAX], 0);
        for (block, space) in blocks.iter().zip(spaces) {
            let (plan, motion) = plan_of(round, block);
            let context = PairContext::new(round, block.direction, motion);
            if reached.len() + context.body_b.tree.batches.len() > capacity {
                break;
            }
            let (mut meets_triangles, mut boxes_tested) = (false, 0);
            batches_of_b((&context, plan), block, arena, counts, |batch| {
                meets_triangles |= batch.kind == PrimitiveKind::Triangle;
                boxes_tested += 1;
                if !batch.boxes.nodes.is_empty() {
                    reached.push(Reached { element: count, batch, is_last: false }).expect(room);
                }
            });
            counts.boxes_tested += boxes_tested;
            if let Some(last) = reached.last_mut() {
                last.is_last = true;
            }
            let batch_a = &context.body_a.tree.batches[block.batch as usize];
            let chunks_of_a = ChunksOfA::new(context.body_a, batch_a, &motion.x_ba, meets_triangles);
            let chunk = chunks_of_a.carry(simd, 0, space);
            list[count] = Some(TransformedElement { context, chunk });
            count += 1;
        }
        Self { list, count, reached }
    }

    #[inline(always)]
    fn pair(&self, reached: &Reached<'a>) -> Option<ElementAndBatch<'_>> {
        let TransformedElement { context, chunk } = self.list[reached.element].as_ref()?;
        Some(ElementAndBatch { context, chunk, batch: reached.batch })
    }
}
