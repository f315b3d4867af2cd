//! Twins: the same scene told in another way, and how its wrenches are read in the words of the first.

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
    /// How its wrenches are read.
    pub back: Back,
    /// How it is played.
    pub manner: Manner,
    /// By how much telling it in another way moved something, m.
    pub rounding: f64,
    /// By how much that changed a velocity, m/s.
    pub rounding_of_velocity: f64,
}

/// From the wrenches of a twin to those of the first scene.
#[derive(Clone, Debug)]
pub struct Back {
    /// By which the whole scene was turned.
    pub turn: Quat,
    /// Ratio of the forces of the twin to those of the first.
    pub force: f64,
    /// Ratio of the moments of the twin to those of the first.
    pub moment: f64,
    /// Origins of the twin's groups in the groups of the first, m, frame by frame; all zero if there are none.
    pub origins: Vec<[Vec3; 2]>,
}

impl Twin {
    /// The same scene, to be changed.
    pub fn of(scene: &Scene) -> Self {
        let back = Back { turn: Quat::identity(), force: 1.0, moment: 1.0, origins: Vec::new() };
        Self { scene: scene.clone(), back, manner: Manner::Plain, rounding: 0.0, rounding_of_velocity: 0.0 }
    }

    /// The same scene played in another way.
    pub fn played(scene: &Scene, manner: Manner) -> Self {
        Self { manner, ..Self::of(scene) }
    }

    /// Plays it; where only states differ, in the world of the first scene.
    ///
    /// # Errors
    ///
    /// The twin cannot be loaded or played; the text is the engine's message.
    pub fn play(&self, first: &Scene, stage: &mut Stage) -> Result<Vec<Answer>, Refusal> {
        if let Manner::Plain | Manner::Forgotten = self.manner
            && first.bodies == self.scene.bodies
            && first.swapped == self.scene.swapped
        {
            return stage.play(&self.scene.frames);
        }
        playing::play(&self.scene, self.manner)
    }

    /// A frame's wrenches as the first scene would tell them.
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
