//! Motion of the surface of a movable group along itself: belts, tracks and turntables (docs/theory.md, 4).

use super::Scene;
use super::surface_field::SurfaceField;
use crate::error::EngineError;
use pong_model::LARGEST;

/// Motion of the surface of a movable group along itself, in the frame of the group, as of a belt, a track or a
/// turntable. The shape of the group does not move by it; only friction sees it. At a point p of the surface
/// with the outward unit normal n, the surface moves relative to the group at the velocity
///
/// ```text
/// linear + angular × p + belt × n
/// ```
///
/// of which the part in the contact plane counts. The three travels are the integrals of the three velocities over
/// time since any instant that the host chooses. Bristle friction follows the travels, as it follows poses, and is
/// damped by the velocities; `Coulomb` friction uses the velocities alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceMotion {
    /// Velocity of the whole surface, m/s: a belt that is seen from one side.
    pub linear_velocity: [f64; 3],
    /// Angular velocity of the surface about the origin of the group, rad/s: a turntable.
    pub angular_velocity: [f64; 3],
    /// Axis of the rollers of a belt that runs around the group, times the speed of the belt, m/s. On the upper
    /// run (n = z) of a belt with the axis y the surface moves along x, and on the lower run against it.
    pub belt_velocity: [f64; 3],
    /// Integral of `linear_velocity` over time, m.
    pub linear_travel: [f64; 3],
    /// Integral of `angular_velocity` over time, rad.
    pub angular_travel: [f64; 3],
    /// Integral of `belt_velocity` over time, m.
    pub belt_travel: [f64; 3],
}

impl SurfaceMotion {
    /// Adds the velocities times `step`, s, to the travels. For hosts whose velocities are constant in a step.
    pub fn advance(&mut self, step: f64) {
        let travels = [&mut self.linear_travel, &mut self.angular_travel, &mut self.belt_travel];
        let velocities = [&self.linear_velocity, &self.angular_velocity, &self.belt_velocity];
        for (travel, velocity) in travels.into_iter().zip(velocities) {
            travel.iter_mut().zip(velocity).for_each(|(travel, velocity)| *travel += velocity * step);
        }
    }

    /// All numbers: the velocities, then the travels.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let velocities = [&self.linear_velocity, &self.angular_velocity, &self.belt_velocity];
        let travels = [&self.linear_travel, &self.angular_travel, &self.belt_travel];
        velocities.into_iter().chain(travels).flatten().copied()
    }

    /// Returns true if any velocity or travel is not zero.
    pub(crate) fn moves(&self) -> bool {
        self.numbers().any(|x| x != 0.0)
    }

    /// Returns true if all numbers are bit-identical.
    pub(crate) fn has_bits_of(&self, other: &Self) -> bool {
        self.numbers().zip(other.numbers()).all(|(own, other)| own.to_bits() == other.to_bits())
    }

    /// Velocities as a field of position and normal, in the group's frame.
    pub(crate) fn velocity(&self) -> SurfaceField {
        SurfaceField::new([self.linear_velocity, self.angular_velocity, self.belt_velocity].map(Into::into))
    }

    /// Travels as a field of position and normal, in the group's frame.
    pub(crate) fn travel(&self) -> SurfaceField {
        SurfaceField::new([self.linear_travel, self.angular_travel, self.belt_travel].map(Into::into))
    }

    /// Returns an error that names the movable group if a number is not finite or too large.
    pub(crate) fn require_acceptable(&self, scene: &Scene, body: usize) -> Result<(), EngineError> {
        match self.numbers().find(|x| !(-LARGEST..=LARGEST).contains(x)) {
            None => Ok(()),
            Some(x) => Err(EngineError::BadState {
                interface: scene.body_name(body),
                cause: format!("the motion of its surface holds {x}; give finite numbers up to {LARGEST:e}"),
            }),
        }
    }
}
