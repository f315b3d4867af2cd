//! Sealed scene: everything that frames read and that no longer changes.

use super::frame_limits::Limits;
use super::leaf_filter::ObjectFilters;
use super::test_plan::{Direction, Plan};
use crate::energy::account::WrenchCoupling;
use pong_geometry::bounding::VolumeTests;
use std::sync::Arc;

/// A pair of movable groups that are tested against each other.
#[derive(Clone, Copy, Debug)]
pub struct GroupPair {
    /// Index of the pair of Objects ([`PairId`](crate::PairId)).
    pub pair: usize,
    /// The movable group of lower index, whichever Object was named first.
    pub first: usize,
    /// The movable group of higher index.
    pub second: usize,
    /// True if the Object of `first` was named first in its pair. Between two primitives of one kind, A is
    /// the one whose Object was named first.
    pub first_named_first: bool,
    /// Indices of the tables of combined surface values: for `first` as A, and for `second` as A.
    pub tables: [usize; 2],
    /// Indices of the plans of the two directions; [`NO_PLAN`] for a direction without tests.
    pub(crate) plans: [u32; 2],
}

impl GroupPair {
    /// The two movable groups; in front that of the Object that was named first in the pair.
    pub(crate) fn sides(&self) -> [usize; 2] {
        if self.first_named_first { [self.first, self.second] } else { [self.second, self.first] }
    }
}

/// Plan index of a direction in which nothing of A can touch anything of B.
pub(crate) const NO_PLAN: u32 = u32::MAX;

/// A sealed scene.
pub(crate) struct Sealed {
    pub group_pairs: Vec<GroupPair>,
    /// Filters: groups that never touch.
    pub filters: ObjectFilters,
    /// Test plans of the pair directions.
    pub plans: Vec<Plan>,
    /// Movable groups that are in a pair, each once.
    pub paired_bodies: Arc<[usize]>,
    /// True if a ray may hit two movable groups of one Object.
    pub rays_meet_groups: bool,
    pub limits: Limits,
    pub volume_tests: VolumeTests,
    pub contact_capacity: usize,
    /// Capacity in records: contacts that push, and as many that are only remembered.
    pub record_capacity: usize,
    /// Numbers of state per contact for registered friction laws.
    pub law_state_len: usize,
    /// Use of wrenches by the host, if accounts are kept.
    pub coupling: Option<WrenchCoupling>,
    pub hash: u64,
}

impl Sealed {
    /// Number of pairs with energy accounts: all or none.
    pub fn account_pairs(&self) -> usize {
        if self.coupling.is_some() { self.group_pairs.len() } else { 0 }
    }

    /// Delay of the host's wrenches in frames.
    pub fn delay(&self) -> usize {
        self.coupling.map_or(0, WrenchCoupling::delay)
    }

    /// Index of the pair of two movable groups, of which `first` has the lower index. `None` if their Objects
    /// are not paired, or if filters keep all of one apart from all of the other.
    pub fn group_pair_of(&self, first: usize, second: usize) -> Option<usize> {
        self.group_pairs.binary_search_by_key(&(first, second), |pair| (pair.first, pair.second)).ok()
    }

    /// Movable groups A and B of a direction.
    pub fn bodies_of(&self, direction: Direction) -> (usize, usize) {
        let pair = &self.group_pairs[direction.group_pair as usize];
        if direction.flipped == 0 { (pair.first, pair.second) } else { (pair.second, pair.first) }
    }

    /// Directions of a pair that have tests, with their plans.
    pub fn plans_of(&self, group_pair: u32) -> impl Iterator<Item = (&Plan, Direction)> {
        let plans = &self.group_pairs[group_pair as usize].plans;
        [0, 1].into_iter().filter(|&flipped| plans[flipped] != NO_PLAN).map(move |flipped| {
            (&self.plans[plans[flipped] as usize], Direction { group_pair, flipped: flipped as u32 })
        })
    }
}
