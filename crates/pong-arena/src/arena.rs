//! Block of memory that is handed out piece by piece and released as a whole.

use crate::counts::Counts;
use crate::demand::{GRAIN, rounded};
use crate::full::Full;
use crate::list::List;
use bumpalo::Bump;

/// Memory of one frame, handed out as slices and lists. The next [`reset`](Self::reset) releases all of them.
///
/// The memory is one block, which is allocated with the arena and never grows. Each of its pages is written
/// when the arena is created, so no page fault comes later.
#[derive(Debug)]
pub struct Arena {
    bump: Bump,
    capacity: usize,
    counts: Counts,
}

impl Arena {
    /// Creates an arena of `bytes`, rounded up to a multiple of 16.
    ///
    /// # Panics
    /// If the allocation fails.
    pub fn with_capacity(bytes: usize) -> Self {
        let capacity = bytes.checked_next_multiple_of(GRAIN).expect("a size that an address space can hold");
        let mut bump = Bump::with_capacity(capacity.max(GRAIN));
        std::hint::black_box(bump.alloc_slice_fill_copy(capacity, 0_u8));
        bump.reset();
        // Forbids bumpalo to allocate a second block.
        bump.set_allocation_limit(Some(bump.allocated_bytes()));
        Self { bump, capacity, counts: Counts::default() }
    }

    /// Releases everything that was handed out; the memory stays allocated.
    #[inline]
    pub fn reset(&mut self) {
        self.bump.reset();
        self.counts.reset();
    }

    /// Returns a slice of `len` elements, each a copy of `fill`.
    ///
    /// # Errors
    /// [`Full`] if the slice does not fit; nothing is taken then.
    // `&mut` from `&self` is sound, because no two calls hand out the same memory.
    #[allow(clippy::mut_from_ref)]
    #[inline]
    pub fn slice<T: Copy>(&self, len: usize, fill: T) -> Result<&mut [T], Full> {
        self.claim::<T>(len)?;
        self.bump.try_alloc_slice_fill_copy(len, fill).map_err(|_| self.full(len * size_of::<T>()))
    }

    /// Returns an empty list with room for `capacity` elements.
    ///
    /// # Errors
    /// [`Full`] if the list does not fit.
    // Inlined, because returning the list through memory causes a store-forwarding stall.
    #[inline(always)]
    pub fn list<T: Copy>(&self, capacity: usize) -> Result<List<'_, T>, Full> {
        // A request that `claim` accepts always fits, because bumpalo packs pieces that are multiples of
        // `GRAIN` without gaps.
        self.claim::<T>(capacity)?;
        let items = bumpalo::collections::Vec::with_capacity_in(capacity, &self.bump);
        Ok(List::new(&self.counts, items, capacity))
    }

    /// Returns the number of bytes handed out since the last reset.
    pub fn used(&self) -> usize {
        self.counts.used()
    }

    /// Returns the most bytes requested between two resets since the arena was made, refused requests
    /// included. An arena of this capacity would have been enough.
    pub fn peak(&self) -> usize {
        self.counts.peak()
    }

    /// Returns the size of the arena, bytes.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// Counts a request as granted if it fits. Otherwise counts it as refused and returns the error.
    #[inline]
    fn claim<T>(&self, len: usize) -> Result<(), Full> {
        const { assert!(align_of::<T>() <= GRAIN, "the arena aligns to 16 bytes at most") };
        let whole = rounded::<T>(len);
        if whole > self.capacity - self.counts.used() {
            self.counts.refuse(whole);
            return Err(self.full(len.saturating_mul(size_of::<T>())));
        }
        self.counts.take(whole);
        Ok(())
    }

    fn full(&self, asked: usize) -> Full {
        Full { asked, free: self.capacity - self.counts.used(), capacity: self.capacity }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_fits_up_to_the_last_byte_and_nothing_beyond() {
        let mut arena = Arena::with_capacity(160);
        for _ in 0..3 {
            arena.reset();
            let ten = (0..10).map(|i| arena.slice(2, f64::from(i)).unwrap()).collect::<Vec<_>>();
            assert_eq!((arena.used(), arena.capacity()), (160, 160));
            let refused = arena.slice(1, 0_u8).unwrap_err();
            assert_eq!(refused, Full { asked: 1, free: 0, capacity: 160 });
            // The slices handed out are unchanged.
            for (i, slice) in ten.iter().enumerate() {
                assert_eq!(**slice, [i as f64; 2]);
            }
        }
    }

    #[test]
    fn a_refusal_leaves_room_for_what_still_fits() {
        let arena = Arena::with_capacity(64);
        assert!(arena.slice(9, 0_u64).is_err());
        assert_eq!(arena.slice(8, 7_u64).unwrap(), [7; 8]);
    }

    #[test]
    fn reset_hands_out_the_same_memory_again() {
        let mut arena = Arena::with_capacity(1 << 20);
        let first = arena.slice(1 << 20, 1_u8).unwrap().as_ptr() as usize;
        arena.reset();
        assert_eq!(arena.used(), 0);
        assert_eq!(arena.slice(1 << 20, 2_u8).unwrap().as_ptr() as usize, first);
    }

    #[test]
    fn every_element_is_aligned_and_order_costs_nothing() {
        #[derive(Clone, Copy)]
        #[repr(align(16))]
        struct Wide(#[allow(dead_code)] [u8; 16]);
        let mut arena = Arena::with_capacity(16 * 5);
        for turn in 0..5 {
            arena.reset();
            for place in 0..5 {
                let address = match (place + turn) % 5 {
                    0 => arena.slice(1, 1_u8).unwrap().as_ptr() as usize,
                    1 => arena.slice(1, 1_u16).unwrap().as_ptr() as usize,
                    2 => arena.slice(3, 1_u32).unwrap().as_ptr() as usize,
                    3 => arena.slice(1, 1_u64).unwrap().as_ptr() as usize,
                    _ => arena.slice(1, Wide([0; 16])).unwrap().as_ptr() as usize,
                };
                let align = [1, 2, 4, 8, 16][(place + turn) % 5];
                assert_eq!(address % align, 0);
            }
            assert_eq!(arena.used(), arena.capacity());
        }
    }

    #[test]
    fn zero_sizes_cost_nothing() {
        let arena = Arena::with_capacity(0);
        assert_eq!(arena.capacity(), 0);
        assert!(arena.slice(0, 0.0).unwrap().is_empty());
        assert_eq!(arena.slice(5, ()).unwrap().len(), 5);
        assert!(arena.list::<f64>(0).unwrap().is_empty());
        let mut nothing = arena.list::<()>(2).unwrap();
        assert!([nothing.push(()), nothing.push(())].iter().all(Result::is_ok));
        assert!(nothing.push(()).is_err());
        assert_eq!(arena.slice(1, 0_u8).unwrap_err(), Full { asked: 1, free: 0, capacity: 0 });
        assert_eq!(arena.peak(), 16);
    }

    #[test]
    fn absurd_requests_are_refused() {
        let arena = Arena::with_capacity(64);
        assert!(arena.slice(usize::MAX, 0.0).is_err());
        assert!(arena.list::<f64>(usize::MAX / 8).is_err());
        assert_eq!(arena.used(), 0);
    }

    #[test]
    fn the_peak_is_the_size_that_would_have_been_enough() {
        let run = |capacity: usize| {
            let mut arena = Arena::with_capacity(capacity);
            for frame in 0..4 {
                arena.reset();
                let wanted = [3, 40, 9, 1][frame];
                let refused = arena.slice(wanted, 0_u64).is_err() | arena.slice(5, 0_u32).is_err();
                assert!(!refused || arena.peak() > capacity);
            }
            arena.peak()
        };
        let advised = run(48);
        assert_eq!(advised, 40 * 8 + 32);
        assert_eq!(run(advised), advised);
    }

    #[test]
    fn sizes_are_rounded_up() {
        assert_eq!(Arena::with_capacity(1).capacity(), 16);
        assert_eq!(Arena::with_capacity(4097).capacity(), 4112);
    }
}
