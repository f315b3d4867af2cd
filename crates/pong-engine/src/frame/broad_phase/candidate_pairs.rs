//! Candidate pairs: elements of B that the chunks of A may touch, found for eight chunks at once.

use crate::frame::broad_phase::chunk::{LaneBoxes, WideBox};
use crate::frame::input::{Block, PairContext};
use crate::report::FrameCounts;
use pong_arena::{List, Table};
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::Batch;
use pong_model::box_tree::{BoxTree, Child, NarrowBox, NarrowBoxes, lanes};

/// Elements whose boxes are transformed together: eight chunks of eight.
pub(crate) const SUPERCHUNK: u32 = (LANES * LANES) as u32;

/// Capacity for candidate pairs; beyond it the chunks of the group are gathered half by half.
const CANDIDATE_PAIRS_MAX: usize = 1024;

/// Number of mask words; each holds eight pairs.
const WORDS: usize = CANDIDATE_PAIRS_MAX / LANES;

/// Stack depth: a tree of 2³¹ elements has eleven levels, and each leaves at most seven nodes on the stack.
pub(crate) const DEPTH_MAX: usize = 80;

/// A batch of B, with the boxes of eight chunks of A in the precision of its tree.
#[derive(Clone, Copy)]
pub(crate) struct Reach<'a> {
    pub batch: &'a Batch,
    boxes: NarrowBoxes,
    /// Chunks that overlap the batch's root box.
    met: LaneBits,
}

impl Reach<'_> {
    /// Returns true if a chunk overlaps a batch that is not empty.
    #[inline(always)]
    pub fn holds_for(&self, lane: usize) -> bool {
        self.met >> lane & 1 == 1 && !self.batch.boxes.nodes.is_empty()
    }
}

/// Returns the chunks of a group that reach any batch of B.
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
        // A single element is tested later, with its own box.
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
    /// Index of its batch in the reach list.
    pub reach: u32,
    /// Index in the batch.
    pub place: u32,
    /// Box of the element.
    pub box_b: WideBox,
}

/// A pending node of the current tree, and the chunks that reach it.
#[derive(Clone, Copy, Debug)]
struct StackEntry {
    node: u32,
    chunks: LaneBits,
}

/// Candidate pairs of the chunks of a superchunk. For each chunk they are in the order in which a traversal
/// for it alone finds them. Empty between blocks.
#[derive(Debug)]
pub(crate) struct CandidatePairs {
    list: Table<CandidatePair>,
    /// Eight bits per pair, one for each chunk; eight pairs per word, lowest byte first.
    chunks: [u64; WORDS],
    /// Stack of pending nodes; the first `depth` are valid.
    waiting: [StackEntry; DEPTH_MAX],
    depth: usize,
    any: LaneBits,
    /// Chunks whose pairs are gathered, and the index of the current batch in the reach list.
    of: LaneBits,
    next: usize,
}

impl CandidatePairs {
    /// An empty list with its capacity allocated.
    pub fn new() -> Self {
        let nothing = CandidatePair { reach: 0, place: 0, box_b: WideBox::NOTHING };
        Self {
            list: Table::with_capacity(CANDIDATE_PAIRS_MAX, nothing),
            chunks: [0; WORDS],
            waiting: [StackEntry { node: 0, chunks: 0 }; DEPTH_MAX],
            depth: 0,
            any: 0,
            of: 0,
            next: 0,
        }
    }

    /// Chunks that have at least one candidate pair.
    pub fn chunks(&self) -> LaneBits {
        self.any
    }

    /// Indices of the candidate pairs of a chunk.
    #[inline(always)]
    pub fn of(&self, chunk: usize) -> NumbersOfChunk<'_> {
        NumbersOfChunk { words: &self.chunks[..self.words()], chunk, next: 0, bits: 0 }
    }

    /// All pairs, by index.
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

    /// Adds a pair for some chunks; the caller sets its box.
    #[inline(always)]
    fn add(&mut self, element: u32, chunks: LaneBits) -> &mut CandidatePair {
        let index = self.list.len();
        // Whole-word update: byte stores followed by a word load would stall (store forwarding).
        self.chunks[index / LANES] |= u64::from(chunks) << (index % LANES * LaneBits::BITS as usize);
        self.any |= chunks;
        let pair = self.list.slot().expect("room was asked for");
        (pair.reach, pair.place) = (self.next as u32, element);
        pair
    }

    /// Starts to gather the candidate pairs of some chunks of a group.
    #[inline(always)]
    pub fn begin(&mut self, chunks: LaneBits) {
        (self.of, self.next, self.depth) = (chunks, 0, 0);
    }

    /// Gathers candidate pairs until all are found or the list is full; returns true if all are found.
    /// Earlier pairs are discarded.
    #[inline(always)]
    pub fn gather<S: Simd>(&mut self, simd: S, reach: &[Reach<'_>], counts: &mut FrameCounts) -> bool {
        self.clear();
        while let Some(Reach { batch, boxes, met }) = reach.get(self.next) {
            let chunks = met & self.of;
            if chunks != 0 && !batch.boxes.nodes.is_empty() {
                if self.depth == 0 {
                    self.wait(0, chunks);
                }
                let around = if chunks.is_power_of_two() { NarrowBox::NOTHING } else { boxes.around() };
                if !self.visit_nodes(simd, &batch.boxes, (boxes, &around), counts) {
                    return false;
                }
            }
            self.next += 1;
        }
        true
    }

    /// Visits the pending nodes of a tree; returns false if there are some left when the list is full.
    #[inline(always)]
    fn visit_nodes<S: Simd>(
        &mut self,
        simd: S,
        tree: &BoxTree,
        (boxes, around): (&NarrowBoxes, &NarrowBox),
        counts: &mut FrameCounts,
    ) -> bool {
        while self.depth > 0 {
            if !self.has_room_for_a_node() {
                return false;
            }
            self.depth -= 1;
            let StackEntry { node, chunks } = self.waiting[self.depth];
            let node = &tree.nodes[node as usize];
            // One chunk: query with its own box. Several: query with the box around all, then with each box
            // of B that it meets.
            let is_one = chunks.is_power_of_two();
            let own_box;
            let query = if is_one {
                own_box = boxes.lane(chunks.trailing_zeros() as usize);
                &own_box
            } else {
                around
            };
            let met = node.boxes.met_by(simd, query);
            counts.boxes_tested += 1;
            for lane_b in lanes(met) {
                let mut chunks = chunks;
                if !is_one {
                    chunks &= boxes.met_by(simd, &node.boxes.lane(lane_b));
                    counts.boxes_tested += 1;
                }
                if chunks != 0
                    && let Some(pair) = self.note(node.child(lane_b), chunks)
                {
                    pair.box_b.set(tree, &node.boxes, lane_b);
                }
            }
        }
        true
    }

    /// Handles a child that chunks reach: adds a pair for an element (the caller sets its box), or pushes a
    /// node.
    #[inline(always)]
    fn note(&mut self, child: Child, chunks: LaneBits) -> Option<&mut CandidatePair> {
        match child {
            Child::Element(place) => Some(self.add(place, chunks)),
            Child::Node(node) => {
                self.wait(node, chunks);
                None
            }
        }
    }

    #[inline(always)]
    fn wait(&mut self, node: u32, chunks: LaneBits) {
        // The stack has room for the deepest tree.
        self.waiting[self.depth] = StackEntry { node, chunks };
        self.depth += 1;
    }
}

/// Indices of the candidate pairs of one chunk, in order.
pub(crate) struct NumbersOfChunk<'a> {
    words: &'a [u64],
    chunk: usize,
    /// Index of the next word.
    next: usize,
    /// Remaining bits of the current word: the lowest bit of each pair's byte.
    bits: u64,
}

impl Iterator for NumbersOfChunk<'_> {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        /// Lowest bit of each byte of a word.
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
