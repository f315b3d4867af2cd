//! Poses, twists and wrenches, and the motion between two poses.

use crate::{Mat3, Quat, Vec3};
use nalgebra::{Matrix3x6, Quaternion};

/// Position and orientation of a frame *g* seen from a frame *w*: half of the state that a host sets for a
/// movable group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Origin of *g* in *w*, metres.
    pub position: Vec3,
    /// Rotation that takes components in *g* to components in *w*.
    pub orientation: Quat,
}

impl Pose {
    /// Returns the pose of a frame that coincides with its reference frame.
    #[inline]
    pub fn identity() -> Self {
        Self { position: Vec3::zeros(), orientation: Quat::identity() }
    }

    /// Creates a pose from a position (m) and a quaternion (w, x, y, z), which is normalised here.
    ///
    /// The quaternion must not be zero. A quaternion and its negative are the same orientation and give the
    /// same bits: the first non-zero component is made positive, and −0 becomes +0, because the sign of a
    /// zero could otherwise appear in results.
    #[inline]
    pub fn new(position: Vec3, wxyz: [f64; 4]) -> Self {
        let first = wxyz.into_iter().find(|part| *part != 0.0).unwrap_or(1.0);
        let sign = 1.0_f64.copysign(first);
        let part = |index: usize| sign * wxyz[index] + 0.0;
        let quaternion = Quaternion::new(part(0), part(1), part(2), part(3));
        Self { position, orientation: Quat::new_normalize(quaternion) }
    }

    /// Returns `x_wg · x_gh = x_wh`, the pose of a frame *h* seen from *w*.
    #[inline]
    pub fn compose(&self, x_gh: &Pose) -> Pose {
        Pose {
            position: self.position + self.orientation * x_gh.position,
            orientation: self.orientation * x_gh.orientation,
        }
    }

    /// Returns `x_gw`, the pose of *w* seen from *g*.
    #[inline]
    pub fn inverse(&self) -> Pose {
        let inverse = self.orientation.inverse();
        Pose { position: inverse * (-self.position), orientation: inverse }
    }

    /// Returns `x_ba`, the pose of A seen from B, from the poses of both in one common frame.
    ///
    /// The positions are subtracted before anything is rotated (docs/theory.md, 1). So moving the common
    /// origin changes the result only by the rounding of the positions.
    #[inline]
    pub fn relative(x_wa: &Pose, x_wb: &Pose) -> Pose {
        let r_ba_w = x_wa.position - x_wb.position;
        let b_from_w = x_wb.orientation.inverse();
        Pose { position: b_from_w * r_ba_w, orientation: b_from_w * x_wa.orientation }
    }

    /// Returns the same transform with its rotation as a matrix, which is faster for many points.
    #[inline]
    pub fn transform(&self) -> Transform {
        Transform { translation: self.position, rotation: self.orientation.to_rotation_matrix().into_inner() }
    }
}

/// Rigid transform with the rotation as a matrix: a [`Pose`] in the form for transforming many points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Origin of the source frame in the target frame, metres.
    pub translation: Vec3,
    /// Columns are the source axes in the target frame.
    pub rotation: Mat3,
}

impl Transform {
    /// Returns the identity transform.
    #[inline]
    pub fn identity() -> Self {
        Self { translation: Vec3::zeros(), rotation: Mat3::identity() }
    }

    /// Transforms a point.
    #[inline]
    pub fn point(&self, p: &Vec3) -> Vec3 {
        self.rotation * p + self.translation
    }

    /// Rotates a free vector or direction.
    #[inline]
    pub fn vector(&self, v: &Vec3) -> Vec3 {
        self.rotation * v
    }

    /// Returns `x_ab · x_bc = x_ac`.
    #[inline]
    pub fn compose(&self, other: &Transform) -> Transform {
        Transform { translation: self.point(&other.translation), rotation: self.rotation * other.rotation }
    }

    /// Returns the inverse transform.
    #[inline]
    pub fn inverse(&self) -> Transform {
        let rotation = self.rotation.transpose();
        Transform { translation: -(rotation * self.translation), rotation }
    }
}

/// Motion of a frame: linear velocity of its origin (m/s) and angular velocity (rad/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Velocity of the frame's origin, m/s.
    pub linear: Vec3,
    /// Angular velocity, rad/s.
    pub angular: Vec3,
}

impl Twist {
    /// Returns the twist of a frame at rest.
    #[inline]
    pub fn zero() -> Self {
        Self { linear: Vec3::zeros(), angular: Vec3::zeros() }
    }

    /// Returns the velocity of the material point at `arm` from the frame's origin, m/s.
    #[inline]
    pub fn at(&self, arm: &Vec3) -> Vec3 {
        self.linear + self.angular.cross(arm)
    }
}

/// Force (N) and moment (N·m). The owner of the wrench documents the point about which the moment is given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force, N.
    pub force: Vec3,
    /// Moment, N·m, about the point that the owner of the wrench documents.
    pub moment: Vec3,
}

impl Wrench {
    /// Returns the zero wrench.
    #[inline]
    pub fn zero() -> Self {
        Self { force: Vec3::zeros(), moment: Vec3::zeros() }
    }

    /// Returns the wrench about the origin of a force that acts at `arm`.
    #[inline]
    pub fn of_force_at(force: Vec3, arm: &Vec3) -> Self {
        Self { force, moment: arm.cross(&force) }
    }
}

impl std::ops::AddAssign for Wrench {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.moment += other.moment;
    }
}

/// Returns the rotation vector (axis times angle in rad, angle in 0…π) of a rotation.
///
/// Only +, −, ×, ÷ and √ are used, so every machine gives the same bits. The half angle is halved by the
/// half-angle identity, at most three times, until its tangent is small enough for the series of the
/// arctangent. That series converges to rounding in thirteen terms, or in eight for small rotations. The
/// rotation within one frame usually needs no halving.
#[inline]
pub fn rotation_vector(q: &Quat) -> Vec3 {
    /// Square of tan(π/16).
    const SQUARE_MAX: f64 = 0.039_566_129_896_580_15;
    const TERMS: usize = 13;
    /// Limit for eight terms: rotations up to 0.14 rad, as is usual within one frame. The truncation error is
    /// below 5e-3⁸/17 = 3e-20 of the result, far below rounding.
    const SMALL_SQUARE: f64 = 5e-3;
    const SMALL_TERMS: usize = 8;
    let mut factor = 2.0;
    let mut w = q.w;
    let mut v = q.imag();
    if w < 0.0 {
        w = -w;
        v = -v;
    }
    // (1 + w, v) is a multiple of the quaternion of half the rotation.
    while v.norm_squared() > SQUARE_MAX * (w * w) {
        let half = 1.0 + w;
        let norm = (half * half + v.norm_squared()).sqrt();
        w = half / norm;
        v /= norm;
        factor *= 2.0;
    }
    let tangent = v / w;
    let square = tangent.norm_squared();
    let ratio = if square <= SMALL_SQUARE {
        arctangent_ratio::<SMALL_TERMS>(square)
    } else {
        arctangent_ratio::<TERMS>(square)
    };
    // The angle of the quaternion is half that of the rotation.
    tangent * (ratio * factor)
}

/// Returns the series of arctan(t)/t for small t, as a function of t².
#[inline(always)]
fn arctangent_ratio<const TERMS: usize>(square: f64) -> f64 {
    let mut ratio = 0.0;
    for k in (0..TERMS).rev() {
        ratio = 1.0 / (2 * k + 1) as f64 - square * ratio;
    }
    ratio
}

/// Derivatives of a vector that is fixed to a body by a small motion of the body: columns of a translation (zero) and of a
/// rotation φ, φ × v.
pub fn turn_slopes(vector: &Vec3) -> Matrix3x6<f64> {
    let mut slopes = Matrix3x6::zeros();
    slopes.fixed_view_mut::<3, 3>(0, 3).copy_from(&-vector.cross_matrix());
    slopes
}

/// Derivatives of a material point at `place`, m, by a small motion of its body: a translation of the material point at the
/// origin, and a rotation φ about the origin, u + φ × place.
pub fn displacement_slopes(place: &Vec3) -> Matrix3x6<f64> {
    let mut slopes = turn_slopes(place);
    slopes.fixed_view_mut::<3, 3>(0, 0).copy_from(&Mat3::identity());
    slopes
}

/// Rotates `p`, a vector perpendicular to the unit normal `from`, by the smallest rotation that takes `from`
/// to `to`.
///
/// For opposite normals the smallest rotation is not unique, and the result is zero.
#[inline]
pub fn carry_by_smallest_rotation(p: &Vec3, from: &Vec3, to: &Vec3) -> Vec3 {
    let cosine = from.dot(to);
    let axis = from.cross(to);
    let denominator = 1.0 + cosine;
    if denominator <= 0.0 {
        return Vec3::zeros();
    }
    p * cosine + axis.cross(p) + axis * (axis.dot(p) / denominator.max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_vector_inverts_the_exponential() {
        let axis = nalgebra::Unit::new_normalize(Vec3::new(0.3, -0.8, 0.5));
        // The series changes from eight to thirteen terms at 0.1412.
        for angle in [0.0, 1e-9, 1e-3, 0.141, 0.1414, 0.4, 1.5, 2.9, std::f64::consts::PI - 1e-9] {
            let turn = Quat::from_axis_angle(&axis, angle);
            let vector = rotation_vector(&turn);
            assert!((vector - axis.into_inner() * angle).norm() <= 4e-15 * (1.0 + angle), "angle {angle}");
            // The negative quaternion is the same rotation.
            assert_eq!(rotation_vector(&Quat::new_unchecked(-turn.into_inner())), vector, "angle {angle}");
        }
    }

    #[test]
    fn a_quaternion_and_its_negative_are_one_pose_to_the_bit() {
        let half_turn = 6.123233995736766e-17;
        for wxyz in [
            [1.0, 0.0, 0.0, 0.0],
            [half_turn, 0.0, -1.0, 0.0],
            [0.0, 0.0, -1.0, 0.0],
            [-0.0, 0.6, -0.0, -0.8],
            [-0.5, 0.5, -0.5, 0.5],
        ] {
            let [one, other] = [wxyz, wxyz.map(|part: f64| -part)].map(|wxyz| {
                let pose = Pose::new(Vec3::zeros(), wxyz);
                let turned = pose.orientation * Vec3::new(0.0, 0.0, -1.0);
                let matrix = pose.transform().rotation;
                let numbers = pose.orientation.coords.iter().chain(&turned).chain(&matrix);
                numbers.map(|number| number.to_bits()).collect::<Vec<_>>()
            });
            assert_eq!(one, other, "{wxyz:?}");
        }
    }

    #[test]
    fn smallest_rotation_takes_one_normal_into_the_other() {
        let from = Vec3::new(0.0, 0.6, 0.8);
        let to = Vec3::new(0.48, -0.6, 0.64);
        let carried = carry_by_smallest_rotation(&from, &from, &to);
        assert!((carried - to).norm() < 1e-15);
        assert_eq!(carry_by_smallest_rotation(&Vec3::x(), &Vec3::z(), &-Vec3::z()), Vec3::zeros());
    }

    #[test]
    fn relative_pose_ignores_the_common_origin() {
        let a = Pose::new(Vec3::new(1.0, 2.0, 3.0), [0.9, 0.1, -0.2, 0.3]);
        let b = Pose::new(Vec3::new(-4.0, 0.5, 1.0), [0.2, 0.7, 0.1, -0.5]);
        let direct = b.inverse().compose(&a);
        let relative = Pose::relative(&a, &b);
        assert!((direct.position - relative.position).norm() < 1e-14);
        assert!(direct.orientation.angle_to(&relative.orientation) < 1e-7);
    }
}
