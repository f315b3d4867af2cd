//! Trees of bounding volumes: splits the work into blocks, and finds the leaves of B that a leaf of A may
//! touch.

use crate::frame::broad_phase::candidate_pairs::SUPERCHUNK;
use crate::frame::input::{Block, PairContext, WorkerInput};
use crate::frame::worker_context::WorkerContext;
use crate::report::FrameCounts;
use crate::scene::Scene;
use crate::sealed::{Direction, Plan, Sealed};
use pong_arena::Arena;
use pong_geometry::bounding::{CarriedVolume, Volume};
use pong_geometry::simd::LANES;
use pong_model::box_tree::{BoxNode, BoxTree, Child, NarrowBox};
use pong_model::{Batch, MovableGroup, Node};
use std::ops::Range;

/// Blocks per round: a full round is run before further blocks are laid out.
pub(crate) const ROUND: usize = 4096;

/// Cost of the elements below a box node above which its children are tested one by one, ns.
const NODE_NS: u32 = 4000;

/// Cost above which a block is split, ns: long compared with claiming a block, short compared with a frame. A
/// thread runs the blocks of one claim as one, so small blocks cost little.
const BLOCK_NS: u32 = 1000;

/// Lays out the blocks of some pairs, whose motions are in the same order, and calls `work` with each full
/// round and with the last one. `work` receives the estimated cost of the round, ns. Overlap tests are
/// counted in the caller's counts.
pub(crate) fn lay_out(
    scene: &Scene,
    sealed: &Sealed,
    pairs: &[u32],
    (input, caller): (&mut WorkerInput, &mut WorkerContext),
    work: &mut dyn FnMut(&mut WorkerInput, &mut WorkerContext, u64),
) {
    let mut cost = 0;
    input.blocks.clear();
    for (slot, &group_pair) in pairs.iter().enumerate() {
        for (plan, direction) in sealed.plans_of(group_pair) {
            let (body_a, body_b) = sealed.bodies_of(direction);
            let bodies = (scene.body(body_a), scene.body(body_b));
            let slot = slot as u32;
            let mut layout = Layout {
                sealed,
                plan,
                bodies,
                direction,
                slot,
                leads: true,
                input,
                caller,
                cost: &mut cost,
                work,
            };
            layout.visit_leaves(0);
        }
    }
    work(input, caller, cost);
    input.blocks.clear();
}

/// Lays out the blocks of one direction of a pair of movable groups.
struct Layout<'a, 'w> {
    sealed: &'a Sealed,
    plan: &'a Plan,
    /// Movable groups A and B.
    bodies: (&'a MovableGroup, &'a MovableGroup),
    direction: Direction,
    slot: u32,
    /// True until the first block of the current batch has been laid out.
    leads: bool,
    input: &'a mut WorkerInput,
    caller: &'a mut WorkerContext,
    cost: &'a mut u64,
    work: &'a mut (dyn FnMut(&mut WorkerInput, &mut WorkerContext, u64) + 'w),
}

impl Layout<'_, '_> {
    /// Returns true if a volume of A overlaps the root volume of B's tree.
    fn reaches_b(&mut self, volume: &Volume) -> bool {
        let root = &self.bodies.1.tree.nodes[0].volume;
        let x_ba = &self.input.motions[self.slot as usize].of(self.direction).x_ba;
        let meets = self.sealed.volume_tests.overlap(volume, root, x_ba);
        self.caller.out.counts.note_volumes(volume, root, meets);
        meets
    }

    fn visit_leaves(&mut self, node: u32) {
        let tree = &self.bodies.0.tree;
        if let Some(filter) = &self.plan.filter
            && filter.keeps_from_all(node)
        {
            return;
        }
        let Node { volume, children, batches, .. } = &tree.nodes[node as usize];
        if !self.reaches_b(volume) {
            return;
        }
        for child in children.clone() {
            self.visit_leaves(child);
        }
        for batch in batches.clone() {
            let Some(element_ns) = self.plan.element_ns(tree.batches[batch as usize].kind) else { continue };
            let Batch { boxes, items, .. } = &tree.batches[batch as usize];
            let (direction, slot, is_lone) = (self.direction, self.slot, items.len() == 1);
            let block = Block { direction, slot, leaf: node, batch, first: 0, end: 0, leads: false, is_lone };
            self.leads = true;
            // A single element needs no split. (The split costs a measurable part of a one-element pair.)
            if is_lone {
                self.add(Block { end: 1, ..block }, element_ns);
            } else {
                self.cut(boxes, 0, element_ns, block);
            }
        }
    }

    /// Splits the elements below a box node into blocks, skipping children of a large node that do not reach
    /// B.
    fn cut(&mut self, boxes: &BoxTree, node: u32, element_ns: u32, block: Block) {
        let node: &BoxNode = &boxes.nodes[node as usize];
        let elements = node.elements.clone();
        if node.is_bottom() {
            return self.slice(elements, element_ns, block);
        }
        let at_most = (NODE_NS / element_ns).next_multiple_of(LANES as u32);
        if elements.end - elements.start <= at_most {
            return self.slice(elements, element_ns, block);
        }
        for (lane, child) in node.children().enumerate() {
            let Child::Node(child) = child else { continue };
            let below = &boxes.nodes[child as usize].elements;
            let small = below.end - below.start <= at_most;
            if small || self.reaches_b(&as_volume(boxes, &node.boxes.lane(lane))) {
                self.cut(boxes, child, element_ns, block);
            }
        }
    }

    /// Splits consecutive elements into blocks at superchunk boundaries.
    fn slice(&mut self, elements: Range<u32>, element_ns: u32, block: Block) {
        let Range { start: mut first, end: past } = elements;
        let of_group = |element: u32| (element / SUPERCHUNK) * SUPERCHUNK;
        // Most ranges lie within one superchunk, which is never split; skip the division for them.
        if past <= of_group(first) + SUPERCHUNK {
            return self.add(Block { first, end: past, ..block }, element_ns);
        }
        let step = (BLOCK_NS / element_ns).next_multiple_of(SUPERCHUNK).max(SUPERCHUNK);
        while first < past {
            let end = past.min(of_group(first) + step);
            self.add(Block { first, end, ..block }, element_ns);
            first = end;
        }
    }

    fn add(&mut self, block: Block, element_ns: u32) {
        self.input.blocks.push(Block { leads: self.leads, ..block });
        self.leads = false;
        *self.cost += u64::from(block.end - block.first) * u64::from(element_ns);
        if self.input.blocks.len() == ROUND {
            (self.work)(self.input, self.caller, *self.cost);
            self.input.blocks.clear();
            *self.cost = 0;
        }
    }
}

/// Merges neighbouring blocks that continue each other; the order is kept.
pub(crate) fn joined(blocks: &[Block]) -> impl Iterator<Item = Block> + '_ {
    let mut left = blocks;
    std::iter::from_fn(move || {
        let (first, mut rest) = left.split_first()?;
        let mut all = *first;
        while let Some((next, others)) = rest.split_first()
            && goes_on(&all, next)
        {
            (all.end, rest) = (next.end, others);
        }
        left = rest;
        Some(all)
    })
}

/// True if `next` continues `block` at a superchunk boundary. The merged block then finds the same contacts
/// by the same tests.
fn goes_on(block: &Block, next: &Block) -> bool {
    let of = |block: &Block| (block.direction, block.slot, block.leaf, block.batch);
    of(block) == of(next) && block.end == next.first && next.first.is_multiple_of(SUPERCHUNK)
}

fn as_volume(boxes: &BoxTree, narrow: &NarrowBox) -> Volume {
    let (low, high) = boxes.widened(narrow);
    let (center, half) = (0.5 * (low + high), 0.5 * (high - low));
    if half.iter().all(|x| x.is_finite()) { Volume::Aabb { center, half } } else { Volume::Unbounded }
}

/// Passes to `take` the batches of B that kind A may touch, in leaves of B that overlap the leaf of A. Tests
/// are counted only in the first block of a batch of A, because the counts must not depend on how threads
/// merge blocks.
#[inline]
pub(crate) fn batches_of_b<'a>(
    (context, plan): (&PairContext<'a>, &Plan),
    block: &Block,
    arena: &Arena,
    counts: &mut FrameCounts,
    mut take: impl FnMut(&'a Batch),
) {
    let (tree_a, tree_b) = (&context.body_a.tree, &context.body_b.tree);
    let kind_a = tree_a.batches[block.batch as usize].kind;
    let mut take = |node: &Node| {
        for batch in &tree_b.batches[node.batches.start as usize..node.batches.end as usize] {
            if plan.tests(kind_a, batch.kind) {
                take(batch);
            }
        }
    };
    // The root was tested during the layout; most trees have no other node.
    let root = &tree_b.nodes[0];
    take(root);
    if root.children.is_empty() {
        counts.leaf_pairs += u64::from(block.leads);
        return;
    }
    let volume = &tree_a.nodes[block.leaf as usize].volume;
    let carried = CarriedVolume::new(volume, &context.motion.x_ba);
    let (mut leaf_pairs, mut tallies) = (0, counts.volumes_against(volume));
    let room = "sealing has made room for every node of B";
    let mut stack = arena.list(tree_b.nodes.len()).expect(room);
    stack.push(0).expect(room);
    let mut next = 0;
    while next < stack.len() {
        let children = tree_b.nodes[stack[next] as usize].children.clone();
        next += 1;
        for child in children {
            let below = &tree_b.nodes[child as usize];
            if let Some(filter) = &plan.filter
                && filter.keeps_apart(block.leaf, child)
            {
                continue;
            }
            let meets = context.volume_tests.overlap_carried(&carried, &below.volume);
            if block.leads {
                tallies.note(&below.volume, meets);
            }
            if !meets {
                continue;
            }
            take(below);
            if below.children.is_empty() {
                leaf_pairs += u64::from(block.leads);
            } else {
                stack.push(child).expect(room);
            }
        }
    }
    counts.leaf_pairs += leaf_pairs;
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_testkit::Random;

    /// Merging random blocks keeps the elements of every batch and merges all blocks that can be merged.
    #[test]
    fn joined_blocks_hold_the_same_elements_and_cut_no_group() {
        let mut random = Random::new(17, 0, 0);
        for _ in 0..300 {
            let mut blocks: Vec<Block> = Vec::new();
            for batch in 0..1 + random.below(3) as u32 {
                let mut first = 8 * random.below(40) as u32;
                for number in 0..1 + random.below(6) {
                    let step = if random.below(2) == 0 { SUPERCHUNK } else { LANES as u32 };
                    let end = (first / step + 1 + random.below(4) as u32) * step;
                    let direction = Direction { group_pair: 3, flipped: 1 };
                    let leads = number == 0;
                    blocks.push(Block {
                        direction,
                        slot: 0,
                        leaf: 2,
                        batch,
                        first,
                        end,
                        leads,
                        is_lone: false,
                    });
                    first = if random.below(3) == 0 { end + LANES as u32 } else { end };
                }
            }
            let elements = |block: &Block| {
                let batch = block.batch;
                (block.first..block.end).map(move |element| (batch, element))
            };
            let runs: Vec<Block> = joined(&blocks).collect();
            assert!(blocks.iter().flat_map(elements).eq(runs.iter().flat_map(elements)));
            let leading = |blocks: &[Block]| blocks.iter().filter(|block| block.leads).count();
            assert_eq!(leading(&blocks), leading(&runs));
            for cut in blocks.windows(2).filter(|two| two[0].batch == two[1].batch) {
                let is_whole = cut[0].end == cut[1].first && cut[1].first.is_multiple_of(SUPERCHUNK);
                assert_ne!(
                    is_whole,
                    runs.iter().any(|run| (run.batch, run.first) == (cut[1].batch, cut[1].first))
                );
            }
        }
    }
}
