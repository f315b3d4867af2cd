//! States of movable groups: checked where they are set, latched where a frame begins.

use super::Frame;
use crate::error::EngineError;
use crate::sealed::Sealed;
use crate::world::Scene;
use pong_geometry::{Pose, Twist, Vec3};

/// How far a quaternion's norm may be from 1.
const NORM_ERROR_MAX: f64 = 1e-3;

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

    /// The velocities.
    pub fn twist(&self) -> Twist {
        Twist { linear: Vec3::from(self.linear_velocity), angular: Vec3::from(self.angular_velocity) }
    }
}

/// What is wrong with a state, if anything.
pub(crate) fn check_state(state: &State) -> Result<(), String> {
    let named: [(&str, &[f64]); 4] = [
        ("position", &state.position),
        ("orientation", &state.orientation),
        ("linear velocity", &state.linear_velocity),
        ("angular velocity", &state.angular_velocity),
    ];
    for (name, values) in named {
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(format!("{name} holds {value}; give finite numbers"));
        }
    }
    let norm = state.orientation.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (norm - 1.0).abs() > NORM_ERROR_MAX {
        return Err(format!("the quaternion has norm {norm}; give a unit quaternion (w, x, y, z)"));
    }
    Ok(())
}

/// Refuses a frame while a movable group of an enabled pair has no state.
pub(crate) fn require_states(scene: &Scene, sealed: &Sealed) -> Result<(), EngineError> {
    for pair in sealed.group_pairs.iter().filter(|pair| scene.pairs[pair.pair].enabled) {
        for body in [pair.first, pair.second] {
            if scene.bodies[body].state.is_none() {
                return Err(EngineError::UnsetState { interface: scene.body_name(body) });
            }
        }
    }
    Ok(())
}

/// Takes the states over into the frame.
pub(super) fn latch(scene: &Scene, frame: &mut Frame) {
    for (body, instance) in scene.bodies.iter().enumerate() {
        if let Some(state) = &instance.state {
            frame.poses[body] = state.pose();
            frame.twists[body] = state.twist();
        }
    }
}
