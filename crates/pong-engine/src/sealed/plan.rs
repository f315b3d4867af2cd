//! What is tested of one movable group against another.

use super::LeafFilter;
use pong_geometry::primitive::PrimitiveKind;

/// One direction of a pair of movable groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Direction {
    pub group_pair: u32,
    /// 0 if A is in the pair's first body, 1 if in the second.
    pub flipped: u32,
}

/// What of one movable group as A can touch what of another as B: the same for all pairs of the same two groups of
/// models and filters.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// What an element of A of each kind may cost, ns, roughly; `None` for kinds that nothing of B can touch.
    pub element_ns: [Option<u32>; PrimitiveKind::ALL.len()],
    /// By the kind of A: a bit for every kind of B that it may touch.
    pub touched: [u16; PrimitiveKind::ALL.len()],
    /// A line of A that is shorter goes through nothing of B, m.
    pub least_travel_m: f64,
    /// Greatest distance of anything of A from the origin of its movable group, m.
    pub reach_a_m: f64,
    /// Leaves that are not tested against each other.
    pub filter: Option<Box<LeafFilter>>,
}

impl Plan {
    /// What an element of A may cost, ns; `None` if nothing of B can touch it.
    pub fn element_ns(&self, kind: PrimitiveKind) -> Option<u32> {
        self.element_ns[kind as usize]
    }

    /// Whether anything of these two kinds in A and B is tested: by the table of testers, of two primitives of one
    /// kind only with A in the Object that was named first; or by a registered test.
    pub fn tests(&self, kind_a: PrimitiveKind, kind_b: PrimitiveKind) -> bool {
        self.touched[kind_a as usize] >> kind_b as u16 & 1 == 1
    }

    /// Whether a batch of A is tested against one of B, by their kinds and the groups that hold them.
    pub fn tests_batches(
        &self,
        (a, kind_a): (usize, PrimitiveKind),
        (b, kind_b): (usize, PrimitiveKind),
    ) -> bool {
        self.tests(kind_a, kind_b)
            && !self.filter.as_ref().is_some_and(|filter| filter.keeps_batches_apart(a, b))
    }

    /// Whether anything of B can touch anything of A.
    pub fn finds_something(&self) -> bool {
        self.element_ns.iter().any(Option::is_some)
    }
}
