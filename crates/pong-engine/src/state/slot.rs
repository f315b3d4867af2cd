//! References into the buffers of the threads.

use pong_threads::MAX_WORKERS;

/// Reference to an element of a thread's buffer: thread index (0 is the caller) in the high bits, element index below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot(u32);

/// Number of index bits; the rest hold the thread index.
const INDEX_BITS: u32 = 25;

const _: () = assert!(MAX_WORKERS < (u32::MAX >> INDEX_BITS) as usize);

impl Slot {
    /// Number of distinct indices.
    pub const INDICES: usize = 1 << INDEX_BITS;

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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_round_trip() {
        for (thread, index) in [(0, 0), (0, Slot::INDICES - 1), (1, 0), (MAX_WORKERS, 9)] {
            let slot = Slot::new(thread, index);
            assert_eq!((slot.thread(), slot.index()), (thread, index));
            assert_ne!(slot, Slot::NOWHERE);
        }
    }
}
