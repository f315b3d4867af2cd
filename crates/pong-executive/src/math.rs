//! Rotations, and sums that keep their precision.

use nalgebra::Quaternion;
use pong_geometry::{Mat3, Quat, Vec3};

/// Below this angle (rad) series replace quotients that would lose digits.
const SMALL_ANGLE: f64 = 0.05;

/// A vector kept as a sum of two: the small part holds the rounding error of the large part.
///
/// A single vector loses 1e-9 m in every step at positions of 7e6 m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Compensated {
    value: Vec3,
    rest: Vec3,
}

impl Compensated {
    pub fn new(value: Vec3) -> Self {
        Self { value, rest: Vec3::zeros() }
    }

    /// Both parts, for [`of_parts`](Self::of_parts).
    pub fn parts(&self) -> [Vec3; 2] {
        [self.value, self.rest]
    }

    /// The sum of two [`parts`](Self::parts), exactly as it was.
    pub fn of_parts([value, rest]: [Vec3; 2]) -> Self {
        Self { value, rest }
    }

    /// The sum rounded to one vector.
    pub fn value(&self) -> Vec3 {
        self.value
    }

    /// The sum with an increment added (Knuth's exact sum of two numbers, per component).
    pub fn plus(&self, increment: &Vec3) -> Self {
        let addend = self.rest + increment;
        let value = self.value + addend;
        let back = value - self.value;
        let rest = (self.value - (value - back)) + (addend - back);
        Self { value, rest }
    }
}

/// The matrix of `v ×`.
pub(crate) fn cross_matrix(v: &Vec3) -> Mat3 {
    v.cross_matrix()
}

/// Rotation of a rotation vector (axis times angle).
pub(crate) fn rotation(vector: &Vec3) -> Quat {
    let half = 0.5 * vector.norm();
    let sine_ratio = if half < SMALL_ANGLE {
        let square = half * half;
        1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)))
    } else {
        libm::sin(half) / half
    };
    let imaginary = vector * (0.5 * sine_ratio);
    Quat::new_normalize(Quaternion::from_parts(libm::cos(half), imaginary))
}

/// J with ω = J·θ̇, ω the angular velocity along the axes of the rotating body, θ its rotation vector.
pub(crate) fn body_rate_of_rotation_vector(theta: &Vec3) -> Mat3 {
    let angle = theta.norm();
    let (first, second) = if angle < SMALL_ANGLE {
        let square = angle * angle;
        (
            0.5 - square / 24.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0)),
            (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0))) / 6.0,
        )
    } else {
        let half_sine = libm::sin(0.5 * angle);
        let square = angle * angle;
        (2.0 * half_sine * half_sine / square, (angle - libm::sin(angle)) / (square * angle))
    };
    let cross = cross_matrix(theta);
    Mat3::identity() - cross * first + cross * cross * second
}

/// J⁻¹ of [`body_rate_of_rotation_vector`]. It is also the transpose of the inverse along the fixed axes,
/// which turns the gradient of an energy of θ into a moment. Valid below a full turn.
pub(crate) fn inverse_body_rate(theta: &Vec3) -> Mat3 {
    let angle = theta.norm();
    let square = angle * angle;
    let second = if angle < SMALL_ANGLE {
        1.0 / 12.0 + square / 720.0 + square * square / 30240.0
    } else {
        let half = 0.5 * angle;
        (1.0 - half * libm::cos(half) / libm::sin(half)) / square
    };
    let cross = cross_matrix(theta);
    Mat3::identity() + cross * 0.5 + cross * cross * second
}

/// Index of the first time that is not finite or not later than the one before it.
pub(crate) fn first_not_rising(times: impl Iterator<Item = f64>) -> Option<usize> {
    let mut before = f64::NEG_INFINITY;
    times.into_iter().position(|time| {
        let rises = time > before && time.is_finite();
        before = time;
        !rises
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_geometry::pose::rotation_vector;

    #[test]
    fn rotation_inverts_the_logarithm_on_both_sides_of_the_series() {
        for angle in [0.0, 1e-9, 0.02, 0.0999, 0.1001, 1.0, 3.0] {
            let vector = Vec3::new(0.48, -0.6, 0.64) * angle;
            assert!((rotation_vector(&rotation(&vector)) - vector).norm() < 1e-14);
        }
    }

    #[test]
    fn rates_of_the_rotation_vector_match_differences() {
        for scale in [1e-3, 0.04999, 0.05001, 0.7, 2.5] {
            let theta = Vec3::new(0.48, -0.6, 0.64) * scale;
            let rate = Vec3::new(0.3, 0.2, -0.7);
            let h = 1e-6;
            let (before, after) = (rotation(&(theta - rate * h)), rotation(&(theta + rate * h)));
            let measured = rotation_vector(&(before.inverse() * after)) / (2.0 * h);
            let matrix = body_rate_of_rotation_vector(&theta);
            assert!((matrix * rate - measured).norm() < 1e-9, "scale {scale}");
            assert!((matrix * inverse_body_rate(&theta) - Mat3::identity()).norm() < 1e-13, "scale {scale}");
        }
    }

    #[test]
    fn a_far_sum_loses_nothing() {
        let mut sum = Compensated::new(Vec3::new(6.8e6, 0.0, 0.0));
        for _ in 0..1000 {
            sum = sum.plus(&Vec3::new(1e-10, 0.0, 0.0));
        }
        assert!((sum.value().x - (6.8e6 + 1e-7)).abs() < 1e-9);
        assert!(((sum.value.x - 6.8e6) + sum.rest.x - 1e-7).abs() < 1e-20);
    }
}
