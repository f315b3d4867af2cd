//! Double-double numbers: the unevaluated sum of two `f64`, the second at most half a unit in the last place
//! of the first.
//!
//! Sums and products of two `f64` are error-free (Knuth, Dekker, Veltkamp; T. J. Dekker, "A floating-point
//! technique for extending the available precision", 1971). Only plain operations are used, so the bits are
//! the same on every machine.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with about 31 decimal digits.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(super) struct Twofold {
    high: f64,
    low: f64,
}

impl Twofold {
    /// Exact sum of two numbers.
    pub fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let of_b = high - a;
        Self { high, low: (a - (high - of_b)) + (b - of_b) }
    }

    /// Nearest `f64`.
    pub fn value(self) -> f64 {
        self.high
    }

    /// Exact product of two numbers.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let ([a1, a2], [b1, b2]) = (halves(a), halves(b));
        Self { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
    }

    /// Exact sum for |a| ≥ |b|, or a = 0.
    fn quick_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }
}

/// Splits a number into two of half the digits.
fn halves(a: f64) -> [f64; 2] {
    /// The splitting constant 2^27 + 1.
    const SPLITTER: f64 = 134_217_729.0;
    let scaled = SPLITTER * a;
    let upper = scaled - (scaled - a);
    [upper, a - upper]
}

impl From<f64> for Twofold {
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

impl Neg for Twofold {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for Twofold {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let upper = Self::quick_sum(high.high, high.low + low.high);
        Self::quick_sum(upper.high, upper.low + low.low)
    }
}

impl Sub for Twofold {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::quick_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Twofold {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        Self::quick_sum(first, second) + Self::from(rest.high / other.high)
    }
}
