//! Poses and velocities in six coordinates.
//!
//! A *chart* states displacement, velocity and impulse of a body in six numbers, linear ones first:
//!
//! | body | frame that moves | axes |
//! |---|---|---|
//! | free, prescribed | mass centre, turned with the group | common |
//! | jointed | group's origin, turned with the group | of the group |
//!
//! A constant velocity in the chart of a jointed body is a constant screw in the body, which is the motion about a
//! hinge.

use nalgebra::{Quaternion, UnitQuaternion, Vector6};
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Quat, Vec3};

/// Axes of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axes {
    /// Axes of the common frame.
    Common,
    /// Axes of the group.
    Group,
}

/// First three numbers of six.
pub(crate) fn linear(v: &Vector6<f64>) -> Vec3 {
    v.fixed_rows::<3>(0).into_owned()
}

/// Last three numbers of six.
pub(crate) fn angular(v: &Vector6<f64>) -> Vec3 {
    v.fixed_rows::<3>(3).into_owned()
}

/// Six numbers from two vectors.
pub(crate) fn six(linear: Vec3, angular: Vec3) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

/// Rotation by a rotation vector, rad.
pub(crate) fn turn(vector: &Vec3) -> Quat {
    let angle = vector.norm();
    let half = 0.5 * angle;
    // sin(angle/2)/angle; below 1e-4 rad its series is exact to rounding.
    let ratio = if angle < 1e-4 { 0.5 - angle * angle / 48.0 } else { libm::sin(half) / angle };
    let imaginary = vector * ratio;
    UnitQuaternion::new_normalize(Quaternion::new(libm::cos(half), imaginary.x, imaginary.y, imaginary.z))
}

/// Pose after a displacement in a chart.
pub(crate) fn moved(axes: Axes, pose: &Pose, by: &Vector6<f64>) -> Pose {
    match axes {
        Axes::Common => {
            Pose { position: pose.position + linear(by), orientation: turn(&angular(by)) * pose.orientation }
        }
        Axes::Group => pose.compose(&screw_motion(by)),
    }
}

/// Pose of a frame that has moved along a screw, seen from where it was.
fn screw_motion(screw: &Vector6<f64>) -> Pose {
    let (rho, phi) = (linear(screw), angular(screw));
    let square = phi.norm_squared();
    let angle = square.sqrt();
    // (1 − cos φ)/φ² and (φ − sin φ)/φ³; below 1e-3 rad their series are exact to rounding.
    let (b, c) = if angle < 1e-3 {
        (0.5 - square / 24.0, 1.0 / 6.0 - square / 120.0)
    } else {
        let s = libm::sin(0.5 * angle);
        (2.0 * s * s / square, (angle - libm::sin(angle)) / (square * angle))
    };
    let across = phi.cross(&rho);
    Pose { position: rho + across * b + phi.cross(&across) * c, orientation: turn(&phi) }
}

/// Displacement from one pose to another, exact where rotations are about one axis, and to fourth order of the angle
/// otherwise.
pub(crate) fn displacement(axes: Axes, from: &Pose, to: &Pose) -> Vector6<f64> {
    match axes {
        Axes::Common => {
            let phi = rotation_vector(&(to.orientation * from.orientation.inverse()));
            six(to.position - from.position, phi)
        }
        Axes::Group => {
            let seen = Pose::relative(to, from);
            let phi = rotation_vector(&seen.orientation);
            let across = phi.cross(&seen.position);
            let square = phi.norm_squared();
            // 1/φ² − cot(φ/2)/(2φ)
            let ratio = 1.0 / 12.0 + square / 720.0 + square * square / 30_240.0;
            six(seen.position - across * 0.5 + phi.cross(&across) * ratio, phi)
        }
    }
}

/// Offset of a pose from another one, without loss of digits: position and orientation of the difference.
pub(crate) fn offset(axes: Axes, from: &Pose, to: &Pose) -> Pose {
    match axes {
        Axes::Common => Pose {
            position: to.position - from.position,
            orientation: to.orientation * from.orientation.inverse(),
        },
        Axes::Group => Pose::relative(to, from),
    }
}

/// Pose at an offset from another one.
pub(crate) fn at_offset(axes: Axes, from: &Pose, offset: &Pose) -> Pose {
    match axes {
        Axes::Common => Pose {
            position: from.position + offset.position,
            orientation: offset.orientation * from.orientation,
        },
        Axes::Group => from.compose(offset),
    }
}

/// Impulse or wrench in a chart of a force (N or N·s, common axes) at a point (common frame).
pub(crate) fn of_force_at(axes: Axes, pose: &Pose, point: &Vec3, force: &Vec3) -> Vector6<f64> {
    let moment = (point - pose.position).cross(force);
    match axes {
        Axes::Common => six(*force, moment),
        Axes::Group => {
            let back = pose.orientation.inverse();
            six(back * force, back * moment)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_displacement_leads_to_its_pose() {
        let pose = Pose::new(Vec3::new(1.0, -2.0, 0.5), [0.8, 0.1, 0.5, -0.3]);
        for axes in [Axes::Common, Axes::Group] {
            for size in [0.0, 1e-6, 1e-2, 0.3] {
                let by = Vector6::new(0.2, -0.4, 0.1, size, -0.5 * size, 0.7 * size);
                let to = moved(axes, &pose, &by);
                let seen = displacement(axes, &pose, &to);
                assert!((seen - by).amax() < 1e-8, "{axes:?} {size}: {seen}");
                let again = at_offset(axes, &pose, &offset(axes, &pose, &to));
                assert!((again.position - to.position).norm() < 1e-15);
            }
        }
    }

    /// A constant screw turns a body about its hinge: after a quarter turn the origin is a quarter circle further.
    #[test]
    fn a_screw_is_a_motion_about_a_hinge() {
        let start = Pose::new(Vec3::new(0.4, 0.0, 0.0), [1.0, 0.0, 0.0, 0.0]);
        let quarter = std::f64::consts::FRAC_PI_2;
        let end = moved(Axes::Group, &start, &(Vector6::new(0.0, 0.4, 0.0, 0.0, 0.0, 1.0) * quarter));
        assert!((end.position - Vec3::new(0.0, 0.4, 0.0)).norm() < 1e-15);
    }
}
