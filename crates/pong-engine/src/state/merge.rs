//! Merges the contacts of a commit into the next contact state.
//!
//! Records of committed pairs of movable groups are replaced, the others are kept. If together they exceed
//! the capacity, those with the largest forces are kept, and of equal forces the first in key order. Contacts
//! that do not push have zero force, so that they are dropped first.

use super::memory::{ContactMemory, RecordEntry};
use super::record::ContactRecord;
use crate::energy::LedgerEntry;
use crate::energy::episodes::PairEnergies;
use std::iter::Peekable;

impl ContactMemory {
    /// Writes the contact state after a partial commit into `next`: `new` and `energies` for the pairs of
    /// movable groups that `accepted` selects, the current state for all others. `added` holds the ledger
    /// entries per pair of movable groups (empty without a ledger); those of the accepted pairs enter the
    /// totals.
    ///
    /// Returns the number of records dropped because `next` is full.
    pub fn merge_into<'a>(
        &'a self,
        new: impl Iterator<Item = RecordEntry<'a>> + Clone,
        (energies, added): (&PairEnergies, &[LedgerEntry]),
        accepted: impl Fn(u32) -> bool,
        next: &mut Self,
    ) -> usize {
        for index in 0..self.pair_energies.pairs.len() {
            let energies = if accepted(index as u32) { energies } else { &self.pair_energies };
            next.pair_energies.copy_pair(index, energies);
        }
        let mut total = LedgerEntry { work: self.work, dissipated: self.dissipated };
        for (index, one) in added.iter().enumerate() {
            if accepted(index as u32) {
                total.add(one);
            }
        }
        (next.work, next.dissipated) = (total.work, total.dissipated);
        let is_accepted = |record: &ContactRecord| accepted(record.key.group_pair);
        let kept = self.iter().filter(|kept| !is_accepted(&kept.record)).peekable();
        let new = new.filter(|new| is_accepted(&new.record)).peekable();
        next.fill(InKeyOrder { kept, new })
    }

    /// Replaces all records, keeping the strongest if there are too many. Returns the number dropped.
    fn fill<'a>(&mut self, records: impl Iterator<Item = RecordEntry<'a>> + Clone) -> usize {
        if self.replace_by(records.clone()) {
            return 0;
        }
        let ranks = records.clone().map(|entry| rank(&entry.record));
        let mut limit = RankLimit::admitting(self.records.capacity(), ranks);
        self.replace_by(records.clone().filter(|entry| limit.admits(rank(&entry.record))));
        records.count() - self.records.len()
    }

    /// Replaces all records; returns false when there is no more room.
    fn replace_by<'a>(&mut self, mut records: impl Iterator<Item = RecordEntry<'a>>) -> bool {
        self.clear_records();
        records.all(|entry| self.push(&entry).is_ok())
    }
}

/// Merges two sources of records into one in key order. No pair of movable groups has records in both.
#[derive(Clone)]
struct InKeyOrder<'a, K: Iterator<Item = RecordEntry<'a>>, N: Iterator<Item = RecordEntry<'a>>> {
    kept: Peekable<K>,
    new: Peekable<N>,
}

impl<'a, K, N> Iterator for InKeyOrder<'a, K, N>
where
    K: Iterator<Item = RecordEntry<'a>>,
    N: Iterator<Item = RecordEntry<'a>>,
{
    type Item = RecordEntry<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        match (self.kept.peek(), self.new.peek()) {
            (Some(kept), Some(new)) if kept.record.key < new.record.key => self.kept.next(),
            (Some(_), None) => self.kept.next(),
            _ => self.new.next(),
        }
    }
}

/// Sort rank by force: squared norms are non-negative, so their bits compare as integers.
fn rank(record: &ContactRecord) -> u64 {
    record.force_b.norm_squared().to_bits()
}

/// Threshold that admits a given number of the highest ranks, ties in input order.
struct RankLimit {
    rank: u64,
    /// Remaining number of records to admit at exactly this rank.
    ties: usize,
}

impl RankLimit {
    /// Threshold for `count` of more than `count` ranks: the highest rank that at least `count` reach, by
    /// bisection over bits.
    fn admitting(count: usize, ranks: impl Iterator<Item = u64> + Clone) -> Self {
        let reach = |rank: u64| ranks.clone().filter(|other| *other >= rank).count();
        let mut rank = 0;
        for bit in (0..u64::BITS).rev() {
            let higher = rank | 1 << bit;
            if reach(higher) >= count {
                rank = higher;
            }
        }
        let above = ranks.clone().filter(|other| *other > rank).count();
        Self { rank, ties: count - above }
    }

    fn admits(&mut self, rank: u64) -> bool {
        if rank == self.rank && self.ties > 0 {
            self.ties -= 1;
            return true;
        }
        rank > self.rank
    }
}
