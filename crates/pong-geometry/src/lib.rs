//! Geometry of the contact engine: poses, twists and wrenches, primitives, bounding volumes and the
//! interference test of every pair of primitives.
//!
//! Everything here is a pure function on values or borrowed slices, except [`simd::set_level`]. Interference
//! and overlap tests never allocate. This crate starts no threads and does no I/O.
//!
//! # Conventions
//!
//! * SI units, `f64`. Frames are right-handed.
//! * `x_wg` is the pose of frame *g* seen from frame *w*: it takes components in *g* to components in *w*.
//!   `v_ab_w` is the velocity of *b* seen from *a*, expressed in *w*.
//! * In an interference of A and B the normal is a unit vector from B to A, the direction in which A is
//!   pushed. The depth is the least translation of A along the normal that separates A from B; it is positive
//!   in overlap.
//! * All tests work in the frame of B's movable group; A is transformed to it first.

#![forbid(unsafe_code)]

/// Text of the README, whose example runs with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

pub mod bounding;
pub mod distance;
pub mod extension;
pub mod interference;
pub mod lanes;
pub mod overlap;
pub mod pose;
pub mod primitive;
pub mod simd;

pub use lanes::Lanes;
pub use pose::{Pose, Transform, Twist, Wrench};

/// Vector of three components. The name of a variable says in which frame it is expressed.
pub type Vec3 = nalgebra::Vector3<f64>;
/// 3 × 3 matrix.
pub type Mat3 = nalgebra::Matrix3<f64>;
/// Unit quaternion (w, x, y, z), Hamilton product.
pub type Quat = nalgebra::UnitQuaternion<f64>;

/// Returns the difference, or 2 if it is zero, for use as a divisor in a branch that excludes zero. A
/// compiler may divide before the branch, and 0/0 or x/0 raises a floating-point exception even if the
/// quotient is not used.
///
/// For a difference that is known not to be negative, `x.max(f64::MIN_POSITIVE)` is shorter.
#[inline(always)]
pub fn divisor(difference: f64) -> f64 {
    if difference == 0.0 { 2.0 } else { difference }
}

/// Returns a unit vector perpendicular to a unit vector; the same input gives the same result.
pub fn any_perpendicular(axis: &Vec3) -> Vec3 {
    let least = axis.iamin();
    axis.cross(&Vec3::ith(least, 1.0)).normalize()
}
