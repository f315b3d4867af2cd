//! Slices of a large mesh: separate pieces of work, so that several threads share it.

use super::side;
use crate::frame::input::motion::Motion;
use crate::seal::{Partner, SolidPair};
use pong_model::{MovableGroup, Solid, SolidNode, SolidTree};

/// Parts above which a solid that is not convex is divided into slices.
const PARTS_MIN: usize = 256;

/// Levels of the tree of a solid above its slices.
const LEVELS: u32 = 4;

/// Number of slices of a solid of A, which are separate work, so that several threads share a large mesh; `None` if it
/// is not divided. A slice is the part of the tree below one node.
pub(crate) fn count(solid: &Solid) -> Option<u32> {
    (solid.tree.len() > PARTS_MIN).then_some(1 << LEVELS)
}

/// Node of a slice.
pub(super) fn node(tree: &SolidTree, slice: u32) -> Option<SolidNode> {
    let half =
        |node: SolidNode, level: u32| node.halves().map(|halves| halves[(slice >> level & 1) as usize]);
    (0..LEVELS).rev().try_fold(tree.root()?, half)
}

/// Returns true if the box around a slice of A meets the partner: the box around a solid, or any plane.
pub(crate) fn is_near(
    (a, b): (&MovableGroup, &MovableGroup),
    pair: &SolidPair,
    slice: u32,
    motion: &Motion,
) -> bool {
    let tree = &a.solids[pair.a as usize].tree;
    let (Partner::Solid(index), Some(own)) = (pair.b, node(tree, slice)) else { return true };
    side::boxes_meet(&motion.x_ba, tree.bound(&own), &b.solids[index as usize].bound)
}
