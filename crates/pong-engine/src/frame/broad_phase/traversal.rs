//! Traversal of a box tree of B by volumes of A.
//!
//! A step expands up to eight nodes of one level. It cannot begin before the step above it has loaded the
//! indices of these nodes. So several traversals are advanced in turns: while one waits for memory, the
//! others proceed.

use pong_geometry::simd::{LANES, Simd};
use pong_model::box_tree::{BoxNode, BoxTree};

/// Levels of the deepest tree (2³¹ elements).
const LEVELS_MAX: usize = 11;

/// Nodes of one level that one step expands.
const AT_ONCE: usize = 8;

/// Pending nodes of all levels. A level has room for the children of one step, since a level is expanded
/// again only after the level below it has become empty.
const PENDING_MAX: usize = LEVELS_MAX * AT_ONCE * LANES;

/// Volumes of A that a traversal compares with the boxes of a tree, with the list of the elements found.
pub(crate) trait Query {
    /// Set of volumes that reach a node; `()` for a query of a single volume.
    type Volumes: Copy;

    /// Finds the children of an inner node that some of `volumes` reach. Writes their indices, and the
    /// volumes that reach each of them, to the front of the two slices, which have room for eight; returns
    /// their number.
    fn expand<S: Simd>(
        &mut self,
        simd: S,
        node: &BoxNode,
        volumes: Self::Volumes,
        children: (&mut [u32], &mut [Self::Volumes]),
    ) -> usize;

    /// Adds the elements of a bottom node that some of `volumes` reach to the list.
    fn collect<S: Simd>(&mut self, simd: S, node: &BoxNode, volumes: Self::Volumes);

    /// Number of bottom nodes for whose elements the list has room.
    fn room(&self) -> usize;
}

/// Pending nodes of a traversal that is under way. Elements are found in the order of a depth-first traversal
/// that visits the last child of a node first.
#[derive(Debug)]
#[repr(C)]
pub(crate) struct Traversal<V> {
    /// Current level, 0 at the root, and the level of the bottom nodes.
    level: u32,
    bottom_level: u32,
    /// Ranges of pending nodes per level, from the root to the current level. Starts and ends are separate
    /// arrays, because a load that spans two earlier stores would stall.
    starts: [u16; LEVELS_MAX],
    ends: [u16; LEVELS_MAX],
    /// Pending nodes, and the volumes that reach each of them.
    nodes: [u32; PENDING_MAX],
    volumes: [V; PENDING_MAX],
}

impl<V: Copy> Traversal<V> {
    /// An ended traversal; `fill` is any value.
    pub const fn ended(fill: V) -> Self {
        Self {
            level: 0,
            bottom_level: 0,
            starts: [0; LEVELS_MAX],
            ends: [0; LEVELS_MAX],
            nodes: [0; PENDING_MAX],
            volumes: [fill; PENDING_MAX],
        }
    }

    /// Starts at the root of a non-empty tree.
    #[inline(always)]
    pub fn begin(&mut self, tree: &BoxTree, volumes: V) {
        (self.level, self.bottom_level) = (0, tree.levels);
        (self.nodes[0], self.starts[0], self.ends[0]) = (0, 0, 1);
        self.volumes[0] = volumes;
    }

    /// Ends the traversal early.
    #[inline(always)]
    pub fn end(&mut self) {
        (self.level, self.ends[0]) = (0, 0);
    }

    /// Returns true at the end of the traversal.
    #[inline(always)]
    pub fn has_ended(&self) -> bool {
        self.level == 0 && self.ends[0] == 0
    }

    /// Does one step; returns false if the traversal has ended or the query's list is full.
    #[inline(always)]
    pub fn step<S: Simd>(&mut self, simd: S, query: &mut impl Query<Volumes = V>, tree: &BoxTree) -> bool {
        let level = self.level as usize;
        let (start, end) = (usize::from(self.starts[level]), usize::from(self.ends[level]));
        let at_bottom = self.level == self.bottom_level;
        let takes = (end - start).min(if at_bottom { query.room() } else { AT_ONCE });
        let left = end - takes;
        self.ends[level] = left as u16;
        let mut past = end;
        if at_bottom {
            for place in (left..end).rev() {
                query.collect(simd, &tree.nodes[self.nodes[place] as usize], self.volumes[place]);
            }
        } else {
            for place in left..end {
                let (node, volumes) = (&tree.nodes[self.nodes[place] as usize], self.volumes[place]);
                let children = (&mut self.nodes[past..past + LANES], &mut self.volumes[past..past + LANES]);
                past += query.expand(simd, node, volumes, children);
            }
        }
        if past > end {
            self.level += 1;
            (self.starts[level + 1], self.ends[level + 1]) = (end as u16, past as u16);
            return true;
        }
        if left > start { takes > 0 } else { self.go_up() }
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
}
