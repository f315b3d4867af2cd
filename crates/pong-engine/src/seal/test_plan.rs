//! Test plans between movable groups.

use super::leaf_filter::LeafFilter;
use super::solids::SolidPair;
use pong_geometry::primitive::PrimitiveKind;

/// One direction of a pair of movable groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Direction {
    pub group_pair: u32,
    /// 0 if A is the first movable group of the group pair, 1 if it is the second.
    pub flipped: u32,
}

/// Test plan of one movable group as A against another as B. One plan serves all pairs of the same two groups
/// of models with the same filters, in which A's Object was named first in all or in none.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// Rough cost of an element of A per kind, ns; `None` for kinds that nothing of B can touch.
    pub element_ns: [Option<u32>; PrimitiveKind::ALL.len()],
    /// Per kind of A, a bit for every kind of B that it may touch.
    pub touched: [u16; PrimitiveKind::ALL.len()],
    /// Shortest displacement with which A may pass through something of B, m.
    pub least_travel_m: f64,
    /// Greatest distance of anything of A from the origin of its movable group, m.
    pub reach_a_m: f64,
    /// Solids of A and what they may touch.
    pub solids: Vec<SolidPair>,
    /// Shortest displacement with which solids of A may pass through solids of B, m.
    pub least_travel_of_solids_m: f64,
    /// Greatest distance of a vertex of these solids of A from the origin of its movable group, m.
    pub reach_of_solids_a_m: f64,
    /// Leaves that are not tested against each other.
    pub filter: Option<Box<LeafFilter>>,
}

impl Plan {
    /// Rough cost of an element of A, ns; `None` if nothing of B can touch it.
    pub fn element_ns(&self, kind: PrimitiveKind) -> Option<u32> {
        self.element_ns[kind as usize]
    }

    /// Returns true if primitives of `kind_a` in A and of `kind_b` in B are tested, by the tester table or by
    /// a test that the host has registered. Two primitives of one kind are tested only in the direction in
    /// which A's Object was named first.
    pub fn tests(&self, kind_a: PrimitiveKind, kind_b: PrimitiveKind) -> bool {
        self.touched[kind_a as usize] >> kind_b as u16 & 1 == 1
    }

    /// Returns true if a batch of A is tested against one of B, by kinds and filters.
    pub fn tests_batches(
        &self,
        (a, kind_a): (usize, PrimitiveKind),
        (b, kind_b): (usize, PrimitiveKind),
    ) -> bool {
        self.tests(kind_a, kind_b)
            && !self.filter.as_ref().is_some_and(|filter| filter.keeps_batches_apart(a, b))
    }

    /// Returns true if anything of B can touch anything of A.
    pub fn finds_something(&self) -> bool {
        self.tests_elements() || !self.solids.is_empty()
    }

    /// Returns true if any contact tester applies to elements of A and B.
    pub fn tests_elements(&self) -> bool {
        self.element_ns.iter().any(Option::is_some)
    }
}
