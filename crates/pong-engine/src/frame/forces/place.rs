//! Where a contact stands, and what is asked of all contacts before they are summed.

use crate::sealed::Direction;
use crate::state::ContactKey;
use pong_threads::MAX_WORKERS;

/// Bits that tell where in a lane's buffer a contact stands. They count further than any room for contacts goes, and the rest
/// further than there are lanes.
const INDEX_BITS: u32 = 25;

const _: () = assert!(MAX_WORKERS < (u32::MAX >> INDEX_BITS) as usize);

/// Where a contact stands, with the first of what decides the order of sums, which few have in common, and what else is asked of
/// all contacts before they are summed: then the contacts themselves need not be read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub head: u64,
    /// The lane whose buffer it stands in, 0 for the caller's, in the highest bits; below, the index there.
    slot: u32,
    /// Whether it pushes, in the lowest bit; above, the committed record that it continues, or [`Self::BEGINS`].
    state: u32,
}

impl Place {
    const BEGINS: u32 = u32::MAX >> 1;

    /// The place of a contact that stands in a [`slot`](Self::slot_of).
    #[inline]
    pub fn new(head: u64, slot: u32, pushes: bool, continues: Option<u32>) -> Self {
        let record = continues.unwrap_or(Self::BEGINS);
        Self { head, slot, state: record << 1 | u32::from(pushes) }
    }

    /// The number of what stands at an index of a lane's buffer, the caller's being lane 0.
    #[inline]
    pub const fn slot_of(lane: usize, index: usize) -> u32 {
        (lane << INDEX_BITS | index) as u32
    }

    /// No contact.
    pub const NOWHERE: Self = Self { head: 0, slot: u32::MAX, state: Self::BEGINS << 1 };

    pub fn is_nowhere(&self) -> bool {
        self.slot == u32::MAX
    }

    /// The same contact in another slot.
    #[inline]
    pub fn at(self, slot: u32) -> Self {
        Self { slot, ..self }
    }

    /// The lane whose buffer the contact stands in.
    #[inline]
    pub fn lane(&self) -> usize {
        (self.slot >> INDEX_BITS) as usize
    }

    /// Where it stands there.
    #[inline]
    pub fn index(&self) -> usize {
        (self.slot & (u32::MAX >> (u32::BITS - INDEX_BITS))) as usize
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
        for (lane, index) in [(0, 0), (0, (1 << INDEX_BITS) - 1), (1, 0), (MAX_WORKERS, 9)] {
            for continues in [None, Some(0), Some(1), Some(1 << 30)] {
                for pushes in [false, true] {
                    let place = Place::new(7, Place::slot_of(lane, index), pushes, continues);
                    assert_eq!(
                        (place.head, place.lane(), place.index(), place.pushes()),
                        (7, lane, index, pushes)
                    );
                    assert_eq!(place.continues(), continues.map(|record| record as usize));
                    assert!(!place.is_nowhere());
                }
            }
        }
        assert!(
            Place::NOWHERE.is_nowhere() && !Place::NOWHERE.pushes() && Place::NOWHERE.continues().is_none()
        );
    }
}
