//! Elementary functions of eight numbers. Only +, −, ×, ÷ and √ are used, so every machine gives the same
//! bits.
//!
//! The relative error of each is below 6·10⁻¹⁶, except for the cosine near a right angle, whose absolute
//! error is below 10⁻¹⁵.

use super::arithmetic::Simd;
use super::numbers::Numbers;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LN_2, LOG2_E};

impl<S: Simd> Numbers<S> {
    /// Returns exp(−z) for z ≥ 0; for z > 700 the value at 700, about 10⁻³⁰⁴.
    ///
    /// With −z = n·ln 2 + r and |r| ≤ ½·ln 2, the result is 2ⁿ times the series of exp(r).
    #[inline(always)]
    pub fn exp_of_minus(self) -> Self {
        const LARGEST: f64 = 700.0;
        /// Number whose addition rounds to an integer, which is then in the lowest bits of the sum.
        const ROUNDER: f64 = 1.5 * (1_u64 << 52) as f64;
        /// Upper 32 bits of ln 2, so that products with n are exact; `LN_2_LOW` is the remainder.
        const LN_2_HIGH: f64 = f64::from_bits(LN_2.to_bits() & !0x1F_FFFF);
        const LN_2_LOW: f64 = 1.9082149292705877e-10;
        let minus = -self.smaller(self.all(LARGEST));
        let power = minus * self.all(LOG2_E) + self.all(ROUNDER);
        let whole = power - self.all(ROUNDER);
        let rest = minus - whole * self.all(LN_2_HIGH) - whole * self.all(LN_2_LOW);
        rest.series(&EXPONENTIAL).scaled(power)
    }

    /// Returns the angle of the point (x, self) from the x axis, for x ≥ 0. It is in −π/2 to π/2, and 0 for
    /// the origin.
    ///
    /// The arctangent of a slope up to 1 is reduced to that of a slope up to tan(π/8).
    #[inline(always)]
    pub fn angle_above(self, x: Self) -> Self {
        const TANGENT_OF_EIGHTH: f64 = 0.414_213_562_373_095_03;
        let one = self.all(1.0);
        let height = self.abs();
        let is_steep = x.below(height);
        let slope = height.smaller(x).over(height.larger(x));
        let is_over = self.all(TANGENT_OF_EIGHTH).below(slope);
        let less = (slope - one).over(slope + one);
        let small = Self::select(is_over, less, slope);
        let angle = small * (small * small).series(&ARCTANGENT);
        let angle = Self::select(is_over, angle + self.all(FRAC_PI_4), angle);
        let angle = Self::select(is_steep, self.all(FRAC_PI_2) - angle, angle);
        Self::select(self.below(self.all(0.0)), -angle, angle)
    }

    /// Returns sine and cosine of angles from −π/2 to π/2, computed from those of half the angle.
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        let half = self * self.all(0.5);
        let square = half * half;
        let sine = half * square.series(&SINE);
        let cosine = square.series(&COSINE);
        let two = self.all(2.0);
        (two * sine * cosine, self.all(1.0) - two * sine * sine)
    }

    /// Returns the polynomial Σ cₖ·selfᵏ.
    #[inline(always)]
    pub fn series<const N: usize>(self, coefficients: &[f64; N]) -> Self {
        let mut sum = self.all(coefficients[N - 1]);
        for k in (0..N - 1).rev() {
            sum = sum * self + self.all(coefficients[k]);
        }
        sum
    }
}

/// Coefficients of exp(x): 1/k!.
const EXPONENTIAL: [f64; 14] = {
    let mut coefficients = [1.0; 14];
    let mut k = 1;
    while k < 14 {
        coefficients[k] = coefficients[k - 1] / k as f64;
        k += 1;
    }
    coefficients
};

/// Coefficients of sin(x)/x in x²: (−1)ᵏ/(2k + 1)!.
const SINE: [f64; 10] = alternating(1);

/// Coefficients of cos(x) in x²: (−1)ᵏ/(2k)!.
const COSINE: [f64; 10] = alternating(0);

/// Returns the coefficients (−1)ᵏ/(2k + odd)!.
const fn alternating(odd: u32) -> [f64; 10] {
    let mut coefficients = [1.0; 10];
    let mut k = 1;
    while k < 10 {
        let last = 2 * k as u32 + odd;
        coefficients[k] = -coefficients[k - 1] / ((last - 1) * last) as f64;
        k += 1;
    }
    coefficients
}

/// Coefficients of arctan(t)/t as a polynomial in t² up to tan²(π/8), fitted with 50 digits at Chebyshev
/// nodes. The error is below 4·10⁻¹⁷.
const ARCTANGENT: [f64; 11] = [
    1.0,
    -0.3333333333332844,
    0.1999999999885511,
    -0.14285714180976467,
    0.11111106180455946,
    -0.09090773074808414,
    0.07689953496306857,
    -0.06640233930429408,
    0.056883492268090106,
    -0.04348052215716462,
    0.021135373157693246,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{Kernel, run};
    use crate::simd::{LANES, Level, Portable, level, set_level};

    struct Each<'a, F> {
        values: &'a [f64; LANES],
        others: &'a [f64; LANES],
        function: F,
    }

    #[derive(Clone, Copy)]
    enum Function {
        Exp,
        Angle,
        Sine,
        Cosine,
    }

    impl Kernel for Each<'_, Function> {
        type Output = [f64; LANES];

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> [f64; LANES] {
            let values = Numbers::load(simd, self.values);
            match self.function {
                Function::Exp => values.exp_of_minus().store(),
                Function::Angle => values.angle_above(Numbers::load(simd, self.others)).store(),
                Function::Sine => values.sin_cos().0.store(),
                Function::Cosine => values.sin_cos().1.store(),
            }
        }
    }

    /// Checks a function at many arguments and at every level: close to `libm`, and bit-identical between
    /// levels.
    fn check(
        function: Function,
        argument: impl Fn(f64) -> [f64; 2],
        exact: impl Fn(f64, f64) -> f64,
        error_max: impl Fn(f64) -> f64,
    ) {
        const STEPS: usize = 40_000;
        let before = level();
        for step in 0..STEPS {
            let (mut values, mut others) = ([0.0; LANES], [0.0; LANES]);
            for lane in 0..LANES {
                let [value, other] = argument((step * LANES + lane) as f64 / (STEPS * LANES - 1) as f64);
                (values[lane], others[lane]) = (value, other);
            }
            let portable = Each { values: &values, others: &others, function }.run(Portable);
            for lane in 0..LANES {
                let wanted = exact(values[lane], others[lane]);
                let error = (portable[lane] - wanted).abs();
                assert!(error <= error_max(wanted), "{}: {error:e}", values[lane]);
            }
            for level in Level::available() {
                set_level(level);
                let got = run(Each { values: &values, others: &others, function });
                assert_eq!(got.map(f64::to_bits), portable.map(f64::to_bits), "{level:?} at {values:?}");
            }
        }
        set_level(before);
    }

    /// Largest error, relative to the exact value.
    fn relative(slack: f64) -> impl Fn(f64) -> f64 {
        move |exact| slack * exact.abs().max(f64::MIN_POSITIVE)
    }

    #[test]
    fn the_exponential_is_that_of_the_library() {
        check(Function::Exp, |part| [part, 0.0], |z, _| libm::exp(-z), relative(4e-16));
        check(Function::Exp, |part| [part * 700.0, 0.0], |z, _| libm::exp(-z), relative(4e-16));
        check(Function::Exp, |part| [part * 1e-9, 0.0], |z, _| libm::exp(-z), relative(4e-16));
    }

    #[test]
    fn beyond_its_range_the_exponential_is_the_least() {
        check(Function::Exp, |part| [700.0 + part * 1e300, 0.0], |_, _| libm::exp(-700.0), relative(4e-16));
    }

    #[test]
    fn the_angle_is_that_of_the_library() {
        let round = |part: f64| {
            let (sine, cosine) = libm::sincos((part - 0.5) * std::f64::consts::PI);
            [sine, cosine.abs()]
        };
        check(Function::Angle, round, libm::atan2, relative(6e-16));
        check(Function::Angle, |part| round(part).map(|x| x * 1e-150), libm::atan2, relative(6e-16));
        check(Function::Angle, |part| [part * 1e-12, 1.0], libm::atan2, relative(6e-16));
        check(Function::Angle, |_| [0.0, 0.0], |_, _| 0.0, relative(0.0));
        check(Function::Angle, |part| [part - 0.5, 0.0], libm::atan2, relative(6e-16));
    }

    #[test]
    fn sine_and_cosine_are_those_of_the_library() {
        let angle = |part: f64| [(part - 0.5) * std::f64::consts::PI, 0.0];
        check(Function::Sine, angle, |x, _| libm::sin(x), relative(6e-16));
        check(Function::Sine, |part| [part * 1e-9, 0.0], |x, _| libm::sin(x), relative(6e-16));
        // Near a right angle the cosine is a difference of numbers of order one.
        check(Function::Cosine, |part| [part - 0.5, 0.0], |x, _| libm::cos(x), relative(4e-16));
        check(Function::Cosine, angle, |x, _| libm::cos(x), |_| 1e-15);
    }
}
