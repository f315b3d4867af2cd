//! Size that an arena must have for given requests.

/// Granularity of requests, bytes. Every request is rounded up to a multiple of it, so that the padding for
/// alignment does not depend on addresses. No element may need a larger alignment.
pub(crate) const GRAIN: usize = 16;

/// Sum of the requests to an [`Arena`](crate::Arena), from which its capacity follows.
///
/// ```
/// use pong_arena::{Arena, Demand};
///
/// let arena = Arena::with_capacity(Demand::default().and::<f64>(3).and::<u8>(1).bytes());
/// assert!(arena.list::<f64>(3).is_ok() && arena.slice(1, 0_u8).is_ok());
/// assert_eq!(arena.used(), arena.capacity());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Demand(usize);

impl Demand {
    /// Adds a slice of `len` elements, or a list with room for `len` elements.
    #[must_use]
    pub fn and<T>(self, len: usize) -> Self {
        Self(self.0.saturating_add(rounded::<T>(len)))
    }

    /// Returns the sum of the requests, bytes.
    pub fn bytes(self) -> usize {
        self.0
    }
}

/// Returns the size of a request for `len` elements, rounded up, bytes.
pub(crate) fn rounded<T>(len: usize) -> usize {
    let bytes = len.saturating_mul(size_of::<T>());
    bytes.checked_next_multiple_of(GRAIN).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Arena;

    #[test]
    fn an_arena_of_the_demanded_size_takes_just_that_in_any_order() {
        let demand =
            Demand::default().and::<u8>(3).and::<u64>(5).and::<[f64; 3]>(7).and::<u16>(0).and::<()>(9);
        for turn in 0..3 {
            let arena = Arena::with_capacity(demand.bytes());
            for place in 0..3 {
                let fits = match (place + turn) % 3 {
                    0 => arena.slice(3, 0_u8).is_ok() && arena.list::<u16>(0).is_ok(),
                    1 => arena.list::<u64>(5).is_ok() && arena.slice(9, ()).is_ok(),
                    _ => arena.slice(7, [0.0; 3]).is_ok(),
                };
                assert!(fits);
            }
            assert_eq!(arena.used(), demand.bytes());
            assert!(arena.slice(1, 0_u8).is_err());
        }
    }

    #[test]
    fn a_demand_beyond_all_memory_stays_so() {
        assert_eq!(Demand::default().and::<u64>(usize::MAX).and::<u64>(1).bytes(), usize::MAX);
    }
}
