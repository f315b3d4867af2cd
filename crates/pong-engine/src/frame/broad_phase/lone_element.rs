//! Which elements of B an element of A by itself may touch: its own box in B's frame, which is much tighter than the turned
//! one of its chunk, goes down the trees.

use crate::frame::broad_phase::candidate_pairs::DEPTH_MAX;
use crate::frame::broad_phase::chunk::Chunk;
use crate::report::FrameCounts;
use pong_geometry::simd::{LANES, Simd};
use pong_model::box_tree::{BoxTree, Child, NarrowBall, NarrowBox, lanes};

/// Elements that there is room for; when it is used up these are tested before the next ones are looked for.
const PLACES_MAX: usize = 64;

/// The way of one element through one tree of B.
#[derive(Debug)]
pub(crate) struct LoneElement {
    query: NarrowBox,
    /// Around a ball, which lies within the box.
    ball: Option<NarrowBall>,
    /// Nodes that wait: the first `depth` of them.
    waiting: [u32; DEPTH_MAX],
    depth: usize,
    /// Places in the batch of elements that may be touched: the first `count` of them, in the order in which they are tested.
    places: [u32; PLACES_MAX],
    count: usize,
}

impl LoneElement {
    /// On no way.
    pub const NONE: Self = Self {
        query: NarrowBox::NOTHING,
        ball: None,
        waiting: [0; DEPTH_MAX],
        depth: 0,
        places: [0; PLACES_MAX],
        count: 0,
    };

    /// Begins at the root of a tree that is not empty, with the first element of a chunk.
    #[inline(always)]
    pub fn begin(&mut self, chunk: &Chunk<'_>, tree: &BoxTree) {
        (self.query, self.ball) = chunk.first_narrowed(tree);
        (self.waiting[0], self.depth) = (0, 1);
    }

    /// Goes on through the tree until it is through or there is no more room; whether it is through. What was there before
    /// is gone.
    #[inline(always)]
    pub fn go_on<S: Simd>(&mut self, simd: S, tree: &BoxTree, counts: &mut FrameCounts) -> bool {
        let Self { query, ball, waiting, depth, places, count } = self;
        let (mut found, mut looked_at) = (0, 0);
        let through = loop {
            let Some(top) = depth.checked_sub(1) else { break true };
            if found + LANES > PLACES_MAX {
                break false;
            }
            let node = &tree.nodes[waiting[top] as usize];
            *depth = top;
            looked_at += 1;
            let mut met = node.boxes.met_by(simd, query);
            if let Some(ball) = ball {
                met &= node.boxes.near(simd, ball);
            }
            for lane in lanes(met) {
                match node.child(lane) {
                    Child::Element(place) => {
                        places[found] = place;
                        found += 1;
                    }
                    Child::Node(below) => {
                        waiting[*depth] = below;
                        *depth += 1;
                    }
                }
            }
        };
        counts.boxes_tested += looked_at;
        *count = found;
        through
    }

    /// The places in the batch of elements that may be touched.
    #[inline(always)]
    pub fn places(&self) -> &[u32] {
        &self.places[..self.count]
    }
}
