//! SIMD operations that every instruction-set level provides, and kernels that run at any level.

use super::boxes::BoxSimd;
use super::lanes::{LANES, LaneBits};

/// Arithmetic on eight numbers.
///
/// Comparisons with NaN are false, as for `f64`.
#[allow(missing_docs)]
pub trait Simd: BoxSimd {
    /// Eight numbers.
    type Eight: Copy;
    /// Eight booleans.
    type Mask: Copy;

    fn splat(self, value: f64) -> Self::Eight;
    fn load(self, values: &[f64; LANES]) -> Self::Eight;
    fn store(self, values: Self::Eight) -> [f64; LANES];
    fn add(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn sub(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    fn div(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// Returns `a / b`, and an arbitrary number where `b` is zero, so that an unused quotient raises no
    /// floating-point exception.
    ///
    /// Where `b` is zero, the divisor is 2. With a divisor of 1, a compiler for AVX-512 would divide by `b`
    /// before it selects, because a/1 = a.
    #[inline(always)]
    fn ratio(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        self.div(a, self.select(self.equal(b, self.splat(0.0)), self.splat(2.0), b))
    }
    fn sqrt(self, values: Self::Eight) -> Self::Eight;
    /// Returns `values · 2ⁿ`, exactly, where `n` is in the lowest twelve bits of `power`. The products must
    /// be normal numbers.
    fn scaled(self, values: Self::Eight, power: Self::Eight) -> Self::Eight;
    /// `a < b`.
    fn below(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    /// `a ≥ b`.
    fn at_least(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    /// `a = b`; the two zeros are equal.
    fn equal(self, a: Self::Eight, b: Self::Eight) -> Self::Mask;
    /// Returns the larger numbers: `if a > b { a } else { b }`.
    fn larger(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// Returns the smaller numbers: `if a < b { a } else { b }`.
    fn smaller(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// Returns the absolute values; that of a NaN has no meaning.
    fn abs(self, values: Self::Eight) -> Self::Eight;
    /// Returns the largest of the eight numbers, none of which may be NaN. The sign of a zero is arbitrary.
    fn largest(self, values: Self::Eight) -> f64;
    fn bits(self, mask: Self::Mask) -> LaneBits;
    fn mask(self, bits: LaneBits) -> Self::Mask;
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Returns `a` where the mask is set, otherwise `b`.
    fn select(self, mask: Self::Mask, a: Self::Eight, b: Self::Eight) -> Self::Eight;
}

/// Function that can run at any instruction-set level. Mark `run` and everything it calls with a [`Simd`]
/// `#[inline(always)]`, because only inlined code uses the instructions of the level. This applies to
/// closures too, for example in `map`; prefer loops and `match`.
pub trait Kernel {
    /// Result type.
    type Output;
    /// Runs the function.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

#[cfg(test)]
mod tests {
    use super::super::{Level, run, set_level};
    use super::*;

    /// Applies every operation to two numbers, in eight lanes.
    struct All<'a>([&'a [f64; LANES]; 2]);

    impl Kernel for All<'_> {
        type Output = ([[f64; LANES]; 8], [LaneBits; 3]);

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> Self::Output {
            let Self([a, b]) = self;
            let (a, b) = (simd.load(a), simd.load(b));
            let below = simd.below(a, b);
            let numbers = [
                simd.store(simd.add(a, b)),
                simd.store(simd.sub(a, b)),
                simd.store(simd.mul(a, b)),
                simd.store(simd.larger(a, b)),
                simd.store(simd.smaller(a, b)),
                simd.store(simd.abs(a)),
                simd.store(simd.select(below, a, b)),
                simd.store(simd.div(a, b)),
            ];
            (numbers, [simd.bits(below), simd.bits(simd.at_least(a, b)), simd.bits(simd.equal(a, b))])
        }
    }

    const EDGES: [f64; 14] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.1,
        -3.7,
        5e-324,
        -f64::MIN_POSITIVE,
        1e300,
        -1e300,
        f64::MAX,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];

    fn plain(a: f64, b: f64) -> [f64; 8] {
        let larger = if a > b { a } else { b };
        let smaller = if a < b { a } else { b };
        [a + b, a - b, a * b, larger, smaller, a.abs(), smaller, a / b]
    }

    /// Compares bits; all NaNs count as equal.
    fn same(found: f64, expected: f64) -> bool {
        found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan()
    }

    #[test]
    fn every_level_does_what_plain_numbers_do() {
        for level in Level::available() {
            set_level(level);
            for a in EDGES {
                for first in 0..EDGES.len() {
                    let b: [f64; LANES] = std::array::from_fn(|lane| EDGES[(first + lane) % EDGES.len()]);
                    let (numbers, truths) = run(All([&[a; LANES], &b]));
                    for (lane, &b) in b.iter().enumerate() {
                        for (number, expected) in numbers.iter().zip(plain(a, b)) {
                            assert!(same(number[lane], expected), "{level:?}: {a} and {b}: {numbers:?}");
                        }
                        let told = truths.map(|bits| bits >> lane & 1 == 1);
                        assert_eq!(told, [a < b, a >= b, a == b], "{level:?}: {a} and {b}");
                    }
                }
            }
        }
        set_level(Level::best());
    }
}
