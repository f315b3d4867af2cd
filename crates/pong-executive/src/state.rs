//! Integrated state: mass centre, its velocity, orientation, angular momentum.
//!
//! Angular momentum about the mass centre along the common axes, not angular velocity: without a moment it is
//! constant, so no integrator can lose it.
//!
//! Within a step the orientation is given by a rotation vector θ from the start of the step, θ̇ = J⁻¹(θ)·ω
//! (H. Munthe-Kaas, "High order Runge-Kutta methods on manifolds", Appl. Numer. Math. 29 (1999)), so that
//! every stage of a body in steady rotation has its exact orientation. A quaternion integrated by component
//! is turned by 2·atan(ωh/4) instead of ωh/2 at half a step: a ball that rolls at 100 rad/s and 1 ms then
//! seems to slip.

use crate::mass::MassProperties;
use crate::math::{Compensated, inverse_body_rate, rotation};
use nalgebra::Quaternion;
use pong_geometry::{Mat3, Pose, Quat, Twist, Vec3, Wrench};

/// Number of values of a state for external integrators: mass centre, its velocity, orientation, angular
/// momentum.
pub(crate) const STATE_NUMBERS: usize = 13;

/// Mass properties, with the inverse inertia that every stage needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia {
    /// Mass, kg.
    pub mass: f64,
    /// Inertia about the mass centre, along the group's axes, kg·m².
    pub tensor: Mat3,
    /// Inverse of `tensor`, 1/(kg·m²).
    pub inverse: Mat3,
    /// Mass centre in the group frame, m.
    pub mass_center: Vec3,
}

impl Inertia {
    /// Prepares mass properties; `None` if the tensor cannot be inverted.
    pub fn new(mass: &MassProperties) -> Option<Self> {
        let inverse = mass.inertia.try_inverse()?;
        Some(Self { mass: mass.mass, tensor: mass.inertia, inverse, mass_center: mass.mass_center })
    }
}

/// State of a free body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FreeState {
    /// Position of the mass centre in the common frame, m.
    pub position: Compensated,
    /// Velocity of the mass centre along the common axes, m/s.
    pub velocity: Compensated,
    /// Rotation from the group's axes to the common axes, at the start of the step.
    pub orientation: Quat,
    /// θ: rotation vector since the start of the step, along the common axes, rad. Zero between steps.
    pub turn: Vec3,
    /// Angular momentum about the mass centre, along the common axes, N·m·s.
    pub momentum: Vec3,
}

/// Time derivatives of a [`FreeState`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates {
    /// Velocity of the mass centre, m/s.
    pub velocity: Vec3,
    /// Acceleration of the mass centre, m/s².
    pub acceleration: Vec3,
    /// θ̇, rad/s.
    pub turn: Vec3,
    /// Rate of the angular momentum, N·m.
    pub moment: Vec3,
}

impl FreeState {
    /// State with a given motion of the group frame.
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
            // Along fixed axes J is the transpose of J along the body's.
            turn: inverse_body_rate(&self.turn).transpose() * self.spin(inertia),
            moment: wrench.moment - arm.cross(&wrench.force),
        }
    }

    /// The state a time `h` along the rates, from the start of a step.
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

    /// Values of the state for external integrators.
    pub fn numbers(&self) -> [f64; STATE_NUMBERS] {
        let (p, v, q, l) = (self.position.value(), self.velocity.value(), &self.orientation, &self.momentum);
        [p.x, p.y, p.z, v.x, v.y, v.z, q.w, q.i, q.j, q.k, l.x, l.y, l.z]
    }

    /// State of [`numbers`](Self::numbers) that an integrator has changed: the quaternion is normalised.
    /// `None` if it is zero or not finite.
    pub fn of_numbers(numbers: &[f64; STATE_NUMBERS]) -> Option<Self> {
        let [px, py, pz, vx, vy, vz, qw, qx, qy, qz, lx, ly, lz] = *numbers;
        let quaternion = Quaternion::new(qw, qx, qy, qz);
        let length = quaternion.norm();
        (length > 0.0 && length.is_finite()).then(|| Self {
            position: Compensated::new(Vec3::new(px, py, pz)),
            velocity: Compensated::new(Vec3::new(vx, vy, vz)),
            orientation: Quat::new_normalize(quaternion),
            turn: Vec3::zeros(),
            momentum: Vec3::new(lx, ly, lz),
        })
    }

    /// Rates of the [`numbers`](Self::numbers) from which this state was made: q' = ½·(0, ω)·q with the
    /// quaternion as given, whose length this keeps.
    pub fn rate_numbers(&self, numbers: &[f64; STATE_NUMBERS], rates: &Rates) -> [f64; STATE_NUMBERS] {
        let (v, a, l) = (&rates.velocity, &rates.acceleration, &rates.moment);
        // The rotation vector is zero here, so its rate is the angular velocity.
        let spin = Quaternion::from_parts(0.0, rates.turn);
        let q = (spin * Quaternion::new(numbers[6], numbers[7], numbers[8], numbers[9])) * 0.5;
        [v.x, v.y, v.z, a.x, a.y, a.z, q.w, q.i, q.j, q.k, l.x, l.y, l.z]
    }

    /// Length of [`exact_numbers`](Self::exact_numbers).
    pub const EXACT_NUMBERS: usize = 22;

    /// All numbers of the state.
    pub fn exact_numbers(&self) -> [f64; Self::EXACT_NUMBERS] {
        let mut numbers = [0.0; Self::EXACT_NUMBERS];
        let [p, p_rest] = self.position.parts();
        let [v, v_rest] = self.velocity.parts();
        for (place, vector) in [p, p_rest, v, v_rest, self.turn, self.momentum].iter().enumerate() {
            numbers[3 * place..3 * place + 3].copy_from_slice(vector.as_slice());
        }
        let q = &self.orientation;
        numbers[18..].copy_from_slice(&[q.w, q.i, q.j, q.k]);
        numbers
    }

    /// The state of [`exact_numbers`](Self::exact_numbers); its quaternion is not normalised.
    pub fn of_exact_numbers(numbers: &[f64; Self::EXACT_NUMBERS]) -> Self {
        let vector = |place: usize| Vec3::from_column_slice(&numbers[3 * place..3 * place + 3]);
        let quaternion = Quaternion::new(numbers[18], numbers[19], numbers[20], numbers[21]);
        Self {
            position: Compensated::of_parts([vector(0), vector(1)]),
            velocity: Compensated::of_parts([vector(2), vector(3)]),
            orientation: Quat::new_unchecked(quaternion),
            turn: vector(4),
            momentum: vector(5),
        }
    }

    /// This state as the start of the next step.
    pub fn normalized(&self) -> Self {
        Self { orientation: unit(&self.orientation), turn: Vec3::zeros(), ..*self }
    }

    /// One step of semi-implicit Euler: momenta first, then the pose with the new momenta.
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

/// Normalises an orientation, because rounding lets the length of a product of unit quaternions drift.
fn unit(orientation: &Quat) -> Quat {
    Quat::new_normalize(orientation.into_inner())
}

impl Rates {
    /// `(a + 2b + 2c + d)/6`: the mean of Runge and Kutta.
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
