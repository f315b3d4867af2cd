//! Blocks of one element each, such as the wheels of a rover: several at a time.
//!
//! The steps of one element depend on each other (down a tree, from a triangle to its vertices, through the
//! test whether the two may touch). Interleaving several elements hides these latencies, and their pairs
//! together fill the SIMD lanes.

use crate::frame::block::{finish_chunk, plan_of};
use crate::frame::broad_phase::blocks::batches_of_b;
use crate::frame::broad_phase::chunk::{Chunk, ChunkSpace, ChunksOfA};
use crate::frame::broad_phase::lone_element::{LONE_MAX, LoneElement};
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::input::{Block, PairContext, Round};
use crate::frame::narrow_phase::element_pair::ChunkCandidates;
use crate::frame::narrow_phase::lone_pairs::{LonePair, narrow_down, test_lone};
use crate::frame::worker_context::WorkerContext;
use crate::report::{Laps, Work};
use pong_arena::Arena;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::simd::{Kernel, LaneBits, Simd};
use pong_model::Batch;
use pong_model::box_tree::lanes;

/// Kernel that runs as many single-element blocks together as fit. Returns the number of blocks done: 0 if
/// the first needs more than `LONE_MAX` traversals.
pub(crate) struct LoneBlocks<'a, L> {
    pub round: &'a Round<'a>,
    pub blocks: &'a [Block],
    pub worker: &'a mut WorkerContext,
    pub laps: L,
}

/// An element of A in B's frame.
struct TransformedElement<'a> {
    context: PairContext<'a>,
    chunk: Chunk<'a>,
}

/// Elements, and per traversal its element's index and its batch of B. Traversals of one element are
/// consecutive.
struct Ways<'a> {
    elements: [Option<TransformedElement<'a>>; LONE_MAX],
    ways: [Option<(usize, &'a Batch)>; LONE_MAX],
    /// Number of elements and number of traversals.
    counts: (usize, usize),
}

impl<L: Laps> Kernel for LoneBlocks<'_, L> {
    type Output = usize;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> usize {
        let Self { round, blocks, worker, mut laps } = self;
        let WorkerContext { arena, scratch, lone, lone_carried, deferred, found, shared, out, .. } = worker;
        let lone = &mut **lone;
        let mut all = Ways { elements: [const { None }; LONE_MAX], ways: [None; LONE_MAX], counts: (0, 0) };
        all.carry(simd, (round, blocks), arena, lone_carried, out);
        let Ways { elements, ways, counts: (done, used) } = &all;
        let mut pairs: [Option<LonePair<'_>>; LONE_MAX] = [None; LONE_MAX];
        for (way, of) in ways[..*used].iter().enumerate() {
            if let Some((element, batch)) = *of
                && let Some(TransformedElement { context, chunk }) = &elements[element]
            {
                lone[way].begin(chunk, &batch.boxes);
                pairs[way] = Some(LonePair { context, chunk, batch });
            }
        }
        let pairs = &pairs[..*used];
        go_on_together(simd, lone, pairs);
        laps.lap(Work::BroadPhase, &mut out.times);
        let mut found = ChunkCandidates::new(found, deferred);
        narrow_down(simd, pairs, lone, found.deferred, &mut out.counts);
        laps.lap(Work::NarrowPhase, &mut out.times);
        let mut next = 0;
        for (number, element) in elements[..*done].iter().enumerate() {
            let Some(TransformedElement { context, chunk }) = element else { continue };
            while next < *used && ways[next].is_some_and(|(of, _)| of == number) {
                if let Some(pair) = pairs[next] {
                    test_lone(simd, pair, &mut lone[next], &mut found, out, &mut laps);
                }
                next += 1;
            }
            finish_chunk((context, round.sealed), chunk, &mut found, (scratch, shared, out), &mut laps);
        }
        *done
    }
}

impl<'a> Ways<'a> {
    /// Transforms the elements of as many blocks as there are traversals for, and finds the batches of B that
    /// each may touch.
    #[inline(always)]
    fn carry<'l: 'a, S: Simd>(
        &mut self,
        simd: S,
        (round, blocks): (&Round<'l>, &[Block]),
        arena: &mut Arena,
        carried: &'l mut [ChunkSpace; LONE_MAX],
        out: &mut ContactBuffer,
    ) {
        let (mut done, mut used) = (0, 0);
        for (block, space) in blocks.iter().zip(carried) {
            let (plan, motion) = plan_of(round, block);
            let context = PairContext::new(round, block.direction, motion);
            let tree_b = &context.body_b.tree;
            if used + tree_b.batches.len() > LONE_MAX {
                break;
            }
            arena.reset();
            let (mut meets_triangles, mut boxes_tested) = (false, 0);
            batches_of_b((&context, plan), block, arena, &mut out.counts, |batch| {
                meets_triangles |= batch.kind == PrimitiveKind::Triangle;
                boxes_tested += 1;
                self.ways[used] = Some((done, batch));
                used += usize::from(!batch.boxes.nodes.is_empty());
            });
            out.counts.boxes_tested += boxes_tested;
            let batch_a = &context.body_a.tree.batches[block.batch as usize];
            let chunks_of_a = ChunksOfA::new(context.body_a, batch_a, &motion.x_ba, meets_triangles);
            let chunk = chunks_of_a.carry(simd, (0, true), space);
            self.elements[done] = Some(TransformedElement { context, chunk });
            done += 1;
        }
        self.counts = (done, used);
    }
}

/// Advances the tree traversals in turns until each has ended or has no room for more results.
#[inline(always)]
fn go_on_together<S: Simd>(simd: S, lone: &mut [LoneElement; LONE_MAX], pairs: &[Option<LonePair<'_>>]) {
    let mut going = LaneBits::MAX.checked_shr((LONE_MAX - pairs.len()) as u32).unwrap_or(0);
    while going != 0 {
        for way in lanes(going) {
            let goes = match &pairs[way] {
                Some(pair) => lone[way].step(simd, &pair.batch.boxes),
                None => false,
            };
            going &= !(LaneBits::from(!goes) << way);
        }
    }
}
