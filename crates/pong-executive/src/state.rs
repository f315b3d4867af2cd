//! What is integrated: mass centre, its velocity, orientation, angular momentum.
//!
//! Angular momentum about the mass centre along the common axes, not angular velocity: without a moment it is
//! constant, so no integrator can lose it.
//!
//! Within a step the orientation is counted as a rotation vector θ from the start of the step, θ̇ = J⁻¹(θ)·ω
//! (H. Munthe-Kaas, "High order Runge-Kutta methods on manifolds", Appl. Numer. Math. 29 (1999)), so that every
//! stage of a body in steady rotation stands where it belongs. A quaternion integrated by component is turned by
//! 2·atan(ωh/4) instead of ωh/2 at half a step: a ball that rolls at 100 rad/s and 1 ms then seems to slip.

use crate::mass::MassProperties;
use crate::math::{Compensated, inverse_body_rate, rotation};
use pong_geometry::{Mat3, Pose, Quat, Twist, Vec3, Wrench};

/// Mass properties made ready for use in every stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia {
    /// kg.
    pub mass: f64,
    /// About the mass centre, along the group's axes, kg·m².
    pub tensor: Mat3,
    /// Inverse of `tensor`, 1/(kg·m²).
    pub inverse: Mat3,
    /// Mass centre in the group frame, m.
    pub mass_center: Vec3,
}

impl Inertia {
    /// `None` if the tensor cannot be inverted.
    pub fn new(mass: &MassProperties) -> Option<Self> {
        let inverse = mass.inertia.try_inverse()?;
        Some(Self { mass: mass.mass, tensor: mass.inertia, inverse, mass_center: mass.mass_center })
    }
}

/// State of a free body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FreeState {
    /// Of the mass centre in the common frame, m.
    pub position: Compensated,
    /// Of the mass centre along the common axes, m/s.
    pub velocity: Compensated,
    /// From the group's axes to the common axes, at the start of the step.
    pub orientation: Quat,
    /// θ: rotation vector since the start of the step, along the common axes, rad. Zero between steps.
    pub turn: Vec3,
    /// Angular momentum about the mass centre, along the common axes, N·m·s.
    pub momentum: Vec3,
}

/// Time derivatives of a [`FreeState`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates {
    /// Of the mass centre, m/s.
    pub velocity: Vec3,
    /// Of the mass centre, m/s².
    pub acceleration: Vec3,
    /// θ̇, rad/s.
    pub turn: Vec3,
    /// Rate of the angular momentum, N·m.
    pub moment: Vec3,
}

impl FreeState {
    /// From the motion of the group frame.
    pub fn of_motion(inertia: &Inertia, pose: &Pose, twist: &Twist) -> Self {
        let arm = pose.orientation * inertia.mass_center;
        let spin_b = pose.orientation.inverse() * twist.angular;
        Self {
            position: Compensated::new(pose.position).plus(&arm),
            velocity: Compensated::new(twist.linear).plus(&twist.angular.cross(&arm)),
            orientation: pose.orientation,
            turn: Vec3::zeros(),
            momentum: pose.orientation * (inertia.tensor * spin_b),
        }
    }

    /// Angular velocity along the common axes.
    pub fn spin(&self, inertia: &Inertia) -> Vec3 {
        self.orientation * (inertia.inverse * (self.orientation.inverse() * self.momentum))
    }

    /// Motion of the group frame.
    pub fn motion(&self, inertia: &Inertia) -> (Pose, Twist) {
        let orientation = self.orientation;
        let arm = orientation * inertia.mass_center;
        let angular = self.spin(inertia);
        let position = self.position.plus(&-arm).value();
        let linear = self.velocity.plus(&-angular.cross(&arm)).value();
        (Pose { position, orientation }, Twist { linear, angular })
    }

    /// Derivatives under a wrench about the group's origin along the common axes.
    pub fn rates(&self, inertia: &Inertia, wrench: &Wrench, gravity: &Vec3) -> Rates {
        let arm = self.orientation * inertia.mass_center;
        Rates {
            velocity: self.velocity.value(),
            acceleration: wrench.force / inertia.mass + gravity,
            // Along fixed axes J is the transpose of that along the body's.
            turn: inverse_body_rate(&self.turn).transpose() * self.spin(inertia),
            moment: wrench.moment - arm.cross(&wrench.force),
        }
    }

    /// From the start of a step, the state a time `h` along the rates.
    pub fn along(&self, rates: &Rates, h: f64) -> Self {
        let turn = rates.turn * h;
        Self {
            position: self.position.plus(&(rates.velocity * h)),
            velocity: self.velocity.plus(&(rates.acceleration * h)),
            orientation: rotation(&turn) * self.orientation,
            turn,
            momentum: self.momentum + rates.moment * h,
        }
    }

    /// The same state as the start of the next step.
    pub fn normalized(&self) -> Self {
        Self { orientation: unit(&self.orientation), turn: Vec3::zeros(), ..*self }
    }

    /// One step of semi-implicit Euler: momenta first, then the place with the new momenta.
    pub fn semi_implicit(&self, inertia: &Inertia, rates: &Rates, h: f64) -> Self {
        let velocity = self.velocity.plus(&(rates.acceleration * h));
        let momentum = self.momentum + rates.moment * h;
        let spin = Self { momentum, ..*self }.spin(inertia);
        Self {
            position: self.position.plus(&(velocity.value() * h)),
            velocity,
            orientation: unit(&(rotation(&(spin * h)) * self.orientation)),
            turn: Vec3::zeros(),
            momentum,
        }
    }
}

/// Rounding lets the length of a product of unit quaternions drift.
fn unit(orientation: &Quat) -> Quat {
    Quat::new_normalize(orientation.into_inner())
}

impl Rates {
    /// `a·1 + b·2 + c·2 + d·1` over 6: the mean of Runge and Kutta.
    pub fn runge_kutta_mean(stages: [&Self; 4]) -> Self {
        let [a, b, c, d] = stages;
        let mean = |f: fn(&Self) -> Vec3| (f(a) + (f(b) + f(c)) * 2.0 + f(d)) / 6.0;
        Self {
            velocity: mean(|r| r.velocity),
            acceleration: mean(|r| r.acceleration),
            turn: mean(|r| r.turn),
            moment: mean(|r| r.moment),
        }
    }
}
