//! A number that belongs to a phase, in one atomic word: 40 bits epoch, 23 bits number, 1 bit flag.

use crate::MAX_BLOCKS;

const NUMBER_SHIFT: u32 = 1;
const EPOCH_SHIFT: u32 = 24;
const EPOCH_MASK: u64 = (1 << 40) - 1;

/// In the claim word the number is the blocks left and the flag tells the workers to end. In a tally the number is
/// the blocks done and the flag tells that one of them panicked.
///
/// The epoch starts again after 2⁴⁰ phases: 35 years of one phase per millisecond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word(pub u64);

impl Word {
    pub fn new(epoch: u64, number: u32, flag: bool) -> Word {
        debug_assert!(number <= MAX_BLOCKS);
        Word((epoch & EPOCH_MASK) << EPOCH_SHIFT | u64::from(number) << NUMBER_SHIFT | u64::from(flag))
    }

    pub fn epoch(self) -> u64 {
        self.0 >> EPOCH_SHIFT
    }

    pub fn number(self) -> u32 {
        (self.0 >> NUMBER_SHIFT) as u32 & MAX_BLOCKS
    }

    pub fn flag(self) -> bool {
        self.0 & Self::FLAG != 0
    }

    /// The number less `fewer`, which it is not below.
    pub fn less(self, fewer: u32) -> Word {
        debug_assert!(fewer <= self.number());
        Word(self.0 - (u64::from(fewer) << NUMBER_SHIFT))
    }

    /// The epoch that follows `epoch`.
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
        let word = Word::new(EPOCH_MASK, MAX_BLOCKS, true);
        assert_eq!((word.epoch(), word.number(), word.flag()), (EPOCH_MASK, MAX_BLOCKS, true));
        let word = Word::new(5, 7, true).less(4);
        assert_eq!((word.epoch(), word.number(), word.flag()), (5, 3, true));
    }

    #[test]
    fn the_epoch_after_the_last_is_the_first() {
        assert_eq!(Word::next_epoch(EPOCH_MASK), 0);
        assert_eq!(Word::new(EPOCH_MASK + 1, 3, false), Word::new(0, 3, false));
    }
}
