//! What every level can do, and what is done at any of them.

use super::boxes::BoxSimd;
use super::lanes::{LANES, LaneBits};

/// Arithmetic on eight numbers.
///
/// Comparisons with a NaN are false, as they are for `f64`.
#[allow(missing_docs)]
pub trait Simd: BoxSimd {
    /// Eight numbers.
    type Eight: Copy;
    /// Eight truths.
    type Mask: Copy;

    fn splat(self, value: f64) -> Self::Eight;
    fn load(self, values: &[f64; LANES]) -> Self::Eight;
    fn store(self, values: Self::Eight) -> [f64; LANES];
    fn add(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn sub(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn div(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// `a / b`, and a number of no meaning where `b` is zero: a quotient that nobody looks at must not raise a floating-point
    /// exception.
    ///
    /// By two, as by one a quotient is its numerator: for AVX-512 a compiler then divides by `b` in every lane, and chooses
    /// afterwards.
    #[inline(always)]
    fn ratio(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        self.div(a, self.select(self.equal(b, self.splat(0.0)), self.splat(2.0), b))
    }
    fn sqrt(self, values: Self::Eight) -> Self::Eight;
    /// `values · 2ⁿ`, exactly, with `n` in the lowest twelve bits of the other number. The products must be normal numbers.
    fn scaled(self, values: Self::Eight, power: Self::Eight) -> Self::Eight;
    /// `a < b`.
    fn below(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    /// `a ≥ b`.
    fn at_least(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    /// `a = b`; the two zeros are equal.
    fn equal(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    /// The larger: `if a > b { a } else { b }`.
    fn larger(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// The largest of the eight, where none is a NaN; of two zeros either.
    fn largest(self, values: Self::Eight) -> f64;
    fn bits(self, mask: Self::Mask) -> LaneBits;
    fn mask(self, bits: LaneBits) -> Self::Mask;
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `a` where the mask holds, else `b`.
    fn select(self, mask: Self::Mask, a: Self::Eight, b: Self::Eight) -> Self::Eight;
}

/// Work that can be done at any level. Mark `run` and all that it calls with a [`Simd`] `#[inline(always)]`:
/// instructions of a level are used only in what is inlined. That goes for closures too, those handed to `map` among
/// them: loops and `match` do better.
pub trait Kernel {
    /// What it hands back.
    type Output;
    /// Does the work.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}
