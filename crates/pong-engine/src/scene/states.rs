//! States set by the host.

use super::Scene;
use crate::error::EngineError;
use crate::ids::InterfaceId;
use pong_geometry::{Pose, Twist, Vec3};
use std::ops::RangeInclusive;

/// States set by the host at any time.
#[derive(Clone, Debug, Default)]
pub(crate) struct States {
    /// State of each movable group, if set.
    pub bodies: Vec<Option<State>>,
    /// Poses of the states, with normalised quaternions.
    pub poses: Vec<Pose>,
    /// For each pair of Objects: true if it is tested.
    pub enabled: Vec<bool>,
}

impl States {
    /// Resizes to this many movable groups; new ones have no state.
    pub fn resize(&mut self, bodies: usize) {
        self.bodies.resize(bodies, None);
        self.poses.resize(bodies, Pose::identity());
    }

    /// Sets the states of movable groups: all of them or, if one is refused, none. Returns true if a state
    /// differs from the state set before.
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

    /// Copies the states and enabled pairs of another world; `bodies` and `pairs` hold the indices in the
    /// other world. A state that was never set there is kept as it is here.
    pub fn take_over(&mut self, from: &Self, bodies: &[Option<usize>], pairs: &[Option<usize>]) {
        for (body, earlier) in bodies.iter().enumerate() {
            let set = earlier.filter(|&earlier| from.bodies[earlier].is_some());
            if let Some(earlier) = set {
                self.bodies[body] = from.bodies[earlier];
                self.poses[body] = from.poses[earlier];
            }
        }
        for (enabled, earlier) in self.enabled.iter_mut().zip(pairs) {
            *enabled = earlier.map_or(*enabled, |earlier| from.enabled[earlier]);
        }
    }

    /// State last set for a movable group, as it was set; `None` if never set.
    pub fn of(&self, scene: &Scene, interface: InterfaceId) -> Result<Option<&State>, EngineError> {
        Ok(self.bodies[scene.body_index(interface)?].as_ref())
    }
}

/// Largest deviation of a quaternion's norm from 1.
const NORM_ERROR_MAX: f64 = 1e-3;

/// Accepted range of the squared norm of a quaternion.
const NORM_SQUARES: RangeInclusive<f64> = {
    let [least, largest] = [1.0 - NORM_ERROR_MAX, 1.0 + NORM_ERROR_MAX];
    least * least..=largest * largest
};

/// State of a movable group relative to and expressed in the common frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Position of the group's origin, m.
    pub position: [f64; 3],
    /// Quaternion (w, x, y, z), Hamilton convention, that rotates group components into common components;
    /// normalised on use.
    pub orientation: [f64; 4],
    /// Velocity of the group's origin, m/s.
    pub linear_velocity: [f64; 3],
    /// Angular velocity, rad/s.
    pub angular_velocity: [f64; 3],
}

impl State {
    /// Largest accepted component: products of any two, with any stiffness, stay finite.
    pub const LARGEST: f64 = pong_model::LARGEST;

    /// State at rest at the common origin.
    pub fn identity() -> Self {
        Self {
            position: [0.0; 3],
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
        }
    }

    /// State from a pose and a twist.
    pub fn from_motion(pose: &Pose, twist: &Twist) -> Self {
        let q = &pose.orientation;
        Self {
            position: pose.position.into(),
            orientation: [q.w, q.i, q.j, q.k],
            linear_velocity: twist.linear.into(),
            angular_velocity: twist.angular.into(),
        }
    }

    /// Pose with normalised quaternion.
    pub fn pose(&self) -> Pose {
        Pose::new(Vec3::from(self.position), self.orientation)
    }

    /// Returns true if a frame can be computed from the state; see [`why_refused`].
    fn is_acceptable(&self) -> bool {
        // Branchless, which is faster than stopping at the first component. The bits are compared instead of
        // the numbers: without the sign they grow with the magnitude and are largest for NaN, and an ordered
        // comparison with NaN would be an invalid operation.
        const SIZE: u64 = u64::MAX >> 1;
        let is_small = |value: &f64| (value.to_bits() & SIZE) as i64 <= Self::LARGEST.to_bits() as i64;
        let small = |values: &[f64]| values.iter().fold(true, |all, value| all & is_small(value));
        let vectors = small(&self.position) & small(&self.linear_velocity) & small(&self.angular_velocity);
        vectors & small(&self.orientation) && NORM_SQUARES.contains(&self.norm_square())
    }

    /// Returns true if all components are bit-identical. Branchless, as in
    /// [`is_acceptable`](Self::is_acceptable).
    fn has_bits_of(&self, other: &Self) -> bool {
        let differ = |own: &[f64], others: &[f64]| {
            own.iter().zip(others).fold(0, |bits, (own, other)| bits | (own.to_bits() ^ other.to_bits()))
        };
        let pose = differ(&self.position, &other.position) | differ(&self.orientation, &other.orientation);
        let linear = differ(&self.linear_velocity, &other.linear_velocity);
        pose | linear | differ(&self.angular_velocity, &other.angular_velocity) == 0
    }

    /// Squared norm of the quaternion.
    fn norm_square(&self) -> f64 {
        self.orientation.iter().map(|x| x * x).sum()
    }

    /// Linear and angular velocity.
    pub fn twist(&self) -> Twist {
        Twist { linear: Vec3::from(self.linear_velocity), angular: Vec3::from(self.angular_velocity) }
    }
}

/// Reason why a state is not acceptable.
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
