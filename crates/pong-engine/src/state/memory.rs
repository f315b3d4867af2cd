//! Contact state: contact records, committed poses and energies.

use super::poses::CommittedPoses;
use super::record::{ContactKey, ContactRecord, ContactRole};
use super::records::{RecordRange, Records, RecordsOfKey};
use crate::energy::contact::{ContactEnergies, ContactEnergyRef};
use crate::energy::episodes::PairEnergies;
use pong_arena::{Full, Table};

/// Record of a contact, with its friction-law state and its energies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RecordEntry<'a> {
    pub record: ContactRecord,
    /// State of its registered friction law; empty for other laws.
    pub law_state: &'a [f64],
    /// Its energies, if the world keeps accounts.
    pub energy: Option<ContactEnergyRef<'a>>,
}

/// Complete contact state of a world. Its size is fixed at creation; no later call allocates.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ContactMemory {
    /// Poses of the movable groups at the last commit of every pair of Objects.
    pub poses: CommittedPoses,
    /// Pairs of movable groups.
    pub group_pairs: usize,
    /// Ordered by key, then piece and feature.
    pub records: Records,
    /// State of registered friction laws, `law_state_len` numbers per record.
    pub law_state: Table<f64>,
    /// Energies of the records; none unless the world keeps accounts.
    pub energies: ContactEnergies,
    /// Energies of pairs; none unless the world keeps accounts.
    pub pair_energies: PairEnergies,
    /// Numbers per record in `law_state`.
    pub law_state_len: usize,
    /// Energy dissipated or dropped since the world began, J.
    pub dissipated: f64,
    /// Work done on the bodies since the world began, J.
    pub work: f64,
}

impl ContactMemory {
    /// Empty memory with room for this many records, each with `law_state_len` numbers.
    pub fn with_capacity(
        poses: CommittedPoses,
        group_pairs: usize,
        records: usize,
        law_state_len: usize,
    ) -> Self {
        Self {
            poses,
            group_pairs,
            records: Records::with_capacity(records),
            law_state: Table::with_capacity(records * law_state_len, 0.0),
            law_state_len,
            energies: ContactEnergies::default(),
            pair_energies: PairEnergies::default(),
            dissipated: 0.0,
            work: 0.0,
        }
    }

    /// Adds the energies.
    pub fn with_energies(self, energies: ContactEnergies, pair_energies: PairEnergies) -> Self {
        Self { energies, pair_energies, ..self }
    }

    /// Numbers stored with each record in a block.
    pub fn numbers_each(&self) -> usize {
        self.law_state_len + self.energies.numbers()
    }

    /// Appends a record; keys must come in order.
    ///
    /// # Errors
    /// [`Full`] if there is no room; the memory is unchanged.
    #[inline]
    pub fn push(&mut self, entry: &RecordEntry<'_>) -> Result<(), Full> {
        let RecordEntry { record, law_state, energy } = entry;
        self.push_with(law_state, *energy, |slot| *slot = *record)
    }

    /// Appends a record that `write` writes in place; otherwise as [`push`](Self::push).
    ///
    /// # Errors
    /// As [`push`](Self::push).
    #[inline(always)]
    pub fn push_with(
        &mut self,
        law_state: &[f64],
        energy: Option<ContactEnergyRef<'_>>,
        write: impl FnOnce(&mut ContactRecord),
    ) -> Result<(), Full> {
        debug_assert_eq!(law_state.len(), self.law_state_len);
        self.records.push_with(write)?;
        if !law_state.is_empty() {
            self.law_state.extend_from_slice(law_state)?;
        }
        self.energies.push(energy)
    }

    /// Drops all records and keeps everything else.
    pub fn clear_records(&mut self) {
        self.records.clear();
        self.law_state.clear();
        self.energies.clear();
    }

    /// Copies another memory of the same world.
    pub fn copy_from(&mut self, other: &Self) {
        self.poses.copy_from(&other.poses);
        self.clear_records();
        let fits = self
            .records
            .extend(&other.records)
            .and_then(|()| self.law_state.extend_from_slice(&other.law_state));
        fits.expect("memories of one world have room for the same");
        self.energies.copy_from(&other.energies);
        self.pair_energies.copy_from(&other.pair_energies);
        (self.work, self.dissipated) = (other.work, other.dissipated);
    }

    /// All records with their data, in order.
    pub fn iter(&self) -> impl Iterator<Item = RecordEntry<'_>> + Clone {
        self.records.iter().enumerate().map(|(index, record)| RecordEntry {
            record: *record,
            law_state: self.law_state_of(index),
            energy: self.energies.get(index),
        })
    }

    /// Records of a key.
    #[inline]
    pub fn under(&self, key: &ContactKey) -> RecordsOfKey<'_> {
        let range = self.records.of_key(key);
        self.at(range)
    }

    /// Records of a range from an earlier search.
    #[inline(always)]
    pub fn at(&self, range: RecordRange) -> RecordsOfKey<'_> {
        RecordsOfKey { range, records: self.records.in_range(&range) }
    }

    /// Friction-law state of a record.
    pub fn law_state_of(&self, record: usize) -> &[f64] {
        &self.law_state[record * self.law_state_len..(record + 1) * self.law_state_len]
    }

    /// Clears the history of the pairs of Objects for which `cleared` is true; `pair_of` maps a pair of
    /// movable groups to its pair of Objects. With a ledger, the stored energy is booked as dissipated.
    pub fn clear_history(
        &mut self,
        cleared: impl Fn(usize) -> bool,
        pair_of: impl Fn(u32) -> usize,
        keeps_ledger: bool,
    ) {
        self.poses.clear_history(&cleared);
        let cleared = |group_pair: u32| cleared(pair_of(group_pair));
        if keeps_ledger {
            let pushing = self.records.iter().filter(|record| record.role == ContactRole::Active);
            let dropped = pushing.filter(|record| cleared(record.key.group_pair)).map(|record| record.stored);
            self.dissipated += dropped.sum::<f64>();
        }
        for index in 0..self.pair_energies.pairs.len() {
            if cleared(index as u32) {
                let of_pair = self.records.iter().filter(|r| r.key.group_pair as usize == index);
                let pushing = of_pair.filter(|record| record.role == ContactRole::Active);
                self.pair_energies.clear_history(index, pushing.map(|record| record.stored).sum());
            }
        }
        let stride = self.law_state_len;
        let mut kept = 0;
        for index in 0..self.records.len() {
            if !cleared(self.records[index].key.group_pair) {
                self.records.copy_within(index, kept);
                self.law_state.copy_within(index * stride..(index + 1) * stride, kept * stride);
                self.energies.copy_within(index, kept);
                kept += 1;
            }
        }
        self.records.truncate(kept);
        self.law_state.truncate(kept * stride);
        self.energies.truncate(kept);
    }
}
