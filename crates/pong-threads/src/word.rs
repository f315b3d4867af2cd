//! State of a phase, packed in one 64-bit word: 40 bits epoch, 7 bits workers, 16 bits number, 1 bit flag.

use crate::{MAX_BLOCKS, MAX_WORKERS};

const NUMBER_SHIFT: u32 = 1;
const WORKERS_SHIFT: u32 = 17;
const WORKERS_MASK: u64 = (1 << (EPOCH_SHIFT - WORKERS_SHIFT)) - 1;
const EPOCH_SHIFT: u32 = 24;
const EPOCH_MASK: u64 = (1 << 40) - 1;

/// Packed state of a phase: epoch, `workers`, number and flag. In the claim word the number counts the blocks
/// left, `workers` is the number of workers that take part, and the flag ends all workers. In a tally the
/// number counts the blocks done, `workers` is 0, and the flag means that a block panicked.
///
/// The epoch wraps around after 2⁴⁰ phases: 35 years at one phase per millisecond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word(pub u64);

impl Word {
    pub fn new(epoch: u64, number: u32, flag: bool) -> Word {
        debug_assert!(number <= MAX_BLOCKS);
        Word((epoch & EPOCH_MASK) << EPOCH_SHIFT | u64::from(number) << NUMBER_SHIFT | u64::from(flag))
    }

    /// Returns the same word with the number of workers that take part.
    pub fn among(self, workers: usize) -> Word {
        debug_assert!(workers <= MAX_WORKERS && self.workers() == 0);
        Word(self.0 | (workers as u64) << WORKERS_SHIFT)
    }

    pub fn epoch(self) -> u64 {
        self.0 >> EPOCH_SHIFT
    }

    pub fn number(self) -> u32 {
        (self.0 >> NUMBER_SHIFT) as u32 & MAX_BLOCKS
    }

    pub fn workers(self) -> usize {
        (self.0 >> WORKERS_SHIFT & WORKERS_MASK) as usize
    }

    pub fn flag(self) -> bool {
        self.0 & Self::FLAG != 0
    }

    /// Returns the same word with its number reduced by `fewer`, which must not exceed the number.
    pub fn less(self, fewer: u32) -> Word {
        debug_assert!(fewer <= self.number());
        Word(self.0 - (u64::from(fewer) << NUMBER_SHIFT))
    }

    /// Returns the epoch after `epoch`, with wrap-around.
    pub fn next_epoch(epoch: u64) -> u64 {
        (epoch + 1) & EPOCH_MASK
    }

    pub const FLAG: u64 = 1;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_do_not_touch_each_other() {
        let parts = |word: Word| (word.epoch(), word.workers(), word.number(), word.flag());
        let word = Word::new(EPOCH_MASK, MAX_BLOCKS, true).among(MAX_WORKERS);
        assert_eq!(parts(word), (EPOCH_MASK, MAX_WORKERS, MAX_BLOCKS, true));
        assert_eq!(parts(Word::new(5, 7, true).less(4)), (5, 0, 3, true));
        assert_eq!(parts(Word::new(5, MAX_BLOCKS, false).among(1).less(MAX_BLOCKS)), (5, 1, 0, false));
    }

    #[test]
    fn the_epoch_after_the_last_is_the_first() {
        assert_eq!(Word::next_epoch(EPOCH_MASK), 0);
        assert_eq!(Word::new(EPOCH_MASK + 1, 3, false), Word::new(0, 3, false));
    }
}
