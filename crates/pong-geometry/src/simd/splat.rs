//! One vector against eight others.

use super::{LANES, Simd};
use crate::Vec3;

/// A vector, eight times.
#[derive(Clone, Copy)]
pub struct Splat<S: Simd> {
    simd: S,
    x: S::Eight,
    y: S::Eight,
    z: S::Eight,
}

impl<S: Simd> Splat<S> {
    /// Of a vector.
    #[inline(always)]
    pub fn new(simd: S, v: &Vec3) -> Self {
        Self { simd, x: simd.splat(v.x), y: simd.splat(v.y), z: simd.splat(v.z) }
    }

    /// Its products with eight vectors, coordinate by coordinate, in the bits of `Vec3::dot`.
    #[inline(always)]
    pub fn dot(&self, [x, y, z]: &[[f64; LANES]; 3]) -> S::Eight {
        let simd = self.simd;
        let sum = simd.add(simd.mul(simd.load(x), self.x), simd.mul(simd.load(y), self.y));
        simd.add(sum, simd.mul(simd.load(z), self.z))
    }
}

/// Numbers up to this size have squares of products of two, and sums of these, that are finite.
pub const MODERATE: f64 = 1e60;

/// Whether squares of products of the components with other such numbers are finite.
#[inline(always)]
pub fn is_moderate(v: &Vec3) -> bool {
    (v.x.abs() < MODERATE) & (v.y.abs() < MODERATE) & (v.z.abs() < MODERATE)
}
