//! Which elements of B the chunks of A may touch: B's trees are asked for eight chunks at once.

use crate::frame::broad_phase::chunk::{LaneBoxes, WideBox};
use crate::frame::input::{Block, PairContext};
use crate::report::FrameCounts;
use pong_arena::{List, Table};
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::Batch;
use pong_model::box_tree::{BoxNode, Child, NarrowBox, NarrowBoxes, lanes};

/// Elements whose boxes are carried together: eight chunks of eight.
pub(crate) const SUPERCHUNK: u32 = (LANES * LANES) as u32;

/// CandidatePairs that there is room for; beyond them the chunks of a group go through the trees one by one.
const CANDIDATE_PAIRS_MAX: usize = 1024;

/// Words of eight pairs each.
const WORDS: usize = CANDIDATE_PAIRS_MAX / LANES;

/// Nodes that can wait at once: a tree of 2³¹ elements has eleven levels, each leaves at most seven waiting.
pub(crate) const DEPTH_MAX: usize = 80;

/// A batch of B, and the boxes around eight chunks of A as its tree sees them.
#[derive(Clone, Copy)]
pub(crate) struct Reach<'a> {
    pub batch: &'a Batch,
    boxes: NarrowBoxes,
    /// The chunks that reach the batch at all.
    met: LaneBits,
}

impl Reach<'_> {
    /// Whether a chunk reaches anything of the batch.
    #[inline(always)]
    pub fn holds_for(&self, lane: usize) -> bool {
        self.met >> lane & 1 == 1 && !self.batch.boxes.nodes.is_empty()
    }
}

/// Which chunks of a group reach any batch of B.
#[inline(always)]
#[allow(
    clippy::manual_map,
    reason = "instructions of a level are used only in what is inlined: a closure may not be"
)]
pub(crate) fn chunks_in_reach<'a, S: Simd>(
    simd: S,
    context: &PairContext<'_>,
    block: &Block,
    group: u32,
    batches_b: &[&'a Batch],
    reach: &mut List<'_, Reach<'a>>,
    counts: &mut FrameCounts,
) -> LaneBits {
    let batch_a = &context.body_a.tree.batches[block.batch as usize];
    let first_chunk = block.first.saturating_sub(group * SUPERCHUNK) / LANES as u32;
    let past_chunk = (block.end - group * SUPERCHUNK).div_ceil(LANES as u32).min(LANES as u32);
    let in_block = (LaneBits::MAX << first_chunk) & (LaneBits::MAX >> (LANES as u32 - past_chunk));
    let carried = match batch_a.chunks.get(group as usize) {
        // An element by itself is asked when it is carried.
        _ if batch_a.items.len() == 1 => None,
        Some(boxes) => Some(LaneBoxes::of_chunks(simd, boxes, &context.motion.x_ba)),
        None => None,
    };
    let mut any = 0;
    reach.clear();
    for &batch in batches_b {
        let (boxes, met) = match &carried {
            Some(carried) => {
                let boxes = carried.narrowed(simd, &batch.boxes);
                (boxes, boxes.met_by(simd, &batch.boxes.around) & in_block)
            }
            None => (NarrowBoxes::EVERYTHING, in_block),
        };
        any |= met;
        reach.push(Reach { batch, boxes, met }).expect("as much room as for batches");
    }
    counts.boxes_tested += batches_b.len() as u64;
    any
}

/// An element of B that chunks of A may touch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CandidatePair {
    /// Which batch in reach it is in.
    pub reach: u32,
    /// Its place in the batch.
    pub place: u32,
    /// Its box.
    pub box_b: WideBox,
}

/// A node of the tree in hand that waits, and the chunks that reach it.
#[derive(Clone, Copy, Debug)]
struct StackEntry {
    node: u32,
    chunks: LaneBits,
}

/// Candidate pairs of the chunks of a superchunk, in the order in which they are tested: for every chunk that in which it alone
/// would find them. Empty between blocks.
#[derive(Debug)]
pub(crate) struct CandidatePairs {
    list: Table<CandidatePair>,
    /// For every pair a bit for every chunk, eight pairs to a word from the lowest byte.
    chunks: [u64; WORDS],
    /// The first `depth` of them.
    waiting: [StackEntry; DEPTH_MAX],
    depth: usize,
    any: LaneBits,
}

impl CandidatePairs {
    /// Room for a few.
    pub fn new() -> Self {
        let nothing = CandidatePair { reach: 0, place: 0, box_b: WideBox::NOTHING };
        Self {
            list: Table::with_capacity(CANDIDATE_PAIRS_MAX, nothing),
            chunks: [0; WORDS],
            waiting: [StackEntry { node: 0, chunks: 0 }; DEPTH_MAX],
            depth: 0,
            any: 0,
        }
    }

    /// The chunks that meet anything.
    pub fn chunks(&self) -> LaneBits {
        self.any
    }

    /// Numbers of the candidate pairs of a chunk.
    #[inline(always)]
    pub fn of(&self, chunk: usize) -> NumbersOfChunk<'_> {
        NumbersOfChunk { words: &self.chunks[..self.words()], chunk, next: 0, bits: 0 }
    }

    /// All pairs, by their numbers.
    #[inline(always)]
    pub fn pairs(&self) -> &[CandidatePair] {
        &self.list
    }

    fn words(&self) -> usize {
        self.list.len().div_ceil(LANES)
    }

    #[inline(always)]
    fn clear(&mut self) {
        let words = self.words();
        self.chunks[..words].fill(0);
        self.list.clear();
        self.any = 0;
    }

    fn has_room_for_a_node(&self) -> bool {
        self.list.len() + LANES <= CANDIDATE_PAIRS_MAX
    }

    /// Adds a pair of some chunks; its box is left to the caller.
    #[inline(always)]
    fn add(&mut self, reach: usize, element: u32, chunks: LaneBits) -> &mut CandidatePair {
        let index = self.list.len();
        // Not as bytes: a word that was just written in pieces would be waited for.
        self.chunks[index / LANES] |= u64::from(chunks) << (index % LANES * LaneBits::BITS as usize);
        self.any |= chunks;
        let pair = self.list.slot().expect("room was asked for");
        (pair.reach, pair.place) = (reach as u32, element);
        pair
    }

    /// Gathers the candidate pairs of some chunks of a group; whether there was room for all.
    #[inline(always)]
    pub fn gather<S: Simd>(
        &mut self,
        simd: S,
        reach: &[Reach<'_>],
        chunks: LaneBits,
        counts: &mut FrameCounts,
    ) -> bool {
        self.clear();
        for (index, Reach { batch, boxes, met }) in reach.iter().enumerate() {
            let chunks = met & chunks;
            if chunks == 0 || batch.boxes.nodes.is_empty() {
                continue;
            }
            let around = if chunks.is_power_of_two() { NarrowBox::NOTHING } else { boxes.around() };
            self.wait(0, chunks);
            while let Some(StackEntry { node, chunks }) = self.next_waiting() {
                let node = &batch.boxes.nodes[node as usize];
                if !self.has_room_for_a_node() {
                    self.depth = 0;
                    return false;
                }
                // One chunk's box is asked itself; of several, first the box around all, then each box of B that it meets.
                let lone = chunks.is_power_of_two();
                let lone_box;
                let query = if lone {
                    lone_box = boxes.lane(chunks.trailing_zeros() as usize);
                    &lone_box
                } else {
                    &around
                };
                let met = node.boxes.met_by(simd, query);
                counts.boxes_tested += 1;
                for lane_b in lanes(met) {
                    let mut chunks = chunks;
                    if !lone {
                        chunks &= boxes.met_by(simd, &node.boxes.lane(lane_b));
                        counts.boxes_tested += 1;
                    }
                    if chunks != 0
                        && let Some(pair) = self.note(index, node.child(lane_b), chunks)
                    {
                        pair.box_b.set(&batch.boxes, &node.boxes, lane_b);
                    }
                }
            }
        }
        true
    }

    /// A child that chunks reach: an element is a pair, whose box is left to the caller; a node waits.
    #[inline(always)]
    fn note(&mut self, reach: usize, child: Child, chunks: LaneBits) -> Option<&mut CandidatePair> {
        match child {
            Child::Element(place) => Some(self.add(reach, place, chunks)),
            Child::Node(node) => {
                self.wait(node, chunks);
                None
            }
        }
    }

    #[inline(always)]
    fn wait(&mut self, node: u32, chunks: LaneBits) {
        // There is room for the deepest tree.
        self.waiting[self.depth] = StackEntry { node, chunks };
        self.depth += 1;
    }

    #[inline(always)]
    fn next_waiting(&mut self) -> Option<StackEntry> {
        self.depth = self.depth.checked_sub(1)?;
        Some(self.waiting[self.depth])
    }

    /// Goes on with the traversal of one chunk through the trees until it is through or there is no more room; whether it
    /// is through. What was there before is gone.
    #[inline(always)]
    pub fn go_on<S: Simd>(
        &mut self,
        simd: S,
        traversal: &mut Traversal,
        reach: &[Reach<'_>],
        counts: &mut FrameCounts,
    ) -> bool {
        self.clear();
        loop {
            if !self.has_room_for_a_node() {
                return false;
            }
            let Some(StackEntry { node, chunks }) = self.next_waiting() else {
                let Some(next) = reach.get(traversal.next) else { return true };
                traversal.next += 1;
                if next.holds_for(traversal.lane) {
                    traversal.query = next.boxes.lane(traversal.lane);
                    self.wait(0, 1 << traversal.lane);
                }
                continue;
            };
            let tree = &reach[traversal.next - 1].batch.boxes;
            let node: &BoxNode = &tree.nodes[node as usize];
            let met = node.boxes.met_by(simd, &traversal.query);
            counts.boxes_tested += 1;
            for lane_b in lanes(met) {
                if let Some(pair) = self.note(traversal.next - 1, node.child(lane_b), chunks) {
                    pair.box_b.set(tree, &node.boxes, lane_b);
                }
            }
        }
    }
}

/// Numbers of the candidate pairs of one chunk, in their order.
pub(crate) struct NumbersOfChunk<'a> {
    words: &'a [u64],
    chunk: usize,
    /// The word that comes next.
    next: usize,
    /// What is left of the word in hand: the lowest bit of every pair that the chunk has.
    bits: u64,
}

impl Iterator for NumbersOfChunk<'_> {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        /// The lowest bit of every pair in a word.
        const LOWEST: u64 = 0x0101_0101_0101_0101;
        while self.bits == 0 {
            let word = self.words.get(self.next)?;
            self.bits = *word >> self.chunk & LOWEST;
            self.next += 1;
        }
        let bit = self.bits.trailing_zeros() as usize;
        self.bits &= self.bits - 1;
        Some((self.next - 1) * LANES + bit / LaneBits::BITS as usize)
    }
}

/// How far one chunk has got through the trees of B.
pub(crate) struct Traversal {
    lane: usize,
    /// The batch that comes next.
    next: usize,
    query: NarrowBox,
}

impl Traversal {
    /// From the start, for the chunk of a group.
    pub fn new(lane: usize) -> Self {
        Self { lane, next: 0, query: NarrowBox::NOTHING }
    }
}
