//! References to contacts: sort key, location, and what the search for ended contacts needs.

use crate::seal::Direction;
use crate::state::ContactKey;
use pong_threads::MAX_WORKERS;

/// Reference to a contact, with the high word of its sort key and the flags that are needed before summation,
/// so that most passes over the contacts need not read the contacts themselves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactRef {
    pub head: u64,
    /// Location of the contact.
    pub slot: Slot,
    /// Lowest bit: the contact pushes. Above: index of the committed record that it continues, or
    /// [`Self::BEGINS`].
    state: u32,
}

impl ContactRef {
    const BEGINS: u32 = u32::MAX >> 1;

    /// Reference to the contact in a slot.
    #[inline]
    pub fn new(head: u64, slot: Slot, pushes: bool, continues: Option<u32>) -> Self {
        let record = continues.unwrap_or(Self::BEGINS);
        Self { head, slot, state: record << 1 | u32::from(pushes) }
    }

    /// Reference to no contact.
    pub const NOWHERE: Self = Self { head: 0, slot: Slot::NOWHERE, state: Self::BEGINS << 1 };

    /// Reference to the same contact in another slot.
    #[inline]
    pub fn at(self, slot: Slot) -> Self {
        Self { slot, ..self }
    }

    /// Pair direction of the contact.
    #[inline]
    pub fn direction(&self) -> Direction {
        ContactKey::direction_of(self.head)
    }

    #[inline]
    pub fn pushes(&self) -> bool {
        self.state & 1 == 1
    }

    /// Index of the committed record that the contact continues.
    #[inline]
    pub fn continues(&self) -> Option<usize> {
        let record = self.state >> 1;
        (record != Self::BEGINS).then_some(record as usize)
    }
}

/// Location of a contact: thread index (0 is the caller) in the high bits, index in the buffer of that thread
/// below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot(u32);

/// Number of index bits; the rest hold the thread index.
const INDEX_BITS: u32 = 25;

const _: () = assert!(MAX_WORKERS < (u32::MAX >> INDEX_BITS) as usize);

impl Slot {
    /// Number of distinct indices.
    pub const INDICES: usize = 1 << INDEX_BITS;

    /// Location of no contact.
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

    #[test]
    fn references_round_trip() {
        let slot = Slot::new(1, 9);
        for continues in [None, Some(0), Some(1), Some(1 << 30)] {
            for pushes in [false, true] {
                let reference = ContactRef::new(7, slot, pushes, continues);
                assert_eq!((reference.head, reference.slot, reference.pushes()), (7, slot, pushes));
                assert_eq!(reference.continues(), continues.map(|record| record as usize));
            }
        }
        let nowhere = ContactRef::NOWHERE;
        assert!(nowhere.slot == Slot::NOWHERE && !nowhere.pushes() && nowhere.continues().is_none());
    }
}
