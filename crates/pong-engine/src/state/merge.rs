//! What a commit makes of the memory.
//!
//! Records of pairs of movable groups that are not committed stay, those of the others are replaced. Each of the two
//! parts was small enough once, but at different times: together they may be more than the memory has room for. Then
//! those with the largest force stay, ties in key order; of what is only remembered, the force is zero.

use super::memory::{ContactMemory, Remembered};
use super::record::ContactRecord;
use crate::energy::episodes::PairEnergies;
use crate::energy::ledger::LedgerEntry;
use std::iter::Peekable;

impl ContactMemory {
    /// Writes into `next` what is remembered of contacts after a commit of the pairs of movable groups that `accepted`
    /// names: of those `fresh` and `energies`, of all others what is remembered now. The totals of the ledger get what the
    /// accepted pairs have `added`; of every pair of movable groups, or of none where no ledger is kept.
    ///
    /// Answers how many records were left out because `next` has no room for them.
    pub fn accept_into<'a>(
        &'a self,
        fresh: impl Iterator<Item = Remembered<'a>> + Clone,
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
        let fresh = fresh.filter(|fresh| is_accepted(&fresh.record)).peekable();
        next.fill(InKeyOrder { kept, fresh })
    }

    /// Replaces all records by the given ones, the strongest if there are too many. Answers how many were left out.
    fn fill<'a>(&mut self, records: impl Iterator<Item = Remembered<'a>> + Clone) -> usize {
        if self.take(records.clone()) {
            return 0;
        }
        let ranks = records.clone().map(|remembered| rank(&remembered.record));
        let mut bar = Bar::letting_in(self.records.capacity(), ranks);
        self.take(records.clone().filter(|remembered| bar.lets_in(rank(&remembered.record))));
        records.count() - self.records.len()
    }

    /// Replaces all records, as long as there is room; whether there was.
    fn take<'a>(&mut self, mut records: impl Iterator<Item = Remembered<'a>>) -> bool {
        self.clear_records();
        records.all(|remembered| self.push(&remembered).is_ok())
    }
}

/// Two sources with no pair of movable groups in common, as one in key order.
#[derive(Clone)]
struct InKeyOrder<'a, K: Iterator<Item = Remembered<'a>>, F: Iterator<Item = Remembered<'a>>> {
    kept: Peekable<K>,
    fresh: Peekable<F>,
}

impl<'a, K, F> Iterator for InKeyOrder<'a, K, F>
where
    K: Iterator<Item = Remembered<'a>>,
    F: Iterator<Item = Remembered<'a>>,
{
    type Item = Remembered<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        match (self.kept.peek(), self.fresh.peek()) {
            (Some(kept), Some(fresh)) if kept.record.key < fresh.record.key => self.kept.next(),
            (Some(_), None) => self.kept.next(),
            _ => self.fresh.next(),
        }
    }
}

/// Of two records, the one of the larger force has the larger rank: squares of sizes, whose bits are in their order.
fn rank(record: &ContactRecord) -> u64 {
    record.force_b.norm_squared().to_bits()
}

/// Lets in a given number of the highest ranks, ties as they come.
struct Bar {
    rank: u64,
    /// How many more of just this rank.
    ties: usize,
}

impl Bar {
    /// The bar for `count` of more than `count` ranks: the highest that as many reach, found by halving.
    fn letting_in(count: usize, ranks: impl Iterator<Item = u64> + Clone) -> Self {
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

    fn lets_in(&mut self, rank: u64) -> bool {
        if rank == self.rank && self.ties > 0 {
            self.ties -= 1;
            return true;
        }
        rank > self.rank
    }
}
