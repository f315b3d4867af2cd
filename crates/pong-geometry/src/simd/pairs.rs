//! Levels with two numbers per instruction: eight numbers are four registers of 128 bits. [`Registers`] is what a
//! processor has; `neon.rs` (AArch64) and `simd128.rs` (WebAssembly) say it in the processor's instructions.

use super::arithmetic::Simd;
use super::boxes::{BoxSimd, EightBoxes};
use super::lanes::{LANES, LaneBits};
use super::portable::Portable;

/// Operations on registers of 128 bits: two numbers in double precision, or four in single precision. Comparisons
/// with NaN are false.
pub(super) trait Registers: Copy {
    /// Two numbers in double precision.
    type Two: Copy;
    /// Two booleans, as words with all or no bits set.
    type TwoMarks: Copy;
    /// Four numbers in single precision.
    type Four: Copy;
    /// Four booleans, as words with all or no bits set.
    type FourMarks: Copy;

    fn splat(self, value: f64) -> Self::Two;
    fn load(self, values: [f64; 2]) -> Self::Two;
    fn store(self, values: Self::Two) -> [f64; 2];
    fn add(self, a: Self::Two, b: Self::Two) -> Self::Two;
    fn sub(self, a: Self::Two, b: Self::Two) -> Self::Two;
    fn mul(self, a: Self::Two, b: Self::Two) -> Self::Two;
    fn div(self, a: Self::Two, b: Self::Two) -> Self::Two;
    fn sqrt(self, values: Self::Two) -> Self::Two;
    fn abs(self, values: Self::Two) -> Self::Two;
    /// Adds the lowest twelve bits of `power` to the exponents, as integers.
    fn scaled(self, values: Self::Two, power: Self::Two) -> Self::Two;
    /// `a < b`.
    fn below(self, a: Self::Two, b: Self::Two) -> Self::TwoMarks;
    /// `a ≥ b`.
    fn at_least(self, a: Self::Two, b: Self::Two) -> Self::TwoMarks;
    fn equal(self, a: Self::Two, b: Self::Two) -> Self::TwoMarks;
    fn and(self, a: Self::TwoMarks, b: Self::TwoMarks) -> Self::TwoMarks;
    /// Returns `a` where marked, otherwise `b`.
    fn select(self, marks: Self::TwoMarks, a: Self::Two, b: Self::Two) -> Self::Two;
    /// Returns marks from words with all or no bits set.
    fn marks(self, words: [u64; 2]) -> Self::TwoMarks;
    /// Returns one bit for each of the eight marks; the lowest is that of the first.
    fn bits(self, marks: [Self::TwoMarks; 4]) -> LaneBits;

    fn splat_single(self, value: f32) -> Self::Four;
    fn load_single(self, values: [f32; 4]) -> Self::Four;
    fn add_single(self, a: Self::Four, b: Self::Four) -> Self::Four;
    fn sub_single(self, a: Self::Four, b: Self::Four) -> Self::Four;
    fn mul_single(self, a: Self::Four, b: Self::Four) -> Self::Four;
    /// Returns the larger numbers: `if a > b { a } else { b }`.
    fn larger_single(self, a: Self::Four, b: Self::Four) -> Self::Four;
    /// `a < b`.
    fn below_single(self, a: Self::Four, b: Self::Four) -> Self::FourMarks;
    /// `a ≤ b`.
    fn at_most_single(self, a: Self::Four, b: Self::Four) -> Self::FourMarks;
    fn or_single(self, a: Self::FourMarks, b: Self::FourMarks) -> Self::FourMarks;
    /// Returns one bit for each of the eight marks; the lowest is that of the first.
    fn bits_single(self, marks: [Self::FourMarks; 2]) -> LaneBits;
}

/// Level of a processor with registers of 128 bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pairs<R>(pub R);

/// Applies `f` to each of four registers.
#[inline(always)]
fn zip<A: Copy, B: Copy>(a: [A; 4], b: [A; 4], f: impl Fn(A, A) -> B) -> [B; 4] {
    [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])]
}

impl<R: Registers> Simd for Pairs<R> {
    type Eight = [R::Two; 4];
    type Mask = [R::TwoMarks; 4];

    #[inline(always)]
    fn splat(self, value: f64) -> Self::Eight {
        [self.0.splat(value); 4]
    }
    #[inline(always)]
    fn load(self, v: &[f64; LANES]) -> Self::Eight {
        let two = |first: usize| self.0.load([v[first], v[first + 1]]);
        [two(0), two(2), two(4), two(6)]
    }
    #[inline(always)]
    fn store(self, values: Self::Eight) -> [f64; LANES] {
        let [[a, b], [c, d], [e, f], [g, h]] = values.map(|two| self.0.store(two));
        [a, b, c, d, e, f, g, h]
    }
    #[inline(always)]
    fn add(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| self.0.add(a, b))
    }
    #[inline(always)]
    fn sub(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| self.0.sub(a, b))
    }
    #[inline(always)]
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| self.0.mul(a, b))
    }
    #[inline(always)]
    fn div(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| self.0.div(a, b))
    }
    #[inline(always)]
    fn sqrt(self, values: Self::Eight) -> Self::Eight {
        values.map(|two| self.0.sqrt(two))
    }
    #[inline(always)]
    fn scaled(self, values: Self::Eight, power: Self::Eight) -> Self::Eight {
        zip(values, power, |values, power| self.0.scaled(values, power))
    }
    #[inline(always)]
    fn below(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        zip(a, b, |a, b| self.0.below(a, b))
    }
    #[inline(always)]
    fn at_least(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        zip(a, b, |a, b| self.0.at_least(a, b))
    }
    #[inline(always)]
    fn equal(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        zip(a, b, |a, b| self.0.equal(a, b))
    }
    #[inline(always)]
    fn larger(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| self.0.select(self.0.below(b, a), a, b))
    }
    #[inline(always)]
    fn smaller(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| self.0.select(self.0.below(a, b), a, b))
    }
    #[inline(always)]
    fn abs(self, values: Self::Eight) -> Self::Eight {
        values.map(|two| self.0.abs(two))
    }
    #[inline(always)]
    fn largest(self, [a, b, c, d]: Self::Eight) -> f64 {
        let larger = |a, b| self.0.select(self.0.below(b, a), a, b);
        let [first, second] = self.0.store(larger(larger(a, b), larger(c, d)));
        if first > second { first } else { second }
    }
    #[inline(always)]
    fn mask(self, bits: LaneBits) -> Self::Mask {
        let word = |lane: usize| u64::from(bits >> lane & 1).wrapping_neg();
        let two = |first: usize| self.0.marks([word(first), word(first + 1)]);
        [two(0), two(2), two(4), two(6)]
    }
    #[inline(always)]
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask {
        zip(a, b, |a, b| self.0.and(a, b))
    }
    #[inline(always)]
    fn bits(self, mask: Self::Mask) -> LaneBits {
        self.0.bits(mask)
    }
    #[inline(always)]
    fn select(self, mask: Self::Mask, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        let two = |i: usize| self.0.select(mask[i], a[i], b[i]);
        [two(0), two(1), two(2), two(3)]
    }
}

impl<R: Registers> Pairs<R> {
    /// Loads numbers 0 to 3, or 4 to 7.
    #[inline(always)]
    fn half(self, values: &[f32; LANES], half: usize) -> R::Four {
        let first = 4 * half;
        self.0.load_single([values[first], values[first + 1], values[first + 2], values[first + 3]])
    }
}

impl<R: Registers> BoxSimd for Pairs<R> {
    #[inline(always)]
    fn boxes_met(self, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits {
        let ([least, greatest], r) = (boxes, self.0);
        let along = |half: usize, axis: usize| {
            let beyond = r.below_single(r.splat_single(high[axis]), self.half(&least[axis], half));
            let before = r.below_single(self.half(&greatest[axis], half), r.splat_single(low[axis]));
            r.or_single(beyond, before)
        };
        let apart = |half| r.or_single(r.or_single(along(half, 0), along(half, 1)), along(half, 2));
        !r.bits_single([apart(0), apart(1)])
    }

    #[inline(always)]
    fn boxes_near(self, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits {
        let ([least, greatest], r) = (boxes, self.0);
        let square_along = |half: usize, axis: usize| {
            let place = r.splat_single(place[axis]);
            let before = r.sub_single(self.half(&least[axis], half), place);
            let after = r.sub_single(place, self.half(&greatest[axis], half));
            let beside = r.larger_single(r.larger_single(before, after), r.splat_single(0.0));
            r.mul_single(beside, beside)
        };
        let near = |half| {
            let across = r.add_single(square_along(half, 0), square_along(half, 1));
            r.at_most_single(r.add_single(across, square_along(half, 2)), r.splat_single(square))
        };
        r.bits_single([near(0), near(1)])
    }

    #[inline(always)]
    fn packed(self, values: &[u32; LANES], bits: LaneBits) -> [u32; LANES] {
        Portable.packed(values, bits)
    }
}
