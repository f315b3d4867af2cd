//! Operations of one vector with eight others.

use super::arithmetic::Simd;
use super::lanes::LANES;
use crate::Vec3;

/// Eight vectors in registers, initially one vector in every lane.
#[derive(Clone, Copy)]
pub struct Splat<S: Simd> {
    simd: S,
    x: S::Eight,
    y: S::Eight,
    z: S::Eight,
}

impl<S: Simd> Splat<S> {
    /// Broadcasts a vector to all lanes.
    #[inline(always)]
    pub fn new(simd: S, v: &Vec3) -> Self {
        Self { simd, x: simd.splat(v.x), y: simd.splat(v.y), z: simd.splat(v.z) }
    }

    /// Returns the dot products with eight vectors given as coordinate arrays, bit-identical to `Vec3::dot`.
    #[inline(always)]
    pub fn dot(&self, [x, y, z]: &[[f64; LANES]; 3]) -> S::Eight {
        let simd = self.simd;
        let sum = simd.add(simd.mul(simd.load(x), self.x), simd.mul(simd.load(y), self.y));
        simd.add(sum, simd.mul(simd.load(z), self.z))
    }

    /// Returns the differences from eight other vectors: `self` minus the others.
    #[inline(always)]
    pub fn less(&self, [x, y, z]: &[[f64; LANES]; 3]) -> Self {
        let simd = self.simd;
        Self {
            simd,
            x: simd.sub(self.x, simd.load(x)),
            y: simd.sub(self.y, simd.load(y)),
            z: simd.sub(self.z, simd.load(z)),
        }
    }

    /// Returns the squared lengths, bit-identical to `Vec3::norm_squared`.
    #[inline(always)]
    pub fn norm_squared(&self) -> S::Eight {
        let simd = self.simd;
        let sum = simd.add(simd.mul(self.x, self.x), simd.mul(self.y, self.y));
        simd.add(sum, simd.mul(self.z, self.z))
    }

    /// Returns the squared distances to eight axis-aligned boxes.
    #[inline(always)]
    pub fn distance_square_to_boxes(&self, low: &[[f64; LANES]; 3], high: &[[f64; LANES]; 3]) -> S::Eight {
        let simd = self.simd;
        let beside = |p: S::Eight, axis: usize| {
            let before = simd.sub(simd.load(&low[axis]), p);
            let after = simd.sub(p, simd.load(&high[axis]));
            simd.larger(simd.larger(before, after), simd.splat(0.0))
        };
        Self { simd, x: beside(self.x, 0), y: beside(self.y, 1), z: beside(self.z, 2) }.norm_squared()
    }
}

/// Numbers whose magnitude is below this bound are moderate: sums of squares of products of two of them are
/// finite.
pub const MODERATE: f64 = 1e60;

/// Returns `true` if all components are moderate ([`MODERATE`]).
#[inline(always)]
pub fn is_moderate(v: &Vec3) -> bool {
    (v.x.abs() < MODERATE) & (v.y.abs() < MODERATE) & (v.z.abs() < MODERATE)
}
