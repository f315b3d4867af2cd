//! Eight numbers and eight vectors, with the operators of a single number or vector.

use super::arithmetic::Simd;
use super::lanes::LANES;
use crate::Vec3;
use std::ops::{Add, Mul, Neg, Sub};

/// Eight numbers in registers.
#[derive(Clone, Copy)]
pub struct Numbers<S: Simd> {
    simd: S,
    eight: S::Eight,
}

impl<S: Simd> Numbers<S> {
    /// Broadcasts one number to all lanes.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, eight: simd.splat(value) }
    }

    /// Loads eight numbers.
    #[inline(always)]
    pub fn load(simd: S, values: &[f64; LANES]) -> Self {
        Self { simd, eight: simd.load(values) }
    }

    /// Stores the numbers to an array.
    #[inline(always)]
    pub fn store(self) -> [f64; LANES] {
        self.simd.store(self.eight)
    }

    /// Numbers from the type that [`Simd`] operates on.
    #[inline(always)]
    pub fn of(simd: S, eight: S::Eight) -> Self {
        Self { simd, eight }
    }

    /// Returns the numbers as the type that [`Simd`] operates on.
    #[inline(always)]
    pub fn eight(self) -> S::Eight {
        self.eight
    }

    /// Broadcasts one number to all lanes, at the level of `self`.
    #[inline(always)]
    pub fn all(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// Returns `self / divisor` for non-negative divisors. A divisor below the smallest normal number is
    /// replaced by that number.
    ///
    /// Lanes whose quotient is not used are treated in the same way, because a division by zero would raise a
    /// floating-point exception there as well.
    #[inline(always)]
    pub fn over(self, divisor: Self) -> Self {
        let divisor = divisor.larger(self.all(f64::MIN_POSITIVE));
        Self { eight: self.simd.div(self.eight, divisor.eight), ..self }
    }

    /// Returns the square roots of non-negative numbers.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { eight: self.simd.sqrt(self.eight), ..self }
    }

    /// Returns `if self > other { self } else { other }`.
    #[inline(always)]
    pub fn larger(self, other: Self) -> Self {
        Self { eight: self.simd.larger(self.eight, other.eight), ..self }
    }

    /// Returns `if self < other { self } else { other }`.
    #[inline(always)]
    pub fn smaller(self, other: Self) -> Self {
        Self { eight: self.simd.smaller(self.eight, other.eight), ..self }
    }

    /// Returns the absolute values.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { eight: self.simd.abs(self.eight), ..self }
    }

    /// Returns the lanes in which `self < other`.
    #[inline(always)]
    pub fn below(self, other: Self) -> S::Mask {
        self.simd.below(self.eight, other.eight)
    }

    /// Returns the lanes in which `self ≥ other`.
    #[inline(always)]
    pub fn at_least(self, other: Self) -> S::Mask {
        self.simd.at_least(self.eight, other.eight)
    }

    /// Returns `a` where the mask is set, otherwise `b`.
    #[inline(always)]
    pub fn select(mask: S::Mask, a: Self, b: Self) -> Self {
        Self { eight: a.simd.select(mask, a.eight, b.eight), ..a }
    }

    /// Returns `self · 2ⁿ`, exactly. `power` is the number `n + 1.5·2⁵²`, whose lowest bits contain `n`. The
    /// products must be normal numbers.
    #[inline(always)]
    pub(super) fn scaled(self, power: Self) -> Self {
        Self { eight: self.simd.scaled(self.eight, power.eight), ..self }
    }
}

impl<S: Simd> Add for Numbers<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { eight: self.simd.add(self.eight, other.eight), ..self }
    }
}

impl<S: Simd> Sub for Numbers<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { eight: self.simd.sub(self.eight, other.eight), ..self }
    }
}

impl<S: Simd> Mul for Numbers<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { eight: self.simd.mul(self.eight, other.eight), ..self }
    }
}

/// Computes zero minus the number, so that the negative of zero is +0.
impl<S: Simd> Neg for Numbers<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.all(0.0) - self
    }
}

/// Length up to which a vector has no direction, because the squares of its coordinates lose precision.
const SHORTEST: f64 = 1e-150;

/// Eight vectors in registers.
#[derive(Clone, Copy)]
#[allow(missing_docs)]
pub struct Vectors<S: Simd> {
    pub x: Numbers<S>,
    pub y: Numbers<S>,
    pub z: Numbers<S>,
}

impl<S: Simd> Vectors<S> {
    /// Broadcasts one vector to all lanes.
    #[inline(always)]
    pub fn splat(simd: S, v: &Vec3) -> Self {
        Self { x: Numbers::splat(simd, v.x), y: Numbers::splat(simd, v.y), z: Numbers::splat(simd, v.z) }
    }

    /// Loads eight vectors from coordinate arrays.
    #[inline(always)]
    pub fn load(simd: S, [x, y, z]: &[[f64; LANES]; 3]) -> Self {
        Self { x: Numbers::load(simd, x), y: Numbers::load(simd, y), z: Numbers::load(simd, z) }
    }

    /// Stores the vectors to coordinate arrays.
    #[inline(always)]
    pub fn store(self) -> [[f64; LANES]; 3] {
        [self.x.store(), self.y.store(), self.z.store()]
    }

    /// Returns the dot products with other vectors.
    #[inline(always)]
    pub fn dot(self, other: Self) -> Numbers<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Returns the products of eight matrices with the vectors. The matrices are given by their three rows.
    #[inline(always)]
    pub fn dot_rows(self, [first, second, third]: [Self; 3]) -> Self {
        Self { x: first.dot(self), y: second.dot(self), z: third.dot(self) }
    }

    /// Returns the cross products with other vectors.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Returns the squared lengths.
    #[inline(always)]
    pub fn norm_squared(self) -> Numbers<S> {
        self.dot(self)
    }

    /// Returns the lengths.
    #[inline(always)]
    pub fn norm(self) -> Numbers<S> {
        self.norm_squared().sqrt()
    }

    /// Returns the unit vectors; `other` where a vector is too short to have a direction.
    #[inline(always)]
    pub fn unit_or(self, other: Self) -> Self {
        let length = self.norm();
        let has_length = length.all(SHORTEST).below(length);
        Self::select(has_length, self.along(length), other)
    }

    /// Returns the unit vectors, given the lengths of the vectors. If a vector is too short to have a
    /// direction, the result is shorter than 1.
    #[inline(always)]
    pub fn along(self, length: Numbers<S>) -> Self {
        self * length.all(1.0).over(length.larger(length.all(SHORTEST)))
    }

    /// Returns `a` where the mask is set, otherwise `b`.
    #[inline(always)]
    pub fn select(mask: S::Mask, a: Self, b: Self) -> Self {
        Self {
            x: Numbers::select(mask, a.x, b.x),
            y: Numbers::select(mask, a.y, b.y),
            z: Numbers::select(mask, a.z, b.z),
        }
    }
}

impl<S: Simd> Add for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<S: Simd> Sub for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<S: Simd> Mul<Numbers<S>> for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: Numbers<S>) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

impl<S: Simd> Neg for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}
