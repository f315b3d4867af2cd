//! Search of the trees of B for the elements that the chunks of A may touch, for eight chunks at once.

use crate::frame::broad_phase::chunk::{LaneBoxes, WideBox};
use crate::frame::broad_phase::traversal::{Query, Traversal};
use crate::frame::input::{Block, PairContext};
use crate::report::FrameCounts;
use pong_arena::{List, Table};
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::Batch;
use pong_model::box_tree::{BoxNode, BoxTree, Child, NarrowBox, NarrowBoxes, lanes};

/// Elements of a superchunk: eight chunks of eight, whose boxes are transformed together.
pub(crate) const SUPERCHUNK: u32 = (LANES * LANES) as u32;

/// Capacity for candidate pairs. If a superchunk has more, it is searched for half as many chunks at a time.
const CANDIDATE_PAIRS_MAX: usize = 1024;

/// A batch of B, with the boxes of the eight chunks of a superchunk of A, in the precision of the batch's
/// tree.
#[derive(Clone, Copy)]
pub(crate) struct Reach<'a> {
    pub batch: &'a Batch,
    boxes: NarrowBoxes,
    /// Chunks of the block that overlap the batch's root box.
    met: LaneBits,
}

/// Fills `reach` with the batches of B, each with the chunks of superchunk `group` that reach it. If A's
/// batch has no boxes of superchunks (its tree is unbounded), all chunks of the block count as reaching.
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
) {
    let batch_a = &context.body_a.tree.batches[block.batch as usize];
    let first_chunk = block.first.saturating_sub(group * SUPERCHUNK) / LANES as u32;
    let past_chunk = (block.end - group * SUPERCHUNK).div_ceil(LANES as u32).min(LANES as u32);
    let in_block = (LaneBits::MAX << first_chunk) & (LaneBits::MAX >> (LANES as u32 - past_chunk));
    let carried = match batch_a.chunks.get(group as usize) {
        Some(boxes) => Some(LaneBoxes::of_chunks(simd, boxes, &context.motion.x_ba)),
        None => None,
    };
    reach.clear();
    for &batch in batches_b {
        let (boxes, met) = match &carried {
            Some(carried) => {
                let boxes = carried.narrowed(simd, &batch.boxes);
                (boxes, boxes.met_by(simd, &batch.boxes.around) & in_block)
            }
            None => (NarrowBoxes::EVERYTHING, in_block),
        };
        reach.push(Reach { batch, boxes, met }).expect("as much room as for batches");
    }
    counts.boxes_tested += batches_b.len() as u64;
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

/// Candidate pairs of the chunks of a superchunk. The pairs of each chunk are in the order in which a search
/// for this chunk alone would find them.
#[derive(Debug)]
pub(crate) struct CandidatePairs {
    list: Table<CandidatePair>,
    /// Eight bits per pair, one for each chunk; eight pairs per word, lowest byte first.
    words: [u64; CANDIDATE_PAIRS_MAX / LANES],
    /// Chunks that have at least one pair.
    pub chunks: LaneBits,
}

impl CandidatePairs {
    /// Candidate pairs of a chunk, in order.
    #[inline(always)]
    pub fn of(&self, chunk: usize) -> impl Iterator<Item = &CandidatePair> {
        /// Lowest bit of each byte of a word.
        const LOWEST: u64 = 0x0101_0101_0101_0101;
        let pairs = &self.list[..];
        let mut words = self.words[..pairs.len().div_ceil(LANES)].iter();
        // Remaining bits of the current word, and the index of the first pair of the next word.
        let (mut bits, mut next) = (0, 0);
        std::iter::from_fn(move || {
            while bits == 0 {
                bits = words.next()? >> chunk & LOWEST;
                next += LANES;
            }
            let bit = bits.trailing_zeros() as usize;
            bits &= bits - 1;
            Some(&pairs[next - LANES + bit / LaneBits::BITS as usize])
        })
    }

    #[inline(always)]
    fn clear(&mut self) {
        self.words[..self.list.len().div_ceil(LANES)].fill(0);
        self.list.clear();
        self.chunks = 0;
    }

    /// Adds a pair for some chunks, and returns its place in the list, which the caller fills.
    #[inline(always)]
    fn add(&mut self, chunks: LaneBits) -> &mut CandidatePair {
        let index = self.list.len();
        // Updates the whole word, because loading a word after storing one of its bytes would stall (store
        // forwarding).
        self.words[index / LANES] |= u64::from(chunks) << (index % LANES * LaneBits::BITS as usize);
        self.chunks |= chunks;
        self.list.slot().expect("room was asked for")
    }
}

/// Search of the trees of B for the candidate pairs of the chunks of a superchunk.
#[derive(Debug)]
pub(crate) struct GroupSearch {
    pub pairs: CandidatePairs,
    /// Chunks that take part.
    chunks: LaneBits,
    /// Index in the reach list of the batch whose tree is being traversed.
    current: usize,
    traversal: Traversal<LaneBits>,
}

impl GroupSearch {
    /// An idle search with room for its candidate pairs.
    pub fn new() -> Self {
        let nothing = CandidatePair { reach: 0, place: 0, box_b: WideBox::NOTHING };
        let list = Table::with_capacity(CANDIDATE_PAIRS_MAX, nothing);
        let pairs = CandidatePairs { list, words: [0; CANDIDATE_PAIRS_MAX / LANES], chunks: 0 };
        Self { pairs, chunks: 0, current: 0, traversal: Traversal::ended(0) }
    }

    /// Starts a search for some chunks of a superchunk.
    #[inline(always)]
    pub fn begin(&mut self, chunks: LaneBits) {
        (self.chunks, self.current) = (chunks, 0);
        self.traversal.end();
    }

    /// Discards the pairs found so far, and continues until the search ends or the list is full. Returns true
    /// if the search has ended.
    #[inline(always)]
    pub fn go_on<S: Simd>(&mut self, simd: S, reach: &[Reach<'_>], counts: &mut FrameCounts) -> bool {
        let Self { pairs, chunks, current, traversal } = self;
        pairs.clear();
        while let Some(Reach { batch, boxes, met }) = reach.get(*current) {
            let (tree, chunks) = (&batch.boxes, met & *chunks);
            if chunks != 0 && !tree.nodes.is_empty() {
                if traversal.has_ended() {
                    traversal.begin(tree, chunks);
                }
                let around = if chunks.is_power_of_two() { NarrowBox::NOTHING } else { boxes.around() };
                let reach = *current as u32;
                let mut query = GroupQuery { tree, reach, boxes, around, pairs, tested: 0 };
                while traversal.step(simd, &mut query, tree) {}
                counts.boxes_tested += query.tested;
                if !traversal.has_ended() {
                    return false;
                }
            }
            *current += 1;
        }
        true
    }
}

/// Boxes of the chunks of a superchunk, and the candidate pairs with the elements of one tree of B.
struct GroupQuery<'q> {
    tree: &'q BoxTree,
    /// Index of the tree's batch in the reach list.
    reach: u32,
    boxes: &'q NarrowBoxes,
    /// Box around all eight boxes; not set if only one chunk takes part.
    around: NarrowBox,
    pairs: &'q mut CandidatePairs,
    /// Number of tests of one box against eight.
    tested: u64,
}

impl GroupQuery<'_> {
    /// Calls `take` with the lane of every box of the node that some of `chunks` reach, and with the chunks
    /// that reach it.
    ///
    /// * A single chunk: its own box is compared with the node's boxes.
    /// * Several chunks: the box around all of them is compared with the node's boxes, then each of the
    ///   node's boxes that it meets with the boxes of the chunks.
    #[inline(always)]
    fn for_each_met<S: Simd>(
        &mut self,
        simd: S,
        node: &BoxNode,
        chunks: LaneBits,
        mut take: impl FnMut(&mut CandidatePairs, usize, LaneBits),
    ) {
        let is_one = chunks.is_power_of_two();
        let own_box;
        let query = if is_one {
            own_box = self.boxes.lane(chunks.trailing_zeros() as usize);
            &own_box
        } else {
            &self.around
        };
        let met = node.boxes.met_by(simd, query);
        self.tested += 1;
        for lane_b in lanes(met) {
            let mut chunks = chunks;
            if !is_one {
                chunks &= self.boxes.met_by(simd, &node.boxes.lane(lane_b));
                self.tested += 1;
            }
            if chunks != 0 {
                take(self.pairs, lane_b, chunks);
            }
        }
    }
}

impl Query for GroupQuery<'_> {
    type Volumes = LaneBits;

    #[inline(always)]
    fn expand<S: Simd>(
        &mut self,
        simd: S,
        node: &BoxNode,
        chunks: LaneBits,
        (children, chunks_of): (&mut [u32], &mut [LaneBits]),
    ) -> usize {
        let mut count = 0;
        self.for_each_met(simd, node, chunks, |_, lane_b, chunks| {
            if let Child::Node(child) = node.child(lane_b) {
                (children[count], chunks_of[count]) = (child, chunks);
                count += 1;
            }
        });
        count
    }

    #[inline(always)]
    fn collect<S: Simd>(&mut self, simd: S, node: &BoxNode, chunks: LaneBits) {
        let (tree, reach) = (self.tree, self.reach);
        self.for_each_met(simd, node, chunks, |pairs, lane_b, chunks| {
            if let Child::Element(place) = node.child(lane_b) {
                let pair = pairs.add(chunks);
                (pair.reach, pair.place) = (reach, place);
                pair.box_b.set(tree, &node.boxes, lane_b);
            }
        });
    }

    #[inline(always)]
    fn room(&self) -> usize {
        (CANDIDATE_PAIRS_MAX - self.pairs.list.len()) / LANES
    }
}
