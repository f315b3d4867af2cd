//! States set by the host.

use super::{Scene, SurfaceMotion};
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
    /// Motion of the surface of each movable group.
    pub surfaces: Vec<SurfaceMotion>,
    /// True if the surface of any movable group has a velocity or a travel.
    surfaces_move: bool,
    /// For each pair of Objects: true if it is tested.
    pub enabled: Vec<bool>,
}

impl States {
    /// Resizes to this many movable groups; new ones have no state.
    pub fn resize(&mut self, bodies: usize) {
        self.bodies.resize(bodies, None);
        self.poses.resize(bodies, Pose::identity());
        self.surfaces.resize(bodies, SurfaceMotion::default());
    }

    /// Sets the motions of surfaces: all of them or, if one is refused, none. Returns true if one differs from
    /// that set before.
    pub fn set_surfaces(
        &mut self,
        scene: &Scene,
        motions: &[(InterfaceId, SurfaceMotion)],
    ) -> Result<bool, EngineError> {
        if !scene.config.moving_surfaces && !motions.is_empty() {
            let cause = "the world was sealed for surfaces that do not move; set `moving_surfaces` in its settings, or set \
                         the motion of a surface before the seal";
            return Err(EngineError::BadValue {
                what: "motion of a surface".to_owned(),
                cause: cause.to_owned(),
            });
        }
        for (interface, motion) in motions {
            motion.require_acceptable(scene, scene.body_index(*interface)?)?;
        }
        let mut changed = false;
        for (interface, motion) in motions {
            let known = &mut self.surfaces[scene.body_index(*interface)?];
            changed |= !known.has_bits_of(motion);
            *known = *motion;
        }
        if changed {
            self.surfaces_move = self.surfaces.iter().any(SurfaceMotion::moves);
        }
        Ok(changed)
    }

    /// Returns true if the surface of any movable group has a velocity or a travel.
    pub fn any_surface_moves(&self) -> bool {
        self.surfaces_move
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
    /// Motions of surfaces are copied if they may move here.
    pub fn take_over(
        &mut self,
        from: &Self,
        (bodies, pairs): (&[Option<usize>], &[Option<usize>]),
        moving_surfaces: bool,
    ) {
        for (body, earlier) in bodies.iter().enumerate() {
            let set = earlier.filter(|&earlier| from.bodies[earlier].is_some());
            if let Some(earlier) = set {
                self.bodies[body] = from.bodies[earlier];
                self.poses[body] = from.poses[earlier];
            }
            if let Some(earlier) = earlier.filter(|_| moving_surfaces) {
                self.surfaces[body] = from.surfaces[earlier];
            }
        }
        self.surfaces_move = self.surfaces.iter().any(SurfaceMotion::moves);
        for (enabled, earlier) in self.enabled.iter_mut().zip(pairs) {
            *enabled = earlier.map_or(*enabled, |earlier| from.enabled[earlier]);
        }
    }

    /// Motion of the surface of a movable group, as it was set last.
    pub fn surface_of(&self, scene: &Scene, interface: InterfaceId) -> Result<&SurfaceMotion, EngineError> {
        Ok(&self.surfaces[scene.body_index(interface)?])
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
