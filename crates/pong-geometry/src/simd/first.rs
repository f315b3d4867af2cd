//! The largest of many numbers, and where it stands first.

use super::Simd;

/// The largest of the numbers offered so far, lane by lane. Of equal ones the first counts.
#[derive(Clone, Copy)]
pub struct First<S: Simd> {
    simd: S,
    largest: S::Eight,
    /// Where it was offered: an integer in the bits of a number, moved about but never calculated with.
    place: S::Eight,
}

/// Stands for no place.
const NOWHERE: u64 = u64::MAX;

impl<S: Simd> First<S> {
    /// Nothing yet: only numbers above `floor` count.
    #[inline(always)]
    pub fn above(simd: S, floor: f64) -> Self {
        Self { simd, largest: simd.splat(floor), place: simd.splat(f64::from_bits(NOWHERE)) }
    }

    /// Eight more, in rising order of places.
    #[inline(always)]
    pub fn offer(&mut self, place: usize, values: S::Eight) {
        let simd = self.simd;
        let larger = simd.below(self.largest, values);
        self.largest = simd.select(larger, values, self.largest);
        self.place = simd.select(larger, simd.splat(f64::from_bits(place as u64)), self.place);
    }

    /// The first place of the largest number, and that number; `None` if nothing counted.
    #[inline(always)]
    pub fn place(self) -> Option<(usize, f64)> {
        let simd = self.simd;
        let largest = simd.largest(self.largest);
        let mut equal = simd.bits(simd.equal(self.largest, simd.splat(largest)));
        let places = simd.store(self.place).map(f64::to_bits);
        let mut first = NOWHERE;
        while equal != 0 {
            first = first.min(places[equal.trailing_zeros() as usize]);
            equal &= equal - 1;
        }
        (first != NOWHERE).then_some((first as usize, largest))
    }
}
