//! References to contacts, with the data that sorting and commit need of every contact.

use crate::seal::Direction;
use crate::state::{ContactKey, Slot};

/// Reference to a contact, with the high word of its sort key and the flags that are needed before summation.
/// Most passes then need not read the contacts themselves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactRef {
    pub head: u64,
    /// Thread's buffer and index in it.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_round_trip() {
        let slot = Slot::new(1, 9);
        for continues in [None, Some(0), Some(1), Some(1 << 30)] {
            for pushes in [false, true] {
                let place = ContactRef::new(7, slot, pushes, continues);
                assert_eq!((place.head, place.slot, place.pushes()), (7, slot, pushes));
                assert_eq!(place.continues(), continues.map(|record| record as usize));
            }
        }
        let nowhere = ContactRef::NOWHERE;
        assert!(nowhere.slot == Slot::NOWHERE && !nowhere.pushes() && nowhere.continues().is_none());
    }
}
