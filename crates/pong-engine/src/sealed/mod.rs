//! What sealing makes of a scene: all that frames read and nothing changes.

mod filters;
mod limits;
mod plan;
mod surface_table;

pub(crate) use filters::{LeafFilter, ObjectFilters};
pub(crate) use limits::Limits;
pub(crate) use plan::{Direction, Plan};
pub(crate) use surface_table::SurfaceTable;

use crate::energy::account::WrenchCoupling;
use pong_geometry::bounding::VolumeTests;
use std::sync::Arc;

/// A pair of movable groups that are tested against each other.
#[derive(Clone, Copy, Debug)]
pub struct GroupPair {
    /// The pair of Objects: index of its [`PairId`](crate::PairId).
    pub pair: usize,
    /// The lower of the two bodies, whatever the order of pairing.
    pub first: usize,
    /// The higher.
    pub second: usize,
    /// Whether the first body's Object was named first: it is A among primitives of one kind.
    pub first_named_first: bool,
    /// Numbers of the tables of combined surface values: with A in the first body, with A in the second.
    pub tables: [usize; 2],
    /// Numbers of the plans of its two directions; [`NO_PLAN`] where nothing can be found.
    pub(crate) plans: [u32; 2],
}

/// In place of a plan: nothing of A can touch anything of B.
pub(crate) const NO_PLAN: u32 = u32::MAX;

/// What sealing makes of a scene.
pub(crate) struct Sealed {
    pub group_pairs: Vec<GroupPair>,
    /// Groups that never touch.
    pub filters: ObjectFilters,
    /// What is tested in the directions of those pairs.
    pub plans: Vec<Plan>,
    /// The movable groups of all pairs, each once.
    pub paired_bodies: Arc<[usize]>,
    /// Whether a ray may hit two movable groups of one Object.
    pub rays_meet_groups: bool,
    pub limits: Limits,
    pub volume_tests: VolumeTests,
    pub contact_capacity: usize,
    /// Records: contacts, and as many that are only remembered.
    pub record_capacity: usize,
    /// Numbers that registered friction laws remember of a contact.
    pub law_state_len: usize,
    /// How the host uses wrenches, if accounts are kept.
    pub coupling: Option<WrenchCoupling>,
    pub hash: u64,
}

impl Sealed {
    /// Pairs of movable groups of which accounts are kept: all or none.
    pub fn account_pairs(&self) -> usize {
        if self.coupling.is_some() { self.group_pairs.len() } else { 0 }
    }

    /// How many frames late the host's wrenches come.
    pub fn delay(&self) -> usize {
        self.coupling.map_or(0, WrenchCoupling::delay)
    }

    /// The bodies that hold A and B.
    pub fn bodies_of(&self, direction: Direction) -> (usize, usize) {
        let pair = &self.group_pairs[direction.group_pair as usize];
        if direction.flipped == 0 { (pair.first, pair.second) } else { (pair.second, pair.first) }
    }

    /// The directions of a pair in which something can be found, with what is tested.
    pub fn plans_of(&self, group_pair: u32) -> impl Iterator<Item = (&Plan, Direction)> {
        let plans = &self.group_pairs[group_pair as usize].plans;
        [0, 1].into_iter().filter(|&flipped| plans[flipped] != NO_PLAN).map(move |flipped| {
            (&self.plans[plans[flipped] as usize], Direction { group_pair, flipped: flipped as u32 })
        })
    }
}
