//! List of fixed capacity in an arena.

use crate::counts::Counts;
use crate::full::Full;
use std::ops::{Deref, DerefMut};

/// List of fixed capacity in an [`Arena`](crate::Arena), filled by `push` and used as a slice.
#[derive(Debug)]
pub struct List<'a, T: Copy> {
    counts: &'a Counts,
    items: bumpalo::collections::Vec<'a, T>,
    capacity: usize,
}

impl<'a, T: Copy> List<'a, T> {
    pub(crate) fn new(counts: &'a Counts, items: bumpalo::collections::Vec<'a, T>, capacity: usize) -> Self {
        Self { counts, items, capacity }
    }

    /// Appends an element.
    ///
    /// # Errors
    /// [`Full`] if the list is at its capacity. The refused element then counts towards the arena's peak.
    #[inline]
    pub fn push(&mut self, value: T) -> Result<(), Full> {
        if self.items.len() == self.capacity {
            return Err(self.refused());
        }
        self.items.push(value);
        Ok(())
    }

    #[cold]
    fn refused(&self) -> Full {
        let size = size_of::<T>();
        self.counts.refuse(size);
        Full { asked: size, free: 0, capacity: self.capacity * size }
    }

    /// Returns the number of elements that fit.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// Removes all elements.
    pub fn clear(&mut self) {
        self.items.clear();
    }

    /// Removes all elements after the first `len`.
    pub fn truncate(&mut self, len: usize) {
        self.items.truncate(len);
    }
}

impl<T: Copy> Deref for List<'_, T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.items
    }
}

impl<T: Copy> DerefMut for List<'_, T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.items
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Arena;

    #[test]
    fn a_list_takes_its_capacity_and_loses_nothing_at_the_limit() {
        let arena = Arena::with_capacity(1000);
        let mut list = arena.list(3).unwrap();
        for i in 0..3 {
            list.push(i).unwrap();
        }
        assert_eq!(list.push(3).unwrap_err(), Full { asked: 4, free: 0, capacity: 12 });
        assert_eq!(*list, [0, 1, 2]);
        list[1] = 9;
        list.truncate(2);
        list.push(5).unwrap();
        assert_eq!(*list, [0, 9, 5]);
    }

    #[test]
    fn a_list_with_spare_capacity_keeps_clear_of_its_neighbours() {
        let arena = Arena::with_capacity(128);
        let mut a = arena.list(8).unwrap();
        let mut b = arena.list(8).unwrap();
        for i in 0..8_u64 {
            a.push(i).unwrap();
            b.push(100 + i).unwrap();
        }
        assert!(a.iter().zip(b.iter()).all(|(x, y)| x + 100 == *y));
        assert!(arena.list::<u8>(1).is_err());
    }

    #[test]
    fn a_dropped_list_is_not_handed_out_before_the_reset() {
        let mut arena = Arena::with_capacity(64);
        drop(arena.list::<u64>(8).unwrap());
        assert!(arena.list::<u64>(1).is_err());
        arena.reset();
        assert!(arena.list::<u64>(8).is_ok());
    }

    #[test]
    fn refused_elements_show_in_the_peak() {
        let arena = Arena::with_capacity(64);
        let mut list = arena.list::<u64>(2).unwrap();
        for i in 0..5 {
            let _ = list.push(i);
        }
        assert_eq!((arena.used(), arena.peak()), (16, 40));
    }
}
