//! Where a contact stands, and what is asked of all contacts before they are summed.

use crate::sealed::Direction;
use crate::state::{ContactKey, Slot};

/// Where a contact stands, with the first of what decides the order of sums, which few have in common, and what else is asked of
/// all contacts before they are summed: then the contacts themselves need not be read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub head: u64,
    /// In the buffer of which lane, and where there.
    pub slot: Slot,
    /// Whether it pushes, in the lowest bit; above, the committed record that it continues, or [`Self::BEGINS`].
    state: u32,
}

impl Place {
    const BEGINS: u32 = u32::MAX >> 1;

    /// The place of a contact that stands in a slot.
    #[inline]
    pub fn new(head: u64, slot: Slot, pushes: bool, continues: Option<u32>) -> Self {
        let record = continues.unwrap_or(Self::BEGINS);
        Self { head, slot, state: record << 1 | u32::from(pushes) }
    }

    /// No contact.
    pub const NOWHERE: Self = Self { head: 0, slot: Slot::NOWHERE, state: Self::BEGINS << 1 };

    /// The same contact in another slot.
    #[inline]
    pub fn at(self, slot: Slot) -> Self {
        Self { slot, ..self }
    }

    /// Whose contact it is.
    #[inline]
    pub fn direction(&self) -> Direction {
        ContactKey::direction_of(self.head)
    }

    #[inline]
    pub fn pushes(&self) -> bool {
        self.state & 1 == 1
    }

    /// The committed record that the contact continues.
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
    fn a_place_tells_all_that_it_was_made_of() {
        let slot = Slot::new(1, 9);
        for continues in [None, Some(0), Some(1), Some(1 << 30)] {
            for pushes in [false, true] {
                let place = Place::new(7, slot, pushes, continues);
                assert_eq!((place.head, place.slot, place.pushes()), (7, slot, pushes));
                assert_eq!(place.continues(), continues.map(|record| record as usize));
            }
        }
        let nowhere = Place::NOWHERE;
        assert!(nowhere.slot == Slot::NOWHERE && !nowhere.pushes() && nowhere.continues().is_none());
    }
}
