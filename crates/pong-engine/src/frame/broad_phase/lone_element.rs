//! Which elements of B an element of A by itself may touch: its own box in B's frame, which is much tighter than the turned
//! one of its chunk, or its ball, goes down the trees.

use crate::frame::broad_phase::candidate_pairs::DEPTH_MAX;
use crate::frame::broad_phase::chunk::Chunk;
use crate::report::FrameCounts;
use pong_geometry::simd::{LaneBits, Simd};
use pong_model::box_tree::{BoxNode, BoxTree, Child, NarrowBall, NarrowBox, lanes};

/// Bottom nodes that there is room for; when it is used up their elements are tested before the next ones are looked for.
const BOTTOMS_MAX: usize = 32;

/// The way of one element through one tree of B.
#[derive(Debug)]
pub(crate) struct LoneElement {
    query: Query,
    /// Nodes that wait: the first `depth` of them.
    waiting: [u32; DEPTH_MAX],
    depth: usize,
    /// What was found last: the first `count` of them, in the order in which they are tested.
    bottoms: [Bottom; BOTTOMS_MAX],
    count: usize,
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

/// Elements of B that may be touched, of one bottom node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bottom {
    /// The place in the batch of the node's first element.
    pub first: u32,
    /// Those of it and the next ones that may be touched.
    pub met: LaneBits,
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
        waiting: [0; DEPTH_MAX],
        depth: 0,
        bottoms: [Bottom { first: 0, met: 0 }; BOTTOMS_MAX],
        count: 0,
    };

    /// Begins at the root of a tree that is not empty, with the first element of a chunk.
    #[inline(always)]
    pub fn begin(&mut self, chunk: &Chunk<'_>, tree: &BoxTree) {
        self.query = Query::new(chunk, tree);
        (self.waiting[0], self.depth) = (0, 1);
    }

    /// Goes on through the tree until it is through or there is no more room; whether it is through. What was found before is
    /// gone.
    #[inline(always)]
    pub fn go_on<S: Simd>(&mut self, simd: S, tree: &BoxTree, counts: &mut FrameCounts) -> bool {
        let Self { query, waiting, depth, bottoms, count } = self;
        let (mut found, mut looked_at) = (0, 0);
        let through = loop {
            let Some(top) = depth.checked_sub(1) else { break true };
            if found == BOTTOMS_MAX {
                break false;
            }
            let node = &tree.nodes[waiting[top] as usize];
            *depth = top;
            looked_at += 1;
            let met = query.meets(simd, node);
            if node.is_bottom() {
                bottoms[found] = Bottom { first: node.elements.start, met };
                found += usize::from(met != 0);
                continue;
            }
            for lane in lanes(met) {
                if let Child::Node(below) = node.child(lane) {
                    waiting[*depth] = below;
                    *depth += 1;
                }
            }
        };
        counts.boxes_tested += looked_at;
        *count = found;
        through
    }

    /// What was found last.
    #[inline(always)]
    pub fn bottoms(&self) -> &[Bottom] {
        &self.bottoms[..self.count]
    }
}
