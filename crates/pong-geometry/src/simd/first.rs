//! Search for the maximum of many numbers, and for its first position.

use super::arithmetic::Simd;
use super::lanes::LANES;

/// Search for the maximum of numbers that are offered in blocks of eight. Blocks are counted from 0. Of
/// several equal maxima the first counts.
pub trait Finder<S: Simd>: Copy {
    /// Starts a search for the maximum of all numbers above `floor`.
    fn above(simd: S, floor: f64) -> Self;
    /// Offers a block of eight numbers; blocks must come in increasing order.
    fn offer(&mut self, block: usize, values: S::Eight);
    /// Returns the maximum; `None` if no number was above the floor.
    fn found(self) -> Option<Found>;
}

/// Maximum and its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Block of the maximum.
    pub block: usize,
    /// Lane of the maximum in its block.
    pub lane: usize,
    /// Value, in the unit of the searched numbers; the sign of a zero is arbitrary.
    pub number: f64,
}

impl Found {
    /// Returns the index of the maximum among the numbers of all blocks.
    #[inline(always)]
    pub fn place(&self) -> usize {
        self.block * LANES + self.lane
    }
}

/// Search over any number of blocks, which keeps only the maxima.
#[derive(Clone, Copy)]
pub struct First<S: Simd> {
    simd: S,
    /// Largest number so far in each lane.
    largest: S::Eight,
    /// Block of the largest number in each lane: an integer stored in the bits of an `f64`, moved but never
    /// used in arithmetic.
    block: S::Eight,
}

/// Value of `block` in a lane without a number above the floor.
const NOWHERE: u64 = u64::MAX;

impl<S: Simd> Finder<S> for First<S> {
    #[inline(always)]
    fn above(simd: S, floor: f64) -> Self {
        Self { simd, largest: simd.splat(floor), block: simd.splat(f64::from_bits(NOWHERE)) }
    }

    #[inline(always)]
    fn offer(&mut self, block: usize, values: S::Eight) {
        let simd = self.simd;
        let larger = simd.below(self.largest, values);
        self.largest = simd.select(larger, values, self.largest);
        self.block = simd.select(larger, simd.splat(f64::from_bits(block as u64)), self.block);
    }

    #[inline(always)]
    fn found(self) -> Option<Found> {
        let simd = self.simd;
        let number = simd.largest(self.largest);
        let mut equal = simd.bits(simd.equal(self.largest, simd.splat(number)));
        let blocks = simd.store(self.block).map(f64::to_bits);
        let (mut first, mut lane_of_first) = (NOWHERE, 0);
        while equal != 0 {
            let lane = equal.trailing_zeros() as usize;
            if blocks[lane] < first {
                (first, lane_of_first) = (blocks[lane], lane);
            }
            equal &= equal - 1;
        }
        if first == NOWHERE {
            None
        } else {
            Some(Found { block: first as usize, lane: lane_of_first, number })
        }
    }
}

/// Search over at most `N` blocks (`N` ≤ 8), all of which it keeps until the end. It is faster if the blocks
/// fit into registers.
#[derive(Clone, Copy)]
pub struct FirstOf<S: Simd, const N: usize> {
    simd: S,
    floor: f64,
    kept: [S::Eight; N],
}

impl<S: Simd, const N: usize> Finder<S> for FirstOf<S, N> {
    #[inline(always)]
    fn above(simd: S, floor: f64) -> Self {
        Self { simd, floor, kept: [simd.splat(floor); N] }
    }

    #[inline(always)]
    fn offer(&mut self, block: usize, values: S::Eight) {
        // With this order of operands a NaN never replaces a number.
        self.kept[block] = self.simd.larger(values, self.kept[block]);
    }

    #[inline(always)]
    fn found(self) -> Option<Found> {
        let simd = self.simd;
        let mut top = self.kept[0];
        for &other in &self.kept[1..] {
            top = simd.larger(top, other);
        }
        let number = simd.largest(top);
        let mut equal = 0;
        for (block, &kept) in self.kept.iter().enumerate() {
            equal |= u64::from(simd.bits(simd.equal(kept, simd.splat(number)))) << (block * LANES);
        }
        let place = equal.trailing_zeros() as usize;
        if number > self.floor {
            Some(Found { block: place / LANES, lane: place % LANES, number })
        } else {
            None
        }
    }
}
