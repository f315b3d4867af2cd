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
use nalgebra::Quaternion;
use pong_geometry::{Mat3, Pose, Quat, Twist, Vec3, Wrench};

/// Numbers of a state for integrators outside: mass centre, its velocity, orientation, angular momentum.
pub(crate) const STATE_NUMBERS: usize = 13;

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

    /// For integrators outside.
    pub fn numbers(&self) -> [f64; STATE_NUMBERS] {
        let (p, v, q, l) = (self.position.value(), self.velocity.value(), &self.orientation, &self.momentum);
        [p.x, p.y, p.z, v.x, v.y, v.z, q.w, q.i, q.j, q.k, l.x, l.y, l.z]
    }

    /// From [`numbers`](Self::numbers) that an integrator has changed: the quaternion is normalised. `None` if it has no
    /// direction.
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

    /// The rates of [`numbers`](Self::numbers), which this state was made of: q' = ½·(0, ω)·q of the quaternion as it was
    /// given, whose length this keeps.
    pub fn rate_numbers(&self, numbers: &[f64; STATE_NUMBERS], rates: &Rates) -> [f64; STATE_NUMBERS] {
        let (v, a, l) = (&rates.velocity, &rates.acceleration, &rates.moment);
        // Without a turn since the start of the step, its rate is the angular velocity.
        let spin = Quaternion::from_parts(0.0, rates.turn);
        let q = (spin * Quaternion::new(numbers[6], numbers[7], numbers[8], numbers[9])) * 0.5;
        [v.x, v.y, v.z, a.x, a.y, a.z, q.w, q.i, q.j, q.k, l.x, l.y, l.z]
    }

    /// How many [`exact_numbers`](Self::exact_numbers) there are.
    pub const EXACT_NUMBERS: usize = 22;

    /// All that the state holds.
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

    /// The state of [`exact_numbers`](Self::exact_numbers): its quaternion is taken as it is.
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
