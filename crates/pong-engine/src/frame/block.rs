//! One block of work: bounding, testers, sharing and forces for some elements as A against one movable group as B.

use super::bounding::batches_of_b;
use super::chunk::Chunk;
use super::input::{Block, FrameInput, PairContext};
use super::lane::Lane;
use super::testers::{Findings, Target};
use super::{forces, sharing};
use crate::report::FrameCounts;
use crate::scene::Scene;
use crate::sealed::Sealed;
use pong_geometry::simd::{self, Kernel, LANES, Simd};
use pong_model::Batch;
use pong_model::box_tree::Child;

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
        let context = PairContext::new(scene, sealed, input, &sealed.plans[block.plan as usize]);
        let batch_a = &context.body_a.tree.batches[block.batch as usize];
        let Lane { arena, scratch, out } = lane;
        let room = "sealing has sized the arena";
        let tree_b = &context.body_b.tree;
        let mut batches_b = arena.list(tree_b.batches.len()).expect(room);
        let mut stack = arena.list(tree_b.nodes.len()).expect(room);
        batches_of_b(&context, &block, &mut batches_b, &mut stack, &mut out.counts);
        let mut carried = arena.list(LANES).expect(room);
        let mut found = Findings::new(arena.list(sealed.limits.found).expect(room));
        let custom = arena.slice(sealed.custom_stride, 0.0).expect(room);
        let mut sharers = arena.list(sealed.limits.found).expect(room);
        for first in (block.first..block.end).step_by(LANES) {
            let x_ba = &context.motion.x_ba;
            let chunk = Chunk::new(simd, (context.body_a, batch_a), first, x_ba, &mut carried);
            test_chunk(simd, &context, &chunk, &batches_b, &mut found, &mut out.counts);
            if !found.list.is_empty() {
                let shared = sharing::settle(&context, &mut found.list, &mut sharers, scratch);
                out.unshared |= shared.is_err();
                forces::press_found(&context, sealed, &found.list, custom, out);
                found.list.clear();
            }
        }
        out.overflowed |= found.refused > 0;
        out.pushing += found.refused;
    }
}

/// Tests a chunk of A against all batches of B in reach.
#[inline(always)]
fn test_chunk<S: Simd>(
    simd: S,
    context: &PairContext<'_>,
    chunk: &Chunk<'_, '_, '_>,
    batches_b: &[&Batch],
    found: &mut Findings<'_>,
    counts: &mut FrameCounts,
) {
    for batch in batches_b {
        let around = chunk.boxes.around(&batch.boxes);
        counts.boxes_tested += 1;
        if !around.meets(&batch.boxes.around) {
            continue;
        }
        let boxes_a = chunk.boxes.narrowed(&batch.boxes);
        let looked_at = batch.boxes.visit(&around, |node, met| {
            for lane_b in met {
                let near = boxes_a.met_by(&node.boxes.lane(lane_b));
                let Child::Element(place) = node.child(lane_b) else { continue };
                if !near.is_empty() {
                    let item_b = context.body_b.tree.items[(batch.items.start + place) as usize];
                    Target { context, item_b, kind_b: batch.kind }
                        .test_lanes(simd, chunk, near, found, counts);
                }
            }
        });
        counts.boxes_tested += u64::from(looked_at);
    }
}
