//! A scene with its world and its answers, the reference for all twins.

use crate::play::{Answer, Refusal, Stage};
use crate::scene::Scene;

/// A scene after its run.
pub struct Base {
    /// The scene.
    pub scene: Scene,
    /// Its world, which can play other states.
    pub stage: Stage,
    /// The answers, frame by frame.
    pub answers: Vec<Answer>,
}

impl Base {
    /// Loads a scene and plays it.
    ///
    /// # Errors
    ///
    /// The scene cannot be loaded or played; the text is the engine's message.
    pub fn new(scene: Scene) -> Result<Self, Refusal> {
        let mut stage = Stage::set_up(&scene, 0)?;
        let answers = stage.play(&scene.frames)?;
        Ok(Self { scene, stage, answers })
    }

    /// Largest force of a contact up to a frame, N.
    pub fn largest(&self, frame: usize) -> f64 {
        self.answers[..=frame].iter().map(|answer| answer.largest).fold(0.0, f64::max)
    }
}
