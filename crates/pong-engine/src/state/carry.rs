//! Transfer of contact state to another world that has some of the same Objects.

use super::memory::{ContactMemory, RecordEntry};
use super::record::{ContactKey, ContactRecord, ContactRole};
use crate::energy::episodes::PairEnergies;
use pong_geometry::Pose;

/// Correspondence between the Objects of two worlds.
#[derive(Clone, Copy)]
pub(crate) struct Counterparts<'a> {
    /// For each movable group of the second world, its index in the first.
    pub bodies: &'a [Option<usize>],
    /// For each pair of Objects of the second world, its index in the first.
    pub pairs: &'a [Option<usize>],
    /// For each pair of movable groups of the first world, its index in the second; increasing.
    pub group_pairs: &'a [Option<u32>],
}

/// Contacts that continue, and contacts left behind.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CarryOutcome {
    pub contacts: usize,
    pub contacts_left: usize,
    /// Energy stored in the contacts left behind, J.
    pub energy_left: f64,
}

impl ContactMemory {
    /// Number of records whose pair of movable groups exists in the other world.
    pub fn records_to_carry(&self, group_pairs: &[Option<u32>]) -> usize {
        self.records.iter().filter(|record| group_pairs[record.key.group_pair as usize].is_some()).count()
    }

    /// Replaces everything by the contact state of another world, as far as its pairs exist here; there must
    /// be room for it.
    ///
    /// `elsewhere` holds poses for movable groups without a pose in the other world. `frame` is the frame
    /// number that the poses get if they are from a commit of all pairs. With a ledger, the energy of
    /// contacts left behind counts as dissipated.
    pub fn carry(
        &mut self,
        from: &Self,
        counterparts: &Counterparts<'_>,
        (elsewhere, frame): (&[Pose], u64),
        keeps_ledger: bool,
    ) -> CarryOutcome {
        self.poses.carry(&from.poses, (counterparts.bodies, counterparts.pairs), elsewhere, frame);
        self.pair_energies.carry(&from.pair_energies, counterparts.group_pairs);
        let mut carried = CarryOutcome::default();
        let pushes = |record: &ContactRecord| record.role == ContactRole::Active;
        self.clear_records();
        self.records.size_hints(from.records.len());
        // Laws of new Objects may have more state values, and those of removed Objects may have had more, so
        // only as many as both worlds store are copied.
        let mut law_state = vec![0.0; self.law_state_len];
        let shared = self.law_state_len.min(from.law_state_len);
        for RecordEntry { record, law_state: earlier, energy } in from.iter() {
            let Some(group_pair) = counterparts.group_pairs[record.key.group_pair as usize] else {
                if pushes(&record) {
                    carried.contacts_left += 1;
                    carried.energy_left += record.stored;
                }
                continue;
            };
            carried.contacts += usize::from(pushes(&record));
            law_state[..shared].copy_from_slice(&earlier[..shared]);
            let record = ContactRecord { key: ContactKey { group_pair, ..record.key }, ..record };
            let pushed = self.push(&RecordEntry { record, law_state: &law_state, energy });
            pushed.expect("room was asked for before");
        }
        (self.work, self.dissipated) = (from.work, from.dissipated);
        if keeps_ledger && carried.contacts_left > 0 {
            self.dissipated += carried.energy_left;
        }
        carried
    }
}

impl PairEnergies {
    /// Copies the energies of pairs that exist here; all others start at zero.
    fn carry(&mut self, from: &Self, group_pairs: &[Option<u32>]) {
        let delay = self.delay;
        *self = Self::new(self.pairs.len(), delay);
        // Either both worlds keep accounts, or neither does.
        for (old, energy) in from.pairs.iter().enumerate() {
            if let Some(new) = group_pairs[old].map(|new| new as usize) {
                self.pairs[new] = *energy;
                self.delayed[new * delay..(new + 1) * delay]
                    .copy_from_slice(&from.delayed[old * delay..(old + 1) * delay]);
            }
        }
    }
}
