//! What sealing makes of a scene: all that frames read and nothing changes.

mod limits;
mod plan;
mod surface_table;

pub(crate) use limits::Limits;
pub(crate) use plan::Plan;
pub(crate) use surface_table::SurfaceTable;

use crate::energy::account::WrenchCoupling;
use crate::energy::contact::ContactEnergies;
use crate::energy::episodes::PairEnergies;
use crate::state::{ContactKey, block_len};
use pong_geometry::bounding::VolumeTests;

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
}

/// What sealing makes of a scene.
pub(crate) struct Sealed {
    pub group_pairs: Vec<GroupPair>,
    /// The directions of those pairs in which something can be found, in order.
    pub plans: Vec<Plan>,
    /// The movable groups of all pairs, each once.
    pub paired_bodies: Vec<usize>,
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

    /// Size of the largest contact state block, bytes.
    pub fn state_size(&self) -> usize {
        let numbers = self.law_state_len + ContactEnergies::numbers_each(self.coupling);
        let accounts = PairEnergies::block_len(self.account_pairs(), self.delay());
        block_len(self.group_pairs.len(), self.record_capacity, numbers, accounts)
    }

    /// The bodies that hold A and B of a contact.
    pub fn bodies_of(&self, key: &ContactKey) -> (usize, usize) {
        let pair = &self.group_pairs[key.group_pair as usize];
        if key.flipped == 0 { (pair.first, pair.second) } else { (pair.second, pair.first) }
    }
}
