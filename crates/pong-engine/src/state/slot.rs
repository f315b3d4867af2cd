//! References into the buffers of the threads.

use pong_threads::MAX_WORKERS;

/// Reference into a thread's buffer: thread index (0 is the caller) in the high bits, element index below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot(u32);

/// Number of index bits; the rest hold the thread index.
const INDEX_BITS: u32 = 25;

const _: () = assert!(MAX_WORKERS < Slot::NO_LANE);

impl Slot {
    /// Number of distinct indices.
    pub const INDICES: usize = 1 << INDEX_BITS;

    /// A value that is no thread index.
    pub const NO_LANE: usize = (u32::MAX >> INDEX_BITS) as usize;

    /// Reference to nothing.
    pub const NOWHERE: Self = Self(u32::MAX);

    #[inline]
    pub const fn new(thread: usize, index: usize) -> Self {
        Self((thread << INDEX_BITS | index) as u32)
    }

    #[inline]
    pub const fn thread(self) -> usize {
        (self.0 >> INDEX_BITS) as usize
    }

    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize & (Self::INDICES - 1)
    }

    /// Next index of the same buffer.
    #[inline]
    pub const fn next(self) -> Self {
        Self(self.0 + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slot_tells_the_lane_and_the_index_that_it_was_made_of() {
        for (thread, index) in [(0, 0), (0, Slot::INDICES - 1), (1, 0), (MAX_WORKERS, 9)] {
            let slot = Slot::new(thread, index);
            assert_eq!((slot.thread(), slot.index()), (thread, index));
            assert_ne!(slot, Slot::NOWHERE);
        }
        assert_eq!(Slot::new(3, 7).next(), Slot::new(3, 8));
    }
}
