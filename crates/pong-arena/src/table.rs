//! Table of fixed capacity that lives longer than a frame.

use crate::full::Full;
use std::ops::{Deref, DerefMut};

/// Table of fixed capacity, used as a slice.
///
/// The memory is allocated when the table is created, and never grows or shrinks. Each of its pages is
/// written then, so no page fault comes later.
#[derive(Debug)]
pub struct Table<T: Copy> {
    /// Storage of the full capacity. Elements from `len` on do not belong to the table.
    items: Box<[T]>,
    /// Number of elements, at most the length of `items`.
    len: usize,
}

impl<T: Copy> Table<T> {
    /// Creates an empty table with room for `capacity` elements. `fill` initialises the memory.
    ///
    /// # Panics
    /// If the allocation fails.
    pub fn with_capacity(capacity: usize, fill: T) -> Self {
        let mut items = vec![fill; capacity].into_boxed_slice();
        std::hint::black_box(&mut items[..]);
        Self { items, len: 0 }
    }

    /// Appends an element.
    ///
    /// # Errors
    /// [`Full`] if there is no room; the table is unchanged.
    #[inline]
    pub fn push(&mut self, value: T) -> Result<(), Full> {
        *self.slot()? = value;
        Ok(())
    }

    /// Appends an element with whatever value its memory holds, and returns it. The caller must set it
    /// wholly. For a large element, setting it in place is faster than a copy.
    ///
    /// # Errors
    /// [`Full`] if there is no room; the table is unchanged.
    #[inline]
    pub fn slot(&mut self) -> Result<&mut T, Full> {
        if self.len == self.items.len() {
            return Err(self.refuse(1));
        }
        let slot = &mut self.items[self.len];
        self.len += 1;
        Ok(slot)
    }

    /// Appends all of `values`, or none of them.
    ///
    /// # Errors
    /// [`Full`] if there is no room for all of them; the table is unchanged.
    #[inline]
    pub fn extend_from_slice(&mut self, values: &[T]) -> Result<(), Full> {
        let Some(room) = self.items[self.len..].get_mut(..values.len()) else {
            return Err(self.refuse(values.len()));
        };
        room.copy_from_slice(values);
        self.len += values.len();
        Ok(())
    }

    /// Removes all elements.
    #[inline]
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// Removes all elements after the first `len`.
    #[inline]
    pub fn truncate(&mut self, len: usize) {
        self.len = self.len.min(len);
    }

    /// Keeps the elements for which `keep` returns `true`, in order, and removes the others.
    pub fn retain(&mut self, mut keep: impl FnMut(&T) -> bool) {
        let mut kept = 0;
        for index in 0..self.len {
            if keep(&self.items[index]) {
                self.items[kept] = self.items[index];
                kept += 1;
            }
        }
        self.len = kept;
    }

    /// Returns the elements as a slice.
    // Unchecked, because every access to a table goes through this function, and a check of `len` costs 2 to
    // 3 % of a frame's instructions.
    #[inline]
    #[allow(unsafe_code, reason = "len is private, and whatever sets it keeps it within items")]
    pub fn as_slice(&self) -> &[T] {
        debug_assert!(self.len <= self.items.len());
        // SAFETY: `len` grows only after a check against `items`, and otherwise shrinks.
        unsafe { self.items.get_unchecked(..self.len) }
    }

    /// Returns the elements as a mutable slice.
    #[inline]
    #[allow(unsafe_code, reason = "as for as_slice")]
    pub fn as_mut_slice(&mut self) -> &mut [T] {
        debug_assert!(self.len <= self.items.len());
        // SAFETY: as for `as_slice`.
        unsafe { self.items.get_unchecked_mut(..self.len) }
    }

    /// Returns the number of elements that fit.
    pub fn capacity(&self) -> usize {
        self.items.len()
    }

    #[cold]
    fn refuse(&self, count: usize) -> Full {
        let size = size_of::<T>();
        let free = self.capacity() - self.len;
        Full { asked: count.saturating_mul(size), free: free * size, capacity: self.capacity() * size }
    }
}

impl<T: Copy> Default for Table<T> {
    /// Table of capacity zero.
    fn default() -> Self {
        Self { items: Box::default(), len: 0 }
    }
}

impl<T: Copy> Clone for Table<T> {
    /// Table with the same elements and capacity. It allocates, so it is for set-up only.
    fn clone(&self) -> Self {
        Self { items: self.items.clone(), len: self.len }
    }
}

impl<T: Copy + PartialEq> PartialEq for Table<T> {
    /// Compares the elements; the capacities may differ.
    fn eq(&self, other: &Self) -> bool {
        self.as_slice() == other.as_slice()
    }
}

impl<T: Copy> Deref for Table<T> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        self.as_slice()
    }
}

impl<T: Copy> DerefMut for Table<T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        self.as_mut_slice()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_takes_its_capacity_and_loses_nothing_at_the_limit() {
        let mut table = Table::with_capacity(2, 0_u32);
        let place = table.as_slice().as_ptr();
        assert!(table.push(1).is_ok() && table.push(2).is_ok());
        assert_eq!(table.push(3).unwrap_err(), Full { asked: 4, free: 0, capacity: 8 });
        assert_eq!(*table, [1, 2]);
        assert_eq!(table.as_slice().as_ptr(), place);
    }

    #[test]
    fn a_slot_is_an_element_that_its_caller_writes() {
        let mut table = Table::with_capacity(2, 7_u8);
        *table.slot().unwrap() = 1;
        table.push(2).unwrap();
        assert!(table.slot().is_err());
        assert_eq!(*table, [1, 2]);
        table.clear();
        // The slot still holds the removed element.
        assert_eq!(*table.slot().unwrap(), 1);
        assert_eq!(table.len(), 1);
    }

    #[test]
    fn many_at_once_come_in_whole_or_not_at_all() {
        let mut table = Table::with_capacity(4, 0_u8);
        table.extend_from_slice(&[1, 2, 3]).unwrap();
        assert_eq!(table.extend_from_slice(&[4, 5]).unwrap_err(), Full { asked: 2, free: 1, capacity: 4 });
        table.extend_from_slice(&[4]).unwrap();
        assert_eq!(*table, [1, 2, 3, 4]);
    }

    #[test]
    fn elements_can_be_taken_out_and_changed_in_place() {
        let mut table = Table::with_capacity(6, 0);
        table.extend_from_slice(&[1, 2, 3, 4, 5, 6]).unwrap();
        table.retain(|x| x % 2 == 0);
        table.truncate(2);
        table.as_mut_slice()[0] = 9;
        assert_eq!(*table, [9, 4]);
        assert_eq!(table.capacity(), 6);
    }

    #[test]
    fn a_clone_has_the_room_of_its_model() {
        let mut model = Table::with_capacity(4, 0.0);
        model.push(1.5).unwrap();
        let mut copy = model.clone();
        assert!(copy == model);
        assert!((0..3).all(|_| copy.push(2.5).is_ok()));
        assert!(copy.push(2.5).is_err());
        assert_eq!(model.len(), 1);
    }

    #[test]
    fn no_room_is_no_room() {
        assert!(Table::default().push(1).is_err());
        assert!(Table::with_capacity(0, 0_u8).extend_from_slice(&[]).is_ok());
        let mut nothing = Table::with_capacity(1, ());
        assert!(nothing.push(()).is_ok() && nothing.push(()).is_err());
    }
}
