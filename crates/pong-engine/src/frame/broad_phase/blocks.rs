//! Splits the work of a frame into blocks, by the trees of bounding volumes of A, and finds the batches of B
//! that the elements of a block may touch.

use crate::frame::broad_phase::group_search::SUPERCHUNK;
use crate::frame::input::motion::PairMotions;
use crate::frame::input::{Block, BlockKind, PairContext};
use crate::frame::solids::slices;
use crate::report::FrameCounts;
use crate::scene::Scene;
use crate::seal::{Direction, Plan, Sealed, SolidPair};
use pong_arena::Arena;
use pong_geometry::bounding::{CarriedVolume, Volume};
use pong_geometry::simd::LANES;
use pong_model::box_tree::{BoxNode, BoxTree, Child, NarrowBox};
use pong_model::{Batch, MovableGroup, Node};
use std::ops::Range;

/// Blocks per round. When a round is full, it is run before further blocks are laid out.
pub(crate) const ROUND: usize = 4096;

/// Upper bound of the pending nodes of a box tree: the deepest tree, of 2³¹ elements, has eleven levels, and
/// each leaves at most seven nodes pending.
const DEPTH_MAX: usize = 80;

/// Cost of the elements below a box node, ns, above which the layout goes on to its children, and tests each
/// child that costs more than this itself.
const NODE_NS: u32 = 4000;

/// Cost above which a block of several superchunks is split, ns: much more than claiming a block costs, and
/// little of a frame. Small blocks cost little, because a thread runs neighbouring blocks of one claim as
/// one.
const BLOCK_NS: u32 = 1000;

/// Pairs of solids per block.
const SOLIDS_AT_ONCE: usize = 4;

/// Rough cost of a pair of solids, ns.
const SOLIDS_NS: u32 = 1000;

/// Rough cost of a slice of a large mesh that is near a solid of B, ns.
const SLICE_NS: u32 = 20_000;

/// A batch of A, and the leaf of A's tree that has it.
#[derive(Clone, Copy, Debug)]
struct BatchOfA {
    leaf: u32,
    batch: u32,
    /// Rough cost of an element, ns.
    element_ns: u32,
}

/// Part of A's trees that has not been laid out yet.
#[derive(Clone, Copy, Debug)]
enum Pending {
    /// Node of A's tree of bounding volumes.
    Node(u32),
    Batch(BatchOfA),
    /// Node of the box tree of a batch.
    Boxes(BatchOfA, u32),
    /// Elements of a batch: the first, and one past the last.
    Elements(BatchOfA, [u32; 2]),
    /// Pairs of solids of the plan, from this one on.
    Solids(u32),
    /// Slices of A's solid of one pair of the plan: the pair, and the first slice.
    Slices(u32, u32),
}

/// Stack of pending parts.
pub(crate) struct PendingParts(Vec<Pending>);

impl PendingParts {
    /// Allocates the stack for a tree with at most this many nodes and batches together. Each of them is
    /// pending at most once, and besides them at most [`DEPTH_MAX`] box nodes of one batch, the solids, and the
    /// slices of one of them.
    pub fn for_tree(nodes_and_batches: usize) -> Self {
        Self(Vec::with_capacity(nodes_and_batches + DEPTH_MAX + 2))
    }

    /// Memory of the stack for such a tree, bytes.
    pub const fn bytes(nodes_and_batches: usize) -> usize {
        (nodes_and_batches + DEPTH_MAX + 2) * size_of::<Pending>()
    }
}

/// Layout of the blocks of some pairs, round by round.
pub(crate) struct Layout<'a> {
    scene: &'a Scene,
    sealed: &'a Sealed,
    /// Pairs of movable groups, and their motions in the same order.
    pairs: &'a [u32],
    /// Index of the next pair in `pairs`, and number of its directions that have begun.
    next: (usize, usize),
    of: Option<OfDirection<'a>>,
    pending: &'a mut Vec<Pending>,
    /// True until the first block of the current batch has been laid out.
    leads: bool,
    ended: bool,
}

/// Direction whose blocks are being laid out.
#[derive(Clone, Copy)]
struct OfDirection<'a> {
    plan: &'a Plan,
    /// Movable groups A and B.
    bodies: (&'a MovableGroup, &'a MovableGroup),
    direction: Direction,
    /// Index of the pair's motions.
    slot: u32,
}

/// Output of a layout: the blocks of a round, their estimated cost, ns, and the counts of overlap tests.
struct Out<'o> {
    blocks: &'o mut Vec<Block>,
    cost_ns: u64,
    counts: &'o mut FrameCounts,
}

impl<'a> Layout<'a> {
    /// Starts at the first pair.
    pub fn new(
        scene: &'a Scene,
        sealed: &'a Sealed,
        pairs: &'a [u32],
        pending: &'a mut PendingParts,
    ) -> Self {
        let pending = &mut pending.0;
        // An earlier layout that panicked may have left parts behind.
        pending.clear();
        Self { scene, sealed, pairs, next: (0, 0), of: None, pending, leads: true, ended: false }
    }

    /// Lays out the blocks of the next round, and counts overlap tests. Returns the estimated cost of the
    /// round, ns; `None` after the last one. The last round may be empty.
    #[inline]
    pub fn next_round(
        &mut self,
        motions: &[PairMotions],
        blocks: &mut Vec<Block>,
        counts: &mut FrameCounts,
    ) -> Option<u64> {
        blocks.clear();
        if self.ended {
            return None;
        }
        let mut out = Out { blocks, cost_ns: 0, counts };
        while out.blocks.len() < ROUND {
            if let (Some(of), Some(part)) = (self.of, self.pending.pop()) {
                self.lay_out(&of, part, motions, &mut out);
            } else if !self.begin_direction() {
                self.ended = true;
                break;
            }
        }
        Some(out.cost_ns)
    }

    /// Begins the next direction of the current pair that has tests. If there is none, goes on to the next
    /// pair. Returns false after the last pair.
    #[inline]
    fn begin_direction(&mut self) -> bool {
        let (slot, skipped) = self.next;
        let Some(&group_pair) = self.pairs.get(slot) else { return false };
        match self.sealed.plans_of(group_pair).nth(skipped) {
            None => (self.next, self.of) = ((slot + 1, 0), None),
            Some((plan, direction)) => {
                let (body_a, body_b) = self.sealed.bodies_of(direction);
                let bodies = (self.scene.body(body_a), self.scene.body(body_b));
                self.next = (slot, skipped + 1);
                self.of = Some(OfDirection { plan, bodies, direction, slot: slot as u32 });
                if !plan.solids.is_empty() {
                    self.pending.push(Pending::Solids(0));
                }
                if plan.tests_elements() {
                    self.pending.push(Pending::Node(0));
                }
            }
        }
        true
    }

    /// Lays out one pending part: adds at most one block, and makes the rest of the part pending.
    #[inline]
    fn lay_out(&mut self, of: &OfDirection<'a>, part: Pending, motions: &[PairMotions], out: &mut Out<'_>) {
        let tree = &of.bodies.0.tree;
        match part {
            Pending::Node(node) => self.visit(of, node, motions, out),
            Pending::Batch(of_a) => {
                self.leads = true;
                // A single element needs no split, and `cut` would take a measurable part of the time of such
                // a block.
                match tree.batches[of_a.batch as usize].items.len() {
                    1 => self.add(of, of_a, [0, 1], out),
                    _ => self.cut(of, of_a, 0, motions, out),
                }
            }
            Pending::Boxes(of_a, node) => self.cut(of, of_a, node, motions, out),
            Pending::Elements(of_a, elements) => self.slice(of, of_a, elements, out),
            Pending::Solids(first) => self.add_solids(of, first, motions, out),
            Pending::Slices(pair, first) => self.add_slice(of, pair, first, motions, out),
        }
    }

    /// Makes the children and the batches of a node pending, if the node reaches B and no filter keeps it
    /// from all of B. The children are laid out before the batches.
    #[inline]
    fn visit(&mut self, of: &OfDirection<'a>, node: u32, motions: &[PairMotions], out: &mut Out<'_>) {
        if let Some(filter) = &of.plan.filter
            && filter.keeps_from_all(node)
        {
            return;
        }
        let tree = &of.bodies.0.tree;
        let Node { volume, children, batches, .. } = &tree.nodes[node as usize];
        if !self.reaches_b(of, volume, motions, out) {
            return;
        }
        for batch in batches.clone().rev() {
            if let Some(element_ns) = of.plan.element_ns(tree.batches[batch as usize].kind) {
                self.pending.push(Pending::Batch(BatchOfA { leaf: node, batch, element_ns }));
            }
        }
        self.pending.extend(children.clone().rev().map(Pending::Node));
    }

    /// Returns true if a volume of A overlaps the root volume of B's tree, and counts the test.
    fn reaches_b(
        &self,
        of: &OfDirection<'a>,
        volume: &Volume,
        motions: &[PairMotions],
        out: &mut Out<'_>,
    ) -> bool {
        let root = &of.bodies.1.tree.nodes[0].volume;
        let x_ba = &motions[of.slot as usize].of(of.direction).x_ba;
        let meets = self.sealed.volume_tests.overlap(volume, root, x_ba);
        out.counts.note_volumes(volume, root, meets);
        meets
    }

    /// Splits the elements below a box node into blocks. If they cost more than [`NODE_NS`], goes on to the
    /// node's children instead, and skips each child that costs more than this itself and does not reach B.
    fn cut(
        &mut self,
        of: &OfDirection<'a>,
        of_a: BatchOfA,
        node: u32,
        motions: &[PairMotions],
        out: &mut Out<'_>,
    ) {
        let boxes = &of.bodies.0.tree.batches[of_a.batch as usize].boxes;
        let node: &BoxNode = &boxes.nodes[node as usize];
        let Range { start, end } = node.elements;
        let at_most = (NODE_NS / of_a.element_ns).next_multiple_of(LANES as u32);
        if node.is_bottom() || end - start <= at_most {
            return self.slice(of, of_a, [start, end], out);
        }
        let first = self.pending.len();
        for (lane, child) in node.children().enumerate() {
            let Child::Node(child) = child else { continue };
            let below = &boxes.nodes[child as usize].elements;
            let small = below.end - below.start <= at_most;
            if small || self.reaches_b(of, &as_volume(boxes, &node.boxes.lane(lane)), motions, out) {
                self.pending.push(Pending::Boxes(of_a, child));
            }
        }
        self.pending[first..].reverse();
    }

    /// Makes a block of the first of some consecutive elements, up to the superchunk boundary at which the
    /// block costs about [`BLOCK_NS`] or has one superchunk. The remaining elements stay pending.
    fn slice(&mut self, of: &OfDirection<'a>, of_a: BatchOfA, [first, past]: [u32; 2], out: &mut Out<'_>) {
        let group = (first / SUPERCHUNK) * SUPERCHUNK;
        // Most ranges lie within one superchunk, which is never split. They need no division.
        if past <= group + SUPERCHUNK {
            return self.add(of, of_a, [first, past], out);
        }
        let step = (BLOCK_NS / of_a.element_ns).next_multiple_of(SUPERCHUNK).max(SUPERCHUNK);
        let end = past.min(group + step);
        self.add(of, of_a, [first, end], out);
        if end < past {
            self.pending.push(Pending::Elements(of_a, [end, past]));
        }
    }

    #[inline]
    fn add(&mut self, of: &OfDirection<'a>, of_a: BatchOfA, [first, end]: [u32; 2], out: &mut Out<'_>) {
        let BatchOfA { leaf, batch, element_ns } = of_a;
        let is_single = of.bodies.0.tree.batches[batch as usize].items.len() == 1;
        let kind = if is_single { BlockKind::Single } else { BlockKind::Elements };
        let (direction, slot, leads) = (of.direction, of.slot, std::mem::take(&mut self.leads));
        out.blocks.push(Block { direction, slot, leaf, batch, first, end, leads, kind });
        out.cost_ns += u64::from(end - first) * u64::from(element_ns);
    }

    /// Makes a block of pairs of solids from `first` on, unless A does not reach B. The remaining pairs stay
    /// pending, and so do the slices of a large mesh of A.
    fn add_solids(&mut self, of: &OfDirection<'a>, first: u32, motions: &[PairMotions], out: &mut Out<'_>) {
        if first == 0 && !self.reaches_b(of, &of.bodies.0.tree.nodes[0].volume, motions, out) {
            return;
        }
        let pairs = &of.plan.solids[first as usize..];
        let has_slices = |pair: &SolidPair| slices::count(&of.bodies.0.solids[pair.a as usize]).is_some();
        let whole = pairs.iter().take(SOLIDS_AT_ONCE).take_while(|pair| !has_slices(pair)).count() as u32;
        let end = first + whole.max(1);
        if end < of.plan.solids.len() as u32 {
            self.pending.push(Pending::Solids(end));
        }
        if whole == 0 {
            self.pending.push(Pending::Slices(first, 0));
            return;
        }
        self.add_block_of_solids(of, [first, end], BlockKind::Solids, 0, out);
        out.cost_ns += u64::from(whole) * u64::from(SOLIDS_NS);
    }

    /// Makes a block of the first slice of A's solid, from `first` on, that is near the partner. The slices after it
    /// stay pending.
    fn add_slice(
        &mut self,
        of: &OfDirection<'a>,
        pair: u32,
        first: u32,
        motions: &[PairMotions],
        out: &mut Out<'_>,
    ) {
        let solids = &of.plan.solids[pair as usize];
        let Some(count) = slices::count(&of.bodies.0.solids[solids.a as usize]) else { return };
        let motion = motions[of.slot as usize].of(of.direction);
        let is_near = |slice: &u32| slices::is_near(of.bodies, solids, *slice, motion);
        let Some(slice) = (first..count).find(is_near) else { return };
        if slice + 1 < count {
            self.pending.push(Pending::Slices(pair, slice + 1));
        }
        self.add_block_of_solids(of, [pair, pair + 1], BlockKind::SolidSlice, slice, out);
        out.cost_ns += u64::from(SLICE_NS);
    }

    fn add_block_of_solids(
        &self,
        of: &OfDirection<'a>,
        [first, end]: [u32; 2],
        kind: BlockKind,
        slice: u32,
        out: &mut Out<'_>,
    ) {
        let (direction, slot) = (of.direction, of.slot);
        out.blocks.push(Block { direction, slot, leaf: slice, batch: 0, first, end, leads: false, kind });
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

/// True if `next` continues `block` at a superchunk boundary, so that the merged block finds the same
/// contacts by the same tests.
fn goes_on(block: &Block, next: &Block) -> bool {
    let of = |block: &Block| (block.direction, block.slot, block.leaf, block.batch);
    of(block) == of(next) && block.end == next.first && next.first.is_multiple_of(SUPERCHUNK)
}

fn as_volume(boxes: &BoxTree, narrow: &NarrowBox) -> Volume {
    let (low, high) = boxes.widened(narrow);
    let (center, half) = (0.5 * (low + high), 0.5 * (high - low));
    if half.iter().all(|x| x.is_finite()) { Volume::Aabb { center, half } } else { Volume::Unbounded }
}

/// Passes to `take` the batches of B that the plan tests against the block's kind, from all nodes of B that
/// overlap the block's leaf of A. Tests of bounding volumes are counted only in the first block of a batch of
/// A (`leads`), because the counts must not depend on how threads merge blocks.
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
    // The layout has already tested the root of B. Most trees have no other node.
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
                        kind: BlockKind::Elements,
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
