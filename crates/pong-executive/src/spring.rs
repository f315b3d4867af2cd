//! Six-axis spring-dampers between two bodies, or a body and the ground.
//!
//! With e the attachment frame of the first end and f that of the second, both fixed to their bodies:
//!
//! ```text
//! d = place of f in e, less that at rest        θ = rotation vector of f in e, less that at rest
//! F = P − K·d − C·ḋ                             M = J⁻ᵀ·(P_r − K_r·θ) − C_r·ω
//! ```
//!
//! F (along the axes of e) acts on the second body at the origin of f, −F on the first at the same place; M and −M
//! alike. ω is the angular velocity of f seen from e and θ̇ = J⁻¹·ω, so that the undamped part is the gradient of
//! ½d·Kd + ½θ·K_rθ − P·d − P_r·θ whatever the angle, up to half a turn.

use crate::body::BodyId;
use crate::math::inverse_body_rate;
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Twist, Vec3, Wrench};

/// One end of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringEnd {
    /// The body; `None` is the ground.
    pub body: Option<BodyId>,
    /// The attachment frame in the group frame; on the ground, in the common frame.
    pub frame: Pose,
}

/// A six-axis spring-damper. All six-vectors: three translations (N/m, N·s/m, N), then three rotations (N·m/rad,
/// N·m·s/rad, N·m), along the axes of the first end's attachment frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// The end along whose axes the values are given.
    pub first: SpringEnd,
    /// The other end.
    pub second: SpringEnd,
    /// Stiffness along and about the axes.
    pub stiffness: [f64; 6],
    /// Damping along and about the axes.
    pub damping: [f64; 6],
    /// Constant force and moment on the second end.
    pub preload: [f64; 6],
    /// Pose at rest of the second attachment frame in the first one.
    pub rest: Pose,
}

/// Force, energy and heat of a spring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpringAction {
    /// Wrench on the first body, about its group's origin, along the common axes.
    pub on_first: Wrench,
    /// Wrench on the second body, likewise.
    pub on_second: Wrench,
    /// Stored energy, J.
    pub energy: f64,
    /// Heat of the damper, W.
    pub heat: f64,
}

impl SpringEnd {
    /// An end held by a frame of the ground.
    pub fn ground(frame: Pose) -> Self {
        Self { body: None, frame }
    }

    /// An end held by a frame of a body.
    pub fn on(body: BodyId, frame: Pose) -> Self {
        Self { body: Some(body), frame }
    }
}

impl Spring {
    /// A spring at rest where both frames coincide, without damping and preload.
    pub fn new(first: SpringEnd, second: SpringEnd, stiffness: [f64; 6]) -> Self {
        Self { first, second, stiffness, damping: [0.0; 6], preload: [0.0; 6], rest: Pose::identity() }
    }

    /// Returns this spring with damping.
    pub fn damped(self, damping: [f64; 6]) -> Self {
        Self { damping, ..self }
    }

    /// Cause and cure in one line, if the spring cannot be used.
    pub fn fault(&self) -> Option<String> {
        let unusable = |values: &[f64; 6]| values.iter().any(|x| !(*x >= 0.0 && x.is_finite()));
        if unusable(&self.stiffness) {
            return Some("a stiffness is below zero or not finite; give six numbers from zero up".to_owned());
        }
        if unusable(&self.damping) {
            return Some("a damping is below zero or not finite; give six numbers from zero up".to_owned());
        }
        if self.preload.iter().any(|x| !x.is_finite()) {
            return Some("a preload is not finite; give six finite numbers".to_owned());
        }
        if self.first.body == self.second.body {
            return Some(
                "both ends are on the same body; attach them to two bodies, or one to the ground".to_owned(),
            );
        }
        None
    }

    /// Action of the spring at the motions of its ends (pose and twist of the group frame; the ground's are
    /// identity and zero).
    pub(crate) fn act(&self, first: &(Pose, Twist), second: &(Pose, Twist)) -> SpringAction {
        let to_common = first.0.orientation * self.first.frame.orientation;
        let (deviation, speed) = self.travel(first, second);
        let linear = Axis3::new(self, 0, &deviation.linear, &speed.linear);
        let angular = Axis3::new(self, 3, &deviation.angular, &speed.angular);
        let force = to_common * (linear.elastic - linear.viscous);
        let moment = to_common * (inverse_body_rate(&deviation.angular) * angular.elastic - angular.viscous);
        let place = second.0.orientation * self.second.frame.position;
        let place_from_first = second.0.position - first.0.position + place;
        let about = |sign: f64, arm: &Vec3| {
            let mut wrench = Wrench::of_force_at(force * sign, arm);
            wrench.moment += moment * sign;
            wrench
        };
        SpringAction {
            on_first: about(-1.0, &place_from_first),
            on_second: about(1.0, &place),
            energy: linear.energy + angular.energy,
            heat: linear.viscous.dot(&speed.linear) + angular.viscous.dot(&speed.angular),
        }
    }

    /// Angle of the deviation from rest, rad.
    pub(crate) fn angle(&self, first: &(Pose, Twist), second: &(Pose, Twist)) -> f64 {
        self.travel(first, second).0.angular.norm()
    }

    /// Deviation from rest (d and θ) and the velocities ḋ and ω, along the axes of the first end.
    fn travel(&self, first: &(Pose, Twist), second: &(Pose, Twist)) -> (Twist, Twist) {
        let to_e = (first.0.orientation * self.first.frame.orientation).inverse();
        let arm_e = first.0.orientation * self.first.frame.position;
        let arm_f = second.0.orientation * self.second.frame.position;
        // Subtract origins first, then add the arms: this keeps digits far from the common origin.
        let between = second.0.position - first.0.position;
        let from_first = between + arm_f;
        let turned = to_e * second.0.orientation * self.second.frame.orientation;
        let deviation = Twist {
            linear: to_e * (from_first - arm_e) - self.rest.position,
            angular: rotation_vector(&(turned * self.rest.orientation.inverse())),
        };
        let velocity = second.1.linear - first.1.linear + second.1.angular.cross(&arm_f)
            - first.1.angular.cross(&from_first);
        let speed = Twist { linear: to_e * velocity, angular: to_e * (second.1.angular - first.1.angular) };
        (deviation, speed)
    }
}

/// Three of the six axes.
struct Axis3 {
    /// P − K·x.
    elastic: Vec3,
    /// C·ẋ.
    viscous: Vec3,
    energy: f64,
}

impl Axis3 {
    fn new(spring: &Spring, from: usize, deviation: &Vec3, speed: &Vec3) -> Self {
        let three = |values: &[f64; 6]| Vec3::new(values[from], values[from + 1], values[from + 2]);
        let pull = three(&spring.stiffness).component_mul(deviation);
        let preload = three(&spring.preload);
        Self {
            elastic: preload - pull,
            viscous: three(&spring.damping).component_mul(speed),
            energy: 0.5 * pull.dot(deviation) - preload.dot(deviation),
        }
    }
}
