//! Search of a tree of B for the elements that a single element of A may touch.
//!
//! The tree's boxes are compared with the element's own box in B's frame, with its bounding sphere, or with
//! both. Both are much tighter than the rotated box of the element's chunk.

use crate::frame::broad_phase::chunk::Chunk;
use crate::frame::broad_phase::traversal::{Query, Traversal};
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::box_tree::{BoxNode, BoxTree, NarrowBall, NarrowBox};

/// Number of searches that run together.
pub(crate) const SEARCHES_MAX: usize = LaneBits::BITS as usize;

/// Capacity for elements of B. When the list is full, its elements are tested before the search continues.
const FOUND_MAX: usize = 32 * LANES;

/// Search of one tree of B by one element of A.
#[derive(Debug)]
#[repr(C, align(64))]
pub(crate) struct ElementSearch {
    traversal: Traversal<()>,
    query: ElementQuery,
}

/// Volume of an element of A, and the elements of B that it reaches.
// The order of the fields keeps those that most searches use in few cache lines.
#[derive(Debug)]
#[repr(C, align(64))]
struct ElementQuery {
    volume: ElementVolume,
    /// Nodes tested since the last `take_tested`.
    tested: u32,
    /// Number of valid entries in `found`.
    count: u32,
    /// Candidates found last, in test order. Entries from `count` on are unused, because all eight entries of
    /// a node are written, whatever their number of hits.
    found: [u32; FOUND_MAX + LANES],
}

/// Volume that is compared with the boxes of a tree.
#[derive(Clone, Copy, Debug)]
enum ElementVolume {
    Box(NarrowBox),
    /// For a point or a sphere, whose box would not reject more.
    Ball(NarrowBall),
    /// For an ellipsoid that may meet triangles: it lies in its box and in its bounding sphere. Also for an
    /// unbounded sphere.
    BoxAndBall(NarrowBox, NarrowBall),
}

/// Candidate element of B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near(u32);

impl Near {
    const OVER_FACE: u32 = 1 << 31;

    /// Index in the batch. A batch has at most 2³¹ elements, so the top bit is free for the flag.
    #[inline]
    pub fn place(self) -> usize {
        (self.0 & !Self::OVER_FACE) as usize
    }

    /// For a triangle that has been narrowed down: true if only its face can push.
    #[inline]
    pub fn over_face(self) -> bool {
        self.0 & Self::OVER_FACE != 0
    }
}

impl ElementVolume {
    #[inline(always)]
    fn new(chunk: &Chunk<'_>, tree: &BoxTree) -> Self {
        match chunk.single_ball(tree) {
            // An unbounded sphere would also meet the empty boxes of unused lanes, so its box is compared as
            // well.
            Some(ball) if chunk.is_of_balls() && ball.is_bounded() => Self::Ball(ball),
            Some(ball) => Self::BoxAndBall(chunk.single_box(tree), ball),
            None => Self::Box(chunk.single_box(tree)),
        }
    }

    #[inline(always)]
    fn meets<S: Simd>(&self, simd: S, node: &BoxNode) -> LaneBits {
        match self {
            Self::Box(around) => node.boxes.met_by(simd, around),
            Self::Ball(ball) => node.boxes.near(simd, ball),
            Self::BoxAndBall(around, ball) => node.boxes.met_by(simd, around) & node.boxes.near(simd, ball),
        }
    }
}

impl Query for ElementQuery {
    type Volumes = ();

    #[inline(always)]
    fn expand<S: Simd>(
        &mut self,
        simd: S,
        node: &BoxNode,
        (): (),
        (children, _): (&mut [u32], &mut [()]),
    ) -> usize {
        let met = self.volume.meets(simd, node);
        self.tested += 1;
        // Stores eight entries, whatever the number of hits: the end of a loop over the hits would be
        // mispredicted.
        children.copy_from_slice(&node.nodes_in(simd, met));
        met.count_ones() as usize
    }

    #[inline(always)]
    fn collect<S: Simd>(&mut self, simd: S, node: &BoxNode, (): ()) {
        let met = self.volume.meets(simd, node);
        self.tested += 1;
        let count = self.count as usize;
        self.found[count..count + LANES].copy_from_slice(&node.elements_in(simd, met));
        self.count += met.count_ones();
    }

    #[inline(always)]
    fn room(&self) -> usize {
        (FOUND_MAX - self.count as usize) / LANES
    }
}

impl ElementSearch {
    /// An idle search.
    pub const IDLE: Self = Self {
        traversal: Traversal::ended(()),
        query: ElementQuery {
            volume: ElementVolume::Box(NarrowBox::NOTHING),
            tested: 0,
            count: 0,
            found: [0; FOUND_MAX + LANES],
        },
    };

    /// Starts the search of a chunk of one element, at the root of a non-empty tree.
    #[inline(always)]
    pub fn begin(&mut self, chunk: &Chunk<'_>, tree: &BoxTree) {
        self.query.volume = ElementVolume::new(chunk, tree);
        (self.query.count, self.query.tested) = (0, 0);
        self.traversal.begin(tree, ());
    }

    /// Does one step; returns false if the search has ended or `found` is full.
    #[inline(always)]
    pub fn step<S: Simd>(&mut self, simd: S, tree: &BoxTree) -> bool {
        self.traversal.step(simd, &mut self.query, tree)
    }

    /// Continues until the search ends or `found` is full. Earlier candidates are discarded.
    #[inline(always)]
    pub fn go_on<S: Simd>(&mut self, simd: S, tree: &BoxTree) {
        self.query.count = 0;
        while self.step(simd, tree) {}
    }

    /// Returns true at the end of the search.
    #[inline(always)]
    pub fn has_ended(&self) -> bool {
        self.traversal.has_ended()
    }

    /// Candidates found last.
    #[inline(always)]
    pub fn found(&self) -> impl ExactSizeIterator<Item = Near> {
        self.query.found[..self.query.count as usize].iter().map(|&near| Near(near))
    }

    /// Starts to filter the candidates in place, in their order; returns their number.
    #[inline(always)]
    pub fn begin_keeping(&mut self) -> usize {
        std::mem::take(&mut self.query.count) as usize
    }

    /// Index in the batch of candidate `number`. `keep` may already have overwritten the candidates before
    /// it.
    #[inline(always)]
    pub fn place_of(&self, number: usize) -> u32 {
        self.query.found[number]
    }

    /// Keeps an element, given by its index in the batch. `over_face` is true if it is a triangle of which
    /// only the face can push.
    #[inline(always)]
    pub fn keep(&mut self, place: u32, over_face: bool) {
        self.query.found[self.query.count as usize] = place | if over_face { Near::OVER_FACE } else { 0 };
        self.query.count += 1;
    }

    /// Returns and resets the number of nodes tested.
    #[inline(always)]
    pub fn take_tested(&mut self) -> u64 {
        u64::from(std::mem::take(&mut self.query.tested))
    }
}
