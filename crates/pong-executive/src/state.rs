//! What is integrated: mass centre, its velocity, orientation, angular momentum.
//!
//! Angular momentum about the mass centre along the common axes, not angular velocity: without a moment it is
//! constant, so no integrator can lose it.

use crate::mass::MassProperties;
use crate::math::{Compensated, rotation};
use nalgebra::Quaternion;
use pong_geometry::{Mat3, Pose, Quat, Twist, Vec3, Wrench};

/// Mass properties made ready for use in every stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia {
    pub mass: f64,
    pub tensor: Mat3,
    pub inverse: Mat3,
    /// Mass centre in the group frame.
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
    pub position: Compensated,
    pub velocity: Compensated,
    /// Need not have unit length within a step: its length is taken out where it is used.
    pub orientation: Quaternion<f64>,
    pub momentum: Vec3,
}

/// Time derivatives of a [`FreeState`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates {
    pub velocity: Vec3,
    pub acceleration: Vec3,
    pub orientation: Quaternion<f64>,
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
            orientation: pose.orientation.into_inner(),
            momentum: pose.orientation * (inertia.tensor * spin_b),
        }
    }

    pub fn rotation(&self) -> Quat {
        Quat::new_normalize(self.orientation)
    }

    /// Angular velocity along the common axes.
    pub fn spin(&self, inertia: &Inertia) -> Vec3 {
        let rotation = self.rotation();
        rotation * (inertia.inverse * (rotation.inverse() * self.momentum))
    }

    /// Motion of the group frame.
    pub fn motion(&self, inertia: &Inertia) -> (Pose, Twist) {
        let orientation = self.rotation();
        let arm = orientation * inertia.mass_center;
        let angular = self.spin(inertia);
        let position = self.position.plus(&-arm).value();
        let linear = self.velocity.plus(&-angular.cross(&arm)).value();
        (Pose { position, orientation }, Twist { linear, angular })
    }

    /// Derivatives under a wrench about the group's origin along the common axes.
    pub fn rates(&self, inertia: &Inertia, wrench: &Wrench, gravity: &Vec3) -> Rates {
        let arm = self.rotation() * inertia.mass_center;
        let spin = Quaternion::from_imag(self.spin(inertia));
        Rates {
            velocity: self.velocity.value(),
            acceleration: wrench.force / inertia.mass + gravity,
            orientation: spin * self.orientation * 0.5,
            moment: wrench.moment - arm.cross(&wrench.force),
        }
    }

    /// The state a time `h` along the rates; the quaternion keeps whatever length it gets.
    pub fn along(&self, rates: &Rates, h: f64) -> Self {
        Self {
            position: self.position.plus(&(rates.velocity * h)),
            velocity: self.velocity.plus(&(rates.acceleration * h)),
            orientation: self.orientation + rates.orientation * h,
            momentum: self.momentum + rates.moment * h,
        }
    }

    /// The same state with a unit quaternion.
    pub fn normalized(&self) -> Self {
        Self { orientation: self.orientation.normalize(), ..*self }
    }

    /// One step of semi-implicit Euler: momenta first, then the place with the new momenta.
    pub fn semi_implicit(&self, inertia: &Inertia, rates: &Rates, h: f64) -> Self {
        let velocity = self.velocity.plus(&(rates.acceleration * h));
        let momentum = self.momentum + rates.moment * h;
        let spin = Self { momentum, ..*self }.spin(inertia);
        let turn = rotation(&(spin * h)).into_inner();
        Self {
            position: self.position.plus(&(velocity.value() * h)),
            velocity,
            orientation: (turn * self.orientation).normalize(),
            momentum,
        }
    }

    pub fn is_finite(&self) -> bool {
        let vectors = [self.position.value(), self.velocity.value(), self.momentum];
        vectors.iter().flat_map(|v| v.iter()).chain(self.orientation.coords.iter()).all(|x| x.is_finite())
    }
}

impl Rates {
    /// `a·1 + b·2 + c·2 + d·1` over 6: the mean of Runge and Kutta.
    pub fn runge_kutta_mean(stages: [&Self; 4]) -> Self {
        let [a, b, c, d] = stages;
        let mean = |f: fn(&Self) -> Vec3| (f(a) + (f(b) + f(c)) * 2.0 + f(d)) / 6.0;
        Self {
            velocity: mean(|r| r.velocity),
            acceleration: mean(|r| r.acceleration),
            orientation: (a.orientation + (b.orientation + c.orientation) * 2.0 + d.orientation) / 6.0,
            moment: mean(|r| r.moment),
        }
    }
}
