//! Accounts of pairs of movable groups, and wrenches on their way to the bodies.

use crate::energy::account::{Account, Verdict};
use pong_geometry::{Vec3, Wrench};

/// Accounts of one pair of movable groups.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PairBook {
    /// Since the world began.
    pub total: Account,
    /// Since the pair began to touch.
    pub touch: Account,
    pub touching: bool,
    pub touches: u64,
    pub returned_more: u64,
    pub unresolved: u64,
    pub excess: f64,
    pub worst_excess: f64,
}

/// Accounts of all pairs; empty unless the world keeps them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Books {
    pub pairs: Box<[PairBook]>,
    /// Wrenches that have not reached the bodies yet, `late` for each pair, the oldest first: on the first group about
    /// its origin, in the frame of the second.
    pub waiting: Box<[Wrench]>,
    pub late: usize,
}

impl PairBook {
    /// In a block.
    pub const NUMBERS: usize = 2 * Account::NUMBERS + 6;

    /// The touch is over: what is to be said of it.
    pub fn end_touch(&mut self) {
        let excess = self.touch.excess();
        match self.touch.verdict() {
            Verdict::ReturnedMore => {
                self.returned_more += 1;
                self.excess += excess;
                self.worst_excess = self.worst_excess.max(excess);
            }
            Verdict::Unresolved => self.unresolved += 1,
            Verdict::Lost => {}
        }
        self.touches += 1;
        (self.touch, self.touching) = (Account::default(), false);
    }

    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let counts = [self.touches, self.returned_more, self.unresolved].map(|count| count as f64);
        let rest = [f64::from(u8::from(self.touching)), self.excess, self.worst_excess];
        self.total.numbers().into_iter().chain(self.touch.numbers()).chain(counts).chain(rest)
    }

    pub fn from_numbers(numbers: &[f64; Self::NUMBERS]) -> Self {
        let (total, rest) = numbers.split_at(Account::NUMBERS);
        let (touch, rest) = rest.split_at(Account::NUMBERS);
        Self {
            total: Account::from_numbers(total),
            touch: Account::from_numbers(touch),
            touches: rest[0] as u64,
            returned_more: rest[1] as u64,
            unresolved: rest[2] as u64,
            touching: rest[3] != 0.0,
            excess: rest[4],
            worst_excess: rest[5],
        }
    }
}

impl Books {
    /// Books of so many pairs, whose wrenches come so many frames late.
    pub fn new(pairs: usize, late: usize) -> Self {
        Self {
            pairs: vec![PairBook::default(); pairs].into_boxed_slice(),
            waiting: vec![Wrench::zero(); pairs * late].into_boxed_slice(),
            late,
        }
    }

    /// Bytes in a block.
    pub fn block_len(pairs: usize, late: usize) -> usize {
        pairs * 8 * (PairBook::NUMBERS + 6 * late)
    }

    /// Becomes equal to books of the same size.
    pub fn copy_from(&mut self, other: &Self) {
        self.pairs.copy_from_slice(&other.pairs);
        self.waiting.copy_from_slice(&other.waiting);
    }

    /// Takes over what is written of one pair.
    pub fn copy_pair(&mut self, pair: usize, other: &Self) {
        if let Some(book) = self.pairs.get_mut(pair) {
            *book = other.pairs[pair];
            let waiting = pair * self.late..(pair + 1) * self.late;
            self.waiting[waiting.clone()].copy_from_slice(&other.waiting[waiting]);
        }
    }

    /// The pair is forgotten: no touch lasts, nothing is on its way, and what it had stored is gone.
    pub fn forget(&mut self, pair: usize, stored: f64) {
        if let Some(book) = self.pairs.get_mut(pair) {
            book.total.put_in -= stored;
            (book.touch, book.touching) = (Account::default(), false);
            self.waiting[pair * self.late..(pair + 1) * self.late].fill(Wrench::zero());
        }
    }

    /// Sends a wrench on its way and takes out the one that arrives.
    pub fn exchange(&mut self, pair: usize, sent: Wrench) -> Wrench {
        let waiting = &mut self.waiting[pair * self.late..(pair + 1) * self.late];
        let Some(first) = waiting.first_mut() else { return sent };
        let arrives = std::mem::replace(first, sent);
        waiting.rotate_left(1);
        arrives
    }

    /// Whether a wrench is on its way.
    pub fn is_waiting(&self, pair: usize) -> bool {
        let nothing = |wrench: &Wrench| wrench.force == Vec3::zeros() && wrench.moment == Vec3::zeros();
        !self.waiting[pair * self.late..(pair + 1) * self.late].iter().all(nothing)
    }
}
