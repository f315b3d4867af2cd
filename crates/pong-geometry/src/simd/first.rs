//! The largest of many numbers, and where it stands first.

use super::arithmetic::Simd;
use super::lanes::LANES;

/// Takes numbers, eight at a time in blocks that are counted from 0, and finds the largest; of equal ones the first.
pub trait Finder<S: Simd>: Copy {
    /// Nothing yet: only numbers above `floor` count.
    fn above(simd: S, floor: f64) -> Self;
    /// Eight more, in rising order of blocks.
    fn offer(&mut self, block: usize, values: S::Eight);
    /// The largest number; `None` if nothing counted.
    fn found(self) -> Option<Found>;
}

/// The largest number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Its block.
    pub block: usize,
    /// Its lane there.
    pub lane: usize,
    /// The number, in the unit of what was searched; of two zeros either.
    pub number: f64,
}

impl Found {
    /// Its place over all blocks.
    #[inline(always)]
    pub fn place(&self) -> usize {
        self.block * LANES + self.lane
    }
}

/// Finds among any number of blocks.
#[derive(Clone, Copy)]
pub struct First<S: Simd> {
    simd: S,
    /// The largest so far, lane by lane.
    largest: S::Eight,
    /// The block in which it was offered: an integer in the bits of a number, moved about but never calculated with.
    block: S::Eight,
}

/// Stands for no block.
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

/// Finds among at most `N` blocks, up to eight, which it keeps: faster where they fit into registers.
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
        // No number is put before a NaN.
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
