//! One block of work: bounding, testers, sharing and forces for some elements as A against one movable group as B.

use super::bounding::batches_of_b;
use super::buffers::Found;
use super::carried::Carried;
use super::chunk::{Chunk, LaneBoxes};
use super::input::{Block, FrameInput, PairContext};
use super::lane::Lane;
use super::testers::{Findings, Target, test_waiting};
use super::{forces, sharing};
use crate::report::FrameCounts;
use crate::scene::Scene;
use crate::sealed::Sealed;
use crate::sharing::Sharer;
use pong_arena::List;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::simd::{self, Kernel, LANES, LaneBits, Simd};
use pong_model::Batch;
use pong_model::box_tree::{Child, NarrowBoxes, lanes};

/// Bytes of a lane's arena that a block asks for: against trees of so many nodes and batches, with room for so many
/// interferences of one chunk, and laws of so many numbers per contact.
pub(crate) fn arena_bytes(nodes: usize, batches: usize, found: usize, custom_stride: usize) -> usize {
    /// The arena rounds every piece up to its grain.
    const PIECES: usize = 7;
    const GRAIN: usize = 16;
    batches * (size_of::<&Batch>() + size_of::<Reach<'_>>())
        + nodes * size_of::<u32>()
        + LANES * size_of::<Carried>()
        + found * (size_of::<Found>() + size_of::<Sharer>())
        + custom_stride * size_of::<f64>()
        + PIECES * GRAIN
}

/// Works off one block; what it finds goes to the lane.
pub(super) fn work_off(scene: &Scene, sealed: &Sealed, input: &FrameInput, block: usize, lane: &mut Lane) {
    lane.arena.reset();
    simd::run(BlockWork { scene, sealed, input, block: input.blocks[block], lane });
}

struct BlockWork<'a> {
    scene: &'a Scene,
    sealed: &'a Sealed,
    input: &'a FrameInput,
    block: Block,
    lane: &'a mut Lane,
}

impl Kernel for BlockWork<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { scene, sealed, input, block, lane } = self;
        let plan = &sealed.plans[block.plan as usize];
        let context = PairContext::new(scene, sealed, input, plan);
        let batch_a = &context.body_a.tree.batches[block.batch as usize];
        let Lane { arena, scratch, waiting, out } = lane;
        let room = "sealing has sized the arena";
        let tree_b = &context.body_b.tree;
        let mut batches_b = arena.list(tree_b.batches.len()).expect(room);
        let mut stack = arena.list(tree_b.nodes.len()).expect(room);
        batches_of_b((&context, plan), &block, &mut batches_b, &mut stack, &mut out.counts);
        let mut reach = arena.list(batches_b.len()).expect(room);
        let mut carried = arena.list(LANES).expect(room);
        let mut found = Findings::new(arena.list(sealed.limits.found).expect(room), waiting);
        let custom = arena.slice(sealed.custom_stride, 0.0).expect(room);
        let mut sharers = arena.list(sealed.limits.found).expect(room);
        for group in block.first / GROUP..block.end.div_ceil(GROUP) {
            let near =
                chunks_in_reach(simd, &context, &block, group, &batches_b, &mut reach, &mut out.counts);
            for lane in lanes(near) {
                let first = group * GROUP + (lane * LANES) as u32;
                let chunk = ChunkOfA { context: &context, batch: batch_a, first, lane };
                test_chunk(simd, &chunk, &reach, &mut carried, &mut found, &mut out.counts);
                if found.overflowed {
                    out.wants.overflowed = true;
                    out.wants.at_once = out.wants.at_once.max(found.seen);
                }
                if !found.list.is_empty() {
                    let shared = sharing::settle(&context, &mut found.list, &mut sharers, scratch);
                    out.wants.unshared |= shared.is_err();
                    forces::press_found(&context, sealed, &found.list, custom, out);
                    found.clear();
                }
            }
        }
    }
}

/// Elements whose boxes are carried together: eight chunks of eight.
const GROUP: u32 = (LANES * LANES) as u32;

/// A batch of B, and the boxes around eight chunks of A as its tree sees them.
#[derive(Clone, Copy)]
struct Reach<'a> {
    batch: &'a Batch,
    boxes: NarrowBoxes,
    /// The chunks that reach the batch at all.
    met: LaneBits,
}

/// Which chunks of a group reach any batch of B.
#[inline(always)]
fn chunks_in_reach<'a, S: Simd>(
    simd: S,
    context: &PairContext<'_>,
    block: &Block,
    group: u32,
    batches_b: &[&'a Batch],
    reach: &mut List<'_, Reach<'a>>,
    counts: &mut FrameCounts,
) -> LaneBits {
    let batch_a = &context.body_a.tree.batches[block.batch as usize];
    let first_chunk = block.first.saturating_sub(group * GROUP) / LANES as u32;
    let past_chunk = (block.end - group * GROUP).div_ceil(LANES as u32).min(LANES as u32);
    let in_block = (LaneBits::MAX << first_chunk) & (LaneBits::MAX >> (LANES as u32 - past_chunk));
    // An element by itself is asked when it is carried.
    let carried = if batch_a.items.len() == 1 { None } else { batch_a.chunks.get(group as usize) };
    let carried = carried.map(|boxes| LaneBoxes::of_chunks(simd, boxes, &context.motion.x_ba));
    let mut any = 0;
    reach.clear();
    for &batch in batches_b {
        let boxes =
            carried.as_ref().map_or(NarrowBoxes::EVERYTHING, |carried| carried.narrowed(&batch.boxes));
        let met = boxes.met_by(simd, &batch.boxes.around) & in_block;
        any |= met;
        reach.push(Reach { batch, boxes, met }).expect("as much room as for batches");
    }
    counts.boxes_tested += batches_b.len() as u64;
    any
}

/// Which chunk of A, before it is carried.
struct ChunkOfA<'a> {
    context: &'a PairContext<'a>,
    batch: &'a Batch,
    first: u32,
    /// Its lane in its group.
    lane: usize,
}

/// Tests a chunk of A against all batches of B in reach. It is carried into B's frame when the first box of an element
/// is met; an element by itself at once, because its own box in B's frame is much tighter than its turned one.
#[inline(always)]
fn test_chunk<S: Simd>(
    simd: S,
    of_a: &ChunkOfA<'_>,
    reach: &[Reach<'_>],
    carried: &mut List<'_, Carried>,
    found: &mut Findings<'_>,
    counts: &mut FrameCounts,
) {
    let context = of_a.context;
    let from = (context.body_a, of_a.batch);
    let x_ba = &context.motion.x_ba;
    let meets_triangles = reach.iter().any(|reach| reach.batch.kind == PrimitiveKind::Triangle);
    let mut carry = Some(carried);
    let mut chunk = None;
    let alone = of_a.first + 1 == of_a.batch.items.end - of_a.batch.items.start;
    if alone {
        chunk =
            carry.take().map(|carried| Chunk::new(simd, from, of_a.first, x_ba, meets_triangles, carried));
    }
    for Reach { batch, boxes, met } in reach {
        if met >> of_a.lane & 1 == 0 {
            continue;
        }
        let mut boxes_a = None;
        let (mut around, mut ball) = (boxes.lane(of_a.lane), None);
        if let (true, Some(chunk)) = (alone, &chunk) {
            (around, ball) = chunk.first_narrowed(&batch.boxes);
        }
        let looked_at = batch.boxes.visit(simd, &around, ball.as_ref(), |node, met| {
            let chunk = chunk.get_or_insert_with(|| {
                let carried = carry.take().expect("a chunk is carried once");
                Chunk::new(simd, from, of_a.first, x_ba, meets_triangles, carried)
            });
            for lane_b in lanes(met) {
                let near = if alone {
                    1
                } else {
                    let boxes_a = boxes_a.get_or_insert_with(|| chunk.boxes.narrowed(&batch.boxes));
                    chunk.reach(simd, boxes_a, &batch.boxes, &node.boxes.lane(lane_b))
                };
                let Child::Element(place) = node.child(lane_b) else { continue };
                if near != 0 {
                    let item_b = context.body_b.tree.items[(batch.items.start + place) as usize];
                    let target = Target { context, item_b, kind_b: batch.kind };
                    target.test_lanes(simd, chunk, near, found, counts);
                }
            }
        });
        if let Some(chunk) = &chunk
            && found.waits()
        {
            test_waiting(context, chunk, found, counts);
        }
        counts.boxes_tested += u64::from(looked_at);
    }
}
