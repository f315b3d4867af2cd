//! Tree traversal for a single element of A. The query is its own box in B's frame, which is much tighter
//! than the rotated box of its chunk, or its bounding sphere.
//!
//! Each step depends on the one before, because a node holds the indices of the next. Several elements are
//! therefore advanced in turns, to hide the latency.

use crate::frame::broad_phase::chunk::Chunk;
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::box_tree::{BoxNode, BoxTree, NarrowBall, NarrowBox};

/// Traversals that run together: one per bit of `LaneBits`.
pub(crate) const LONE_MAX: usize = LaneBits::BITS as usize;

/// Capacity for elements of B; when it is used up they are tested before the traversal continues.
const FOUND_MAX: usize = 32 * LANES;

/// Levels of the deepest tree (2³¹ elements).
const LEVELS_MAX: usize = 11;

/// Nodes of one level that one step expands.
const AT_ONCE: usize = 8;

/// Traversal of one tree of B by one element.
///
/// A step tests up to eight nodes of one level. It takes the nodes found last first, so the order of the
/// results is that of a node-by-node traversal.
// Field order: the fields that most traversals use share few cache lines.
#[derive(Debug)]
#[repr(C, align(64))]
pub(crate) struct LoneElement {
    query: Query,
    /// Current level, 0 at the root, and the level of the bottom nodes.
    level: u32,
    bottom_level: u32,
    /// Nodes tested since the last `take_asked`.
    asked: u32,
    /// Number of valid entries in `found`.
    count: u32,
    /// Ranges of pending nodes per level, from the root to the current level. Starts and ends are separate
    /// arrays: a load that spans two earlier stores would stall.
    starts: [u16; LEVELS_MAX],
    ends: [u16; LEVELS_MAX],
    /// Pending nodes. A level has room for the children of one step, since a level is expanded again only
    /// after it has become empty.
    nodes: [u32; LEVELS_MAX * AT_ONCE * LANES],
    /// Candidates found last, in test order. Written eight at a time; entries beyond `count` are unused.
    found: [u32; FOUND_MAX + LANES],
}

/// Query volume that is compared with the boxes of a tree.
#[derive(Clone, Copy, Debug)]
enum Query {
    Box(NarrowBox),
    /// A point or a sphere; its box would not reject more.
    Ball(NarrowBall),
    /// An ellipsoid: inside both its box and its bounding sphere.
    BoxAndBall(NarrowBox, NarrowBall),
}

/// Candidate element of B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near(u32);

impl Near {
    const OVER_FACE: u32 = 1 << 31;

    /// Index in the batch. Trees are small enough that the top bit is free for the flag.
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

impl Query {
    #[inline(always)]
    fn new(chunk: &Chunk<'_>, tree: &BoxTree) -> Self {
        match chunk.lone_ball(tree) {
            // An unbounded sphere would also meet the empty boxes of unused lanes; such a query needs its box
            // as well.
            Some(ball) if chunk.is_of_balls() && ball.is_bounded() => Self::Ball(ball),
            Some(ball) => Self::BoxAndBall(chunk.lone_box(tree), ball),
            None => Self::Box(chunk.lone_box(tree)),
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

impl LoneElement {
    /// An idle traversal.
    pub const NONE: Self = Self {
        query: Query::Box(NarrowBox::NOTHING),
        level: 0,
        bottom_level: 0,
        starts: [0; LEVELS_MAX],
        ends: [0; LEVELS_MAX],
        nodes: [0; LEVELS_MAX * AT_ONCE * LANES],
        found: [0; FOUND_MAX + LANES],
        count: 0,
        asked: 0,
    };

    /// Starts at the root of a non-empty tree with the first element of a chunk.
    #[inline(always)]
    pub fn begin(&mut self, chunk: &Chunk<'_>, tree: &BoxTree) {
        self.query = Query::new(chunk, tree);
        (self.level, self.bottom_level) = (0, tree.levels);
        (self.nodes[0], self.starts[0], self.ends[0]) = (0, 0, 1);
        (self.count, self.asked) = (0, 0);
    }

    /// Continues until the traversal ends or `found` is full. Earlier candidates are discarded.
    #[inline(always)]
    pub fn go_on<S: Simd>(&mut self, simd: S, tree: &BoxTree) {
        self.count = 0;
        while self.step(simd, tree) {}
    }

    /// Returns true at the end of the traversal.
    #[inline(always)]
    pub fn is_through(&self) -> bool {
        self.level == 0 && self.ends[0] == 0
    }

    /// Does one step; returns false if the traversal has ended or `found` is full.
    #[inline(always)]
    pub fn step<S: Simd>(&mut self, simd: S, tree: &BoxTree) -> bool {
        let level = self.level as usize;
        let (start, end) = (usize::from(self.starts[level]), usize::from(self.ends[level]));
        let waits = end - start;
        if waits == 0 {
            return self.go_up();
        }
        let at_bottom = self.level == self.bottom_level;
        let room = (FOUND_MAX - self.count as usize) / LANES;
        let takes = waits.min(if at_bottom { room } else { AT_ONCE });
        let left = end - takes;
        self.ends[level] = left as u16;
        self.asked += takes as u32;
        if at_bottom {
            for place in (left..end).rev() {
                let node = &tree.nodes[self.nodes[place] as usize];
                let met = self.query.meets(simd, node);
                let count = self.count as usize;
                self.found[count..count + LANES].copy_from_slice(&node.elements_in(simd, met));
                self.count += met.count_ones();
            }
            return level > 0 && takes > 0;
        }
        let mut past = end;
        for place in left..end {
            let node = &tree.nodes[self.nodes[place] as usize];
            let met = self.query.meets(simd, node);
            // Always stores eight entries: a loop over the hits would be mispredicted.
            self.nodes[past..past + LANES].copy_from_slice(&node.nodes_in(simd, met));
            past += met.count_ones() as usize;
        }
        self.level += 1;
        (self.starts[level + 1], self.ends[level + 1]) = (end as u16, past as u16);
        true
    }

    /// Goes up to the nearest level that has pending nodes; returns false if there is none.
    #[inline(always)]
    fn go_up(&mut self) -> bool {
        while self.level > 0 {
            self.level -= 1;
            let level = self.level as usize;
            if self.starts[level] < self.ends[level] {
                return true;
            }
        }
        false
    }

    /// Candidates found last.
    #[inline(always)]
    pub fn found(&self) -> impl ExactSizeIterator<Item = Near> {
        self.found[..self.count as usize].iter().map(|&near| Near(near))
    }

    /// Starts to filter the candidates in place, in their order; returns their number.
    #[inline(always)]
    pub fn begin_keeping(&mut self) -> usize {
        std::mem::take(&mut self.count) as usize
    }

    /// Batch index of candidate `number`. Candidates before it may already have been overwritten by `keep`.
    #[inline(always)]
    pub fn place_of(&self, number: usize) -> u32 {
        self.found[number]
    }

    /// Keeps an element by its batch index; `over_face`: only its face can push.
    #[inline(always)]
    pub fn keep(&mut self, place: u32, over_face: bool) {
        self.found[self.count as usize] = place | if over_face { Near::OVER_FACE } else { 0 };
        self.count += 1;
    }

    /// Returns and resets the number of nodes tested.
    #[inline(always)]
    pub fn take_asked(&mut self) -> u64 {
        u64::from(std::mem::take(&mut self.asked))
    }
}
