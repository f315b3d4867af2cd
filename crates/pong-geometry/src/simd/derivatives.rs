//! Level whose numbers carry derivatives: forward differentiation of the kernels that are written for eight
//! numbers.
//!
//! All lanes of an `Eight` hold the same number; beside it are its derivatives with respect to `N`
//! variables. A kernel that runs at this level gives the values of every other level, and their derivatives.

use super::arithmetic::Simd;
use super::boxes::{BoxSimd, EightBoxes};
use super::lanes::{LANES, LaneBits};
use super::portable::Portable;
use std::f64::consts::LN_2;

/// A number and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The number itself, in any unit.
    pub value: f64,
    /// Its derivatives with respect to `N` variables.
    pub slopes: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// Returns a constant.
    #[inline]
    pub fn constant(value: f64) -> Self {
        Self { value, slopes: [0.0; N] }
    }

    /// Returns a multiple of one of the variables: its derivative is `slope` with respect to this variable.
    #[inline]
    pub fn variable(value: f64, index: usize, slope: f64) -> Self {
        let mut slopes = [0.0; N];
        slopes[index] = slope;
        Self { value, slopes }
    }

    /// Returns a number with the derivatives `f(a', b')`.
    #[inline(always)]
    fn zip(value: f64, a: &Self, b: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self { value, slopes: std::array::from_fn(|k| f(a.slopes[k], b.slopes[k])) }
    }
}

/// Instruction-set level of numbers with `N` derivatives.
///
/// At a step or a kink the derivatives are those of the branch that the values take. Those of a quotient by a
/// number below 1e-140, and of the root of a number below its square, are zero: there the value has no direction.
#[derive(Clone, Copy, Debug)]
pub struct Derivatives<const N: usize>;

/// Divisors below this have no derivatives.
const LEAST_DIVISOR: f64 = 1e-140;

impl<const N: usize> Simd for Derivatives<N> {
    type Eight = Dual<N>;
    type Mask = bool;

    fn splat(self, value: f64) -> Self::Eight {
        Dual::constant(value)
    }
    fn load(self, values: &[f64; LANES]) -> Self::Eight {
        Dual::constant(values[0])
    }
    fn store(self, values: Self::Eight) -> [f64; LANES] {
        [values.value; LANES]
    }
    #[inline(always)]
    fn add(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        Dual::zip(a.value + b.value, &a, &b, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        Dual::zip(a.value - b.value, &a, &b, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        Dual::zip(a.value * b.value, &a, &b, |by_a, by_b| by_a * b.value + a.value * by_b)
    }
    #[inline(always)]
    fn div(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        let quotient = a.value / b.value;
        if b.value.abs() < LEAST_DIVISOR {
            return Dual::constant(quotient);
        }
        // Clamped, as a compiler may divide ahead of the branch.
        let divisor = b.value.abs().max(LEAST_DIVISOR).copysign(b.value);
        Dual::zip(quotient, &a, &b, |by_a, by_b| (by_a - quotient * by_b) / divisor)
    }
    #[inline(always)]
    fn sqrt(self, values: Self::Eight) -> Self::Eight {
        let root = values.value.sqrt();
        if root < LEAST_DIVISOR {
            return Dual::constant(root);
        }
        Dual { value: root, slopes: values.slopes.map(|slope| 0.5 * slope / root.max(LEAST_DIVISOR)) }
    }
    /// The derivatives are those of `values · 2ⁿ` for a real n: a kernel that rounds n subtracts it again.
    #[inline(always)]
    fn scaled(self, values: Self::Eight, power: Self::Eight) -> Self::Eight {
        let scaled = Portable.scaled([values.value; LANES], [power.value; LANES])[0];
        let scale = Portable.scaled([1.0; LANES], [power.value; LANES])[0];
        Dual::zip(scaled, &values, &power, |slope, by_power| scale * slope + scaled * LN_2 * by_power)
    }
    #[inline(always)]
    fn below(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        a.value < b.value
    }
    #[inline(always)]
    fn at_least(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        a.value >= b.value
    }
    #[inline(always)]
    fn equal(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        a.value == b.value
    }
    #[inline(always)]
    fn larger(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        if a.value > b.value { a } else { b }
    }
    #[inline(always)]
    fn smaller(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        if a.value < b.value { a } else { b }
    }
    #[inline(always)]
    fn abs(self, values: Self::Eight) -> Self::Eight {
        if values.value < 0.0 { self.sub(self.splat(0.0), values) } else { values }
    }
    fn largest(self, values: Self::Eight) -> f64 {
        values.value
    }
    #[inline(always)]
    fn bits(self, mask: Self::Mask) -> LaneBits {
        if mask { LaneBits::MAX } else { 0 }
    }
    #[inline(always)]
    fn mask(self, bits: LaneBits) -> Self::Mask {
        bits & 1 == 1
    }
    #[inline(always)]
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask {
        a & b
    }
    #[inline(always)]
    fn select(self, mask: Self::Mask, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        if mask { a } else { b }
    }
}

impl<const N: usize> BoxSimd for Derivatives<N> {
    fn boxes_met(self, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits {
        Portable.boxes_met(boxes, low, high)
    }
    fn boxes_near(self, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits {
        Portable.boxes_near(boxes, place, square)
    }
    fn packed(self, values: &[u32; LANES], bits: LaneBits) -> [u32; LANES] {
        Portable.packed(values, bits)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Numbers;
    use super::*;

    type Number = Numbers<Derivatives<1>>;

    /// Checks the derivative of a function against central differences.
    fn check(name: &str, f: impl Fn(Number) -> Number, places: &[f64]) {
        let at = |x: f64, slope: f64| f(Numbers::of(Derivatives, Dual::variable(x, 0, slope))).eight();
        for &x in places {
            let step = 1e-5 * x.abs().max(1e-3);
            let difference = (at(x + step, 0.0).value - at(x - step, 0.0).value) / (2.0 * step);
            let [slope] = at(x, 1.0).slopes;
            assert!(
                (slope - difference).abs() <= 1e-8 * (1.0 + difference.abs()),
                "{name} at {x}: {slope}, {difference}"
            );
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        check("exp(-z)", |z| z.exp_of_minus(), &[0.1, 0.7, 3.0, 20.0]);
        check("angle", |y| y.angle_above(y.all(0.8)), &[-2.0, -0.3, 0.1, 0.75, 4.0]);
        check("sine", |x| x.sin_cos().0, &[-1.2, 0.3, 1.0]);
        check("cosine", |x| x.sin_cos().1, &[-1.2, 0.3, 1.0]);
        check("root", |x| (x * x + x.all(2.0)).sqrt(), &[-1.0, 0.0, 5.0]);
        check("quotient", |x| (x.all(3.0) - x).over(x * x + x.all(1.0)), &[-1.0, 0.2, 5.0]);
        check("choice", |x| x.larger(x.all(0.5)).smaller(x.all(2.0)).abs(), &[0.1, 1.0, 3.0]);
    }

    #[test]
    fn nothing_is_divided_by_zero() {
        let zero = Numbers::of(Derivatives::<1>, Dual::variable(0.0, 0, 1.0));
        for result in [zero.sqrt(), zero.over(zero), zero.all(1.0).over(zero * zero)] {
            assert!(result.eight().slopes[0].is_finite());
        }
    }
}
