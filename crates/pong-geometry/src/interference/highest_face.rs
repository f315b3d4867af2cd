//! Search for the active face above which a point is highest, in one pass over the planes of a polyhedron.
//! For a point inside, it is the face below which the point is least deep.

use crate::Vec3;
use crate::primitive::{FacePlanes, PlaneBlock};
use crate::simd::{Finder, First, Found, LANES, LaneBits, Simd, Splat};

/// Number of blocks whose heights are kept in registers at a time.
const MANY: usize = 4;

/// Active face above which a point is highest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Highest {
    /// Face index; among faces of equal height the lowest.
    pub face: usize,
    /// Height, m; the sign of a zero is arbitrary.
    pub height: f64,
}

/// Condition that the point must meet for a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Whereabouts {
    Anywhere,
    /// The height above every plane is less than this, m.
    Below(f64),
}

/// Returns the active face above which `p` is highest. `None` if `p` does not meet the condition, if no face
/// is active, or if all heights are −∞ or NaN.
#[inline(always)]
pub(super) fn highest_of_many<S: Simd>(
    simd: S,
    p: &Vec3,
    planes: &FacePlanes,
    whereabouts: Whereabouts,
) -> Option<Highest> {
    let search = Search { simd, at: Splat::new(simd, p), planes, whereabouts };
    if planes.blocks.len() <= MANY {
        return search.highest_of_group::<MANY>(0);
    }
    let mut first = First::<S>::above(simd, f64::NEG_INFINITY);
    for start in (0..planes.blocks.len()).step_by(MANY) {
        first.offer(start, search.top(&search.heights::<MANY>(start)?));
    }
    let Found { block: start, number: height, .. } = first.found()?;
    search.first_at(&search.heights::<MANY>(start)?, start, height)
}

#[derive(Clone, Copy)]
struct Search<'a, S: Simd> {
    simd: S,
    at: Splat<S>,
    planes: &'a FacePlanes,
    whereabouts: Whereabouts,
}

impl<S: Simd> Search<'_, S> {
    /// Returns the heights of the point above the planes of `N` blocks from `start` on, −∞ for inactive
    /// faces. Beyond the last block, that block is repeated. `None` if the point does not meet the condition.
    #[inline(always)]
    fn heights<const N: usize>(&self, start: usize) -> Option<[S::Eight; N]> {
        let blocks = self.planes.blocks.as_slice();
        let mut heights = [self.simd.splat(f64::NEG_INFINITY); N];
        let mut passes = LaneBits::MAX;
        for (k, heights) in heights.iter_mut().enumerate() {
            let block = blocks.get((start + k).min(blocks.len() - 1))?;
            let all = block.heights(self.simd, &self.at);
            passes &= self.passes(all);
            *heights = if self.planes.simple { all } else { self.active(block, all) };
        }
        if passes == LaneBits::MAX { Some(heights) } else { None }
    }

    /// Returns the planes for which the point meets the condition.
    #[inline(always)]
    fn passes(&self, heights: S::Eight) -> LaneBits {
        let simd = self.simd;
        match self.whereabouts {
            Whereabouts::Anywhere => LaneBits::MAX,
            Whereabouts::Below(reach) => !simd.bits(simd.at_least(heights, simd.splat(reach))),
        }
    }

    #[inline(always)]
    fn active(&self, block: &PlaneBlock, heights: S::Eight) -> S::Eight {
        self.simd.select(self.simd.mask(block.active), heights, self.simd.splat(f64::NEG_INFINITY))
    }

    #[inline(always)]
    fn top<const N: usize>(&self, heights: &[S::Eight; N]) -> S::Eight {
        let mut top = heights[0];
        for &other in &heights[1..] {
            top = self.simd.larger(top, other);
        }
        top
    }

    /// Returns the first face with the given height among `N` blocks from `start` on; `None` if there is
    /// none.
    #[inline(always)]
    fn first_at<const N: usize>(
        &self,
        heights: &[S::Eight; N],
        start: usize,
        height: f64,
    ) -> Option<Highest> {
        let wanted = self.simd.splat(height);
        let mut equal = 0;
        for (k, &heights) in heights.iter().enumerate() {
            equal |= u64::from(self.simd.bits(self.simd.equal(heights, wanted))) << (k * LANES);
        }
        let face = start * LANES + equal.trailing_zeros() as usize;
        if equal != 0 && height > f64::NEG_INFINITY { Some(Highest { face, height }) } else { None }
    }

    #[inline(always)]
    fn highest_of_group<const N: usize>(&self, start: usize) -> Option<Highest> {
        let heights = self.heights::<N>(start)?;
        self.first_at(&heights, start, self.simd.largest(self.top(&heights)))
    }
}
