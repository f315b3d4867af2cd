//! Twins: equivalent descriptions of a scene, and the transform of their wrenches back to the first scene.

pub mod manner;
pub mod place;
mod playing;
pub mod shape;

pub use playing::Manner;

use crate::play::{Answer, Refusal, Stage};
use crate::scene::Scene;
use pong_geometry::{Pose, Quat, Vec3, Wrench};

/// A scene that must give the same answers.
#[derive(Clone, Debug)]
pub struct Twin {
    /// The scene.
    pub scene: Scene,
    /// Transform of its wrenches back.
    pub back: Back,
    /// Way of playing.
    pub manner: Manner,
    /// Largest position error by rounding in the transform, m.
    pub rounding: f64,
    /// Largest velocity error by rounding in the transform, m/s.
    pub rounding_of_velocity: f64,
}

/// Transform from the wrenches of a twin to those of the first scene.
#[derive(Clone, Debug)]
pub struct Back {
    /// Rotation of the whole scene.
    pub turn: Quat,
    /// Ratio of the forces of the twin to those of the first.
    pub force: f64,
    /// Ratio of the moments of the twin to those of the first.
    pub moment: f64,
    /// Origins of the twin's groups in those of the first scene, m, frame by frame; empty if all are zero.
    pub origins: Vec<[Vec3; 2]>,
}

impl Twin {
    /// An unchanged copy of the scene, to be modified.
    pub fn of(scene: &Scene) -> Self {
        let back = Back { turn: Quat::identity(), force: 1.0, moment: 1.0, origins: Vec::new() };
        Self { scene: scene.clone(), back, manner: Manner::Plain, rounding: 0.0, rounding_of_velocity: 0.0 }
    }

    /// The scene, played differently.
    pub fn played(scene: &Scene, manner: Manner) -> Self {
        Self { manner, ..Self::of(scene) }
    }

    /// Plays the twin; if only states differ, in the world of the first scene.
    ///
    /// # Errors
    ///
    /// The twin cannot be loaded or played; the text is the engine's message.
    pub fn play(&self, first: &Scene, stage: &mut Stage) -> Result<Vec<Answer>, Refusal> {
        if let Manner::Plain | Manner::Forgotten = self.manner
            && first.bodies == self.scene.bodies
            && first.swapped == self.scene.swapped
            && first.motions == self.scene.motions
        {
            return stage.play(&self.scene.frames);
        }
        playing::play(&self.scene, self.manner)
    }

    /// Wrenches of a frame, transformed to the first scene.
    pub fn read(&self, answer: &Answer, first: &Scene, frame: usize) -> [Wrench; 2] {
        let Back { turn, force, moment, ref origins } = self.back;
        let origins = origins.get(frame).copied().unwrap_or_default();
        std::array::from_fn(|body| {
            let Wrench { force: f, moment: m } = answer.wrenches[body];
            let f = turn.inverse() * f / force;
            let pose: Pose = first.frames[frame][body].pose();
            let arm = pose.orientation * origins[body];
            Wrench { force: f, moment: turn.inverse() * m / moment + arm.cross(&f) }
        })
    }
}
