//! Transfer of contact state from one world to another that has some of its Objects.

use super::memory::{ContactMemory, Remembered};
use super::record::{ContactKey, ContactRecord, ContactRole};
use crate::energy::episodes::PairEnergies;
use pong_geometry::Pose;

/// Correspondence between two worlds.
#[derive(Clone, Copy)]
pub(crate) struct Counterparts<'a> {
    /// Numbers in the first world of the movable groups of the second.
    pub bodies: &'a [Option<usize>],
    /// Numbers in the first world of the pairs of Objects of the second.
    pub pairs: &'a [Option<usize>],
    /// Numbers in the second world of the pairs of movable groups of the first, in ascending order.
    pub group_pairs: &'a [Option<u32>],
}

/// Contacts that went on, and those that were left behind.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CarryOutcome {
    pub contacts: usize,
    pub contacts_left: usize,
    /// Energy stored in those that were left, J.
    pub energy_left: f64,
}

impl ContactMemory {
    /// Number of records whose pair of movable groups exists in the other world.
    pub fn records_to_carry(&self, group_pairs: &[Option<u32>]) -> usize {
        self.records.iter().filter(|record| group_pairs[record.key.group_pair as usize].is_some()).count()
    }

    /// Replaces everything by the contact state of another world, as far as its pairs exist here. There must be room.
    /// `elsewhere` holds the poses of movable groups that the other world knows none of, `frame` is the number that the poses
    /// get if a commit of all pairs made them. With a ledger, energy stored in contacts left behind counts as dissipated.
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
        self.records.expect(from.records.len());
        // Laws of new Objects may remember more numbers, and those of Objects that are gone may have remembered more.
        let mut law_state = vec![0.0; self.law_state_len];
        let shared = self.law_state_len.min(from.law_state_len);
        for Remembered { record, law_state: earlier, energy } in from.iter() {
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
            let pushed = self.push(&Remembered { record, law_state: &law_state, energy });
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
    /// Copies the energies of pairs that exist here; all others begin at zero.
    fn carry(&mut self, from: &Self, group_pairs: &[Option<u32>]) {
        let delay = self.delay;
        *self = Self::new(self.pairs.len(), delay);
        // Neither world keeps accounts, or both do.
        for (old, energy) in from.pairs.iter().enumerate() {
            if let Some(new) = group_pairs[old].map(|new| new as usize) {
                self.pairs[new] = *energy;
                self.delayed[new * delay..(new + 1) * delay]
                    .copy_from_slice(&from.delayed[old * delay..(old + 1) * delay]);
            }
        }
    }
}
