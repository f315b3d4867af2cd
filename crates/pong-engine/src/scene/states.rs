//! The states that the host sets.

use super::Scene;
use crate::error::EngineError;
use crate::ids::InterfaceId;
use pong_geometry::{Pose, Twist, Vec3};
use std::ops::RangeInclusive;

/// What the host sets at any time.
#[derive(Clone, Debug, Default)]
pub(crate) struct States {
    /// One per movable group, if it was set.
    pub bodies: Vec<Option<State>>,
    /// Their poses, the quaternions normalised.
    pub poses: Vec<Pose>,
    /// One per pair of Objects: whether it is tested.
    pub enabled: Vec<bool>,
}

impl States {
    /// Room for so many movable groups, none of which was set yet beyond those that are there.
    pub fn resize(&mut self, bodies: usize) {
        self.bodies.resize(bodies, None);
        self.poses.resize(bodies, Pose::identity());
    }

    /// Sets the states of movable groups: all of them, or, if any is refused, none. Answers whether any differs from the one
    /// that was set before.
    #[inline]
    pub fn set(&mut self, scene: &Scene, states: &[(InterfaceId, State)]) -> Result<bool, EngineError> {
        for (interface, state) in states {
            let body = scene.body_index(*interface)?;
            if !state.is_acceptable() {
                let cause = why_refused(state);
                return Err(EngineError::BadState { interface: scene.body_name(body), cause });
            }
        }
        let mut changed = false;
        for (interface, state) in states {
            let body = scene.body_index(*interface)?;
            let known = &mut self.bodies[body];
            if !known.as_ref().is_some_and(|known| known.has_bits_of(state)) {
                *known = Some(*state);
                self.poses[body] = state.pose();
                changed = true;
            }
        }
        Ok(changed)
    }

    /// The state last set for a movable group, as it was set; `None` if never.
    pub fn of(&self, scene: &Scene, interface: InterfaceId) -> Result<Option<&State>, EngineError> {
        Ok(self.bodies[scene.body_index(interface)?].as_ref())
    }
}

/// How far a quaternion's norm may be from 1.
const NORM_ERROR_MAX: f64 = 1e-3;

/// Squares of the least and the largest norm.
const NORM_SQUARES: RangeInclusive<f64> = {
    let [least, largest] = [1.0 - NORM_ERROR_MAX, 1.0 + NORM_ERROR_MAX];
    least * least..=largest * largest
};

/// State of a movable group relative to and expressed in the common frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Position of the group's origin, m.
    pub position: [f64; 3],
    /// Quaternion (w, x, y, z), Hamilton, that rotates group components into common components; normalised here.
    pub orientation: [f64; 4],
    /// Velocity of the group's origin, m/s.
    pub linear_velocity: [f64; 3],
    /// Angular velocity, rad/s.
    pub angular_velocity: [f64; 3],
}

impl State {
    /// Largest component that is accepted: products of any two, with any stiffness, stay finite.
    pub const LARGEST: f64 = pong_model::LARGEST;

    /// At rest at the common origin.
    pub fn identity() -> Self {
        Self {
            position: [0.0; 3],
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
        }
    }

    /// From a pose and a twist.
    pub fn from_motion(pose: &Pose, twist: &Twist) -> Self {
        let q = &pose.orientation;
        Self {
            position: pose.position.into(),
            orientation: [q.w, q.i, q.j, q.k],
            linear_velocity: twist.linear.into(),
            angular_velocity: twist.angular.into(),
        }
    }

    /// The pose, its quaternion normalised.
    pub fn pose(&self) -> Pose {
        Pose::new(Vec3::from(self.position), self.orientation)
    }

    /// Whether a frame can compute with it: [`why_refused`] tells why not.
    fn is_acceptable(&self) -> bool {
        // Not short of any number: to look at all is quicker than to ask after each. By bits, which grow with the size and
        // are largest for what is no number: to compare such a value itself is an invalid operation.
        const SIZE: u64 = u64::MAX >> 1;
        let is_small = |value: &f64| (value.to_bits() & SIZE) as i64 <= Self::LARGEST.to_bits() as i64;
        let small = |values: &[f64]| values.iter().fold(true, |all, value| all & is_small(value));
        let vectors = small(&self.position) & small(&self.linear_velocity) & small(&self.angular_velocity);
        vectors & small(&self.orientation) && NORM_SQUARES.contains(&self.norm_square())
    }

    /// Whether every number is the same to the bit. As [`is_acceptable`](Self::is_acceptable), not short of any number.
    fn has_bits_of(&self, other: &Self) -> bool {
        let differ = |own: &[f64], others: &[f64]| {
            own.iter().zip(others).fold(0, |bits, (own, other)| bits | (own.to_bits() ^ other.to_bits()))
        };
        let pose = differ(&self.position, &other.position) | differ(&self.orientation, &other.orientation);
        let linear = differ(&self.linear_velocity, &other.linear_velocity);
        pose | linear | differ(&self.angular_velocity, &other.angular_velocity) == 0
    }

    /// Of the quaternion.
    fn norm_square(&self) -> f64 {
        self.orientation.iter().map(|x| x * x).sum()
    }

    /// The velocities.
    pub fn twist(&self) -> Twist {
        Twist { linear: Vec3::from(self.linear_velocity), angular: Vec3::from(self.angular_velocity) }
    }
}

/// What is wrong with a state that is not acceptable.
fn why_refused(state: &State) -> String {
    let named: [(&str, &[f64]); 4] = [
        ("position", &state.position),
        ("orientation", &state.orientation),
        ("linear velocity", &state.linear_velocity),
        ("angular velocity", &state.angular_velocity),
    ];
    for (name, values) in named {
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return format!("{name} holds {value}; give finite numbers");
        }
        if let Some(value) = values.iter().find(|value| value.abs() > State::LARGEST) {
            return format!(
                "{name} holds {value:e}, beyond what a frame can square; give at most {:e}",
                State::LARGEST
            );
        }
    }
    format!("the quaternion has norm {}; give a unit quaternion (w, x, y, z)", state.norm_square().sqrt())
}
