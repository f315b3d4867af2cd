//! Which elements of B an element of A by itself may touch: its own box in B's frame, which is much tighter than the turned
//! one of its chunk, or its ball, goes down the trees.
//!
//! Every step down waits for the one before: a node says where the next is. So the steps of one element leave most of a
//! processor idle, and several elements go down together, in turns.

use crate::frame::broad_phase::chunk::Chunk;
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::box_tree::{BoxNode, BoxTree, NarrowBall, NarrowBox};

/// Elements that go together, and their ways through trees: as many as there are lane bits.
pub(crate) const LONE_MAX: usize = LaneBits::BITS as usize;

/// Elements of B that there is room for; when it is used up they are tested before the next ones are looked for.
const FOUND_MAX: usize = 32 * LANES;

/// Levels of nodes of the deepest tree: of 2³¹ elements.
const LEVELS_MAX: usize = 11;

/// Nodes of one level whose children are looked for in one step.
const AT_ONCE: usize = 8;

/// The way of one element through one tree of B.
///
/// A step asks up to eight nodes of one level. The last ones that were found are asked first, so what is found is in the same
/// order as if they were asked one by one.
// In this order what most ways need is on few cache lines.
#[derive(Debug)]
#[repr(C, align(64))]
pub(crate) struct LoneElement {
    query: Query,
    /// The level in hand, from the root down, and that of the bottom nodes.
    level: u32,
    bottom_level: u32,
    /// Nodes asked that nobody has counted yet.
    asked: u32,
    /// How many elements were found last.
    count: u32,
    /// Where the nodes of every level that wait begin and end, from the root's to those of the level in hand. Apart: what is
    /// read together should have been written together.
    starts: [u16; LEVELS_MAX],
    ends: [u16; LEVELS_MAX],
    /// Nodes that wait: of every level as many as what is asked at once has children, since then none of that level waits.
    nodes: [u32; LEVELS_MAX * AT_ONCE * LANES],
    /// What was found last, in the order in which they are tested. Eight are written at a time, of which the last may not count.
    found: [u32; FOUND_MAX + LANES],
}

/// What boxes of a tree are compared with.
#[derive(Clone, Copy, Debug)]
enum Query {
    Box(NarrowBox),
    /// A point or a sphere: its box would say no more.
    Ball(NarrowBall),
    /// An ellipsoid, which is in both.
    BoxAndBall(NarrowBox, NarrowBall),
}

/// An element of B that may be touched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near(u32);

impl Near {
    const OVER_FACE: u32 = 1 << 31;

    /// The place in the batch. A tree has room for no more elements than leave a bit.
    #[inline]
    pub fn place(self) -> usize {
        (self.0 & !Self::OVER_FACE) as usize
    }

    /// Of a triangle that was narrowed down: whether the face alone may push.
    #[inline]
    pub fn over_face(self) -> bool {
        self.0 & Self::OVER_FACE != 0
    }
}

impl Query {
    #[inline(always)]
    fn new(chunk: &Chunk<'_>, tree: &BoxTree) -> Self {
        match chunk.lone_ball(tree) {
            // A ball that is near everything is near empty boxes, too.
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
    /// On no way.
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

    /// Begins at the root of a tree that is not empty, with the first element of a chunk.
    #[inline(always)]
    pub fn begin(&mut self, chunk: &Chunk<'_>, tree: &BoxTree) {
        self.query = Query::new(chunk, tree);
        (self.level, self.bottom_level) = (0, tree.levels);
        (self.nodes[0], self.starts[0], self.ends[0]) = (0, 0, 1);
        (self.count, self.asked) = (0, 0);
    }

    /// Goes on until it is through or there is no more room. What was found before is gone.
    #[inline(always)]
    pub fn go_on<S: Simd>(&mut self, simd: S, tree: &BoxTree) {
        self.count = 0;
        while self.step(simd, tree) {}
    }

    /// Whether nothing is left to be found.
    #[inline(always)]
    pub fn is_through(&self) -> bool {
        self.level == 0 && self.ends[0] == 0
    }

    /// One step; whether there was any to make: it may be through, or there may be no more room.
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
            // Eight places are written, whatever is found: which boxes are met follows no pattern that a processor could foresee.
            self.nodes[past..past + LANES].copy_from_slice(&node.nodes_in(simd, met));
            past += met.count_ones() as usize;
        }
        self.level += 1;
        (self.starts[level + 1], self.ends[level + 1]) = (end as u16, past as u16);
        true
    }

    /// Goes up to the lowest level of which nodes wait; whether there is any.
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

    /// What was found last.
    #[inline(always)]
    pub fn found(&self) -> impl ExactSizeIterator<Item = Near> {
        self.found[..self.count as usize].iter().map(|&near| Near(near))
    }

    /// Begins to keep some of what was found last, in its order; answers how many there are.
    #[inline(always)]
    pub fn begin_keeping(&mut self) -> usize {
        std::mem::take(&mut self.count) as usize
    }

    /// The place of what was found in a place among the others. Those that came before may be kept meanwhile.
    #[inline(always)]
    pub fn place_of(&self, number: usize) -> u32 {
        self.found[number]
    }

    /// Keeps an element by its place; `over_face`: whether the face alone may push.
    #[inline(always)]
    pub fn keep(&mut self, place: u32, over_face: bool) {
        self.found[self.count as usize] = place | if over_face { Near::OVER_FACE } else { 0 };
        self.count += 1;
    }

    /// How many nodes were asked since this was asked last.
    #[inline(always)]
    pub fn take_asked(&mut self) -> u64 {
        u64::from(std::mem::take(&mut self.asked))
    }
}
