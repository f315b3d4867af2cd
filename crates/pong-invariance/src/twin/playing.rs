//! Ways of playing a scene.

use crate::play::{Answer, Refusal, Stage};
use crate::random::Random;
use crate::scene::Scene;
use pong_engine::State;
use pong_geometry::{Pose, Vec3};

/// Way of playing a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Manner {
    /// Every frame evaluated and committed.
    #[default]
    Plain,
    /// Other states are evaluated between the frames and discarded.
    ThrownAway(u64),
    /// The contact state is saved after half of the frames and restored into a new world.
    Restored,
    /// The world has played other frames before, and its contact state was cleared.
    Forgotten,
    /// The world has this many workers.
    Workers(usize),
}

/// Plays a scene in a new world.
///
/// # Errors
///
/// The scene cannot be loaded or played; the text is the engine's message.
pub fn play(scene: &Scene, manner: Manner) -> Result<Vec<Answer>, Refusal> {
    let workers = if let Manner::Workers(count) = manner { count } else { 0 };
    let mut stage = Stage::set_up(scene, workers)?;
    match manner {
        Manner::Plain | Manner::Forgotten | Manner::Workers(_) => stage.play(&scene.frames),
        Manner::ThrownAway(seed) => {
            let mut random = Random::new(seed, 0, 0);
            let mut answers = Vec::new();
            for (frame, states) in scene.frames.iter().enumerate() {
                stage.move_surfaces(frame)?;
                for _ in 0..random.below(3) {
                    let other = random.pick(&scene.frames);
                    stage.evaluate(&shaken(&other, scene.size, &mut random))?;
                }
                answers.push(stage.evaluate(states)?);
                for _ in 0..random.below(2) {
                    stage.evaluate(&shaken(states, scene.size, &mut random))?;
                    stage.evaluate(states)?;
                }
                stage.commit()?;
            }
            Ok(answers)
        }
        Manner::Restored => {
            let half = scene.frames.len() / 2;
            let mut answers = Vec::new();
            for (frame, states) in scene.frames[..half].iter().enumerate() {
                stage.move_surfaces(frame)?;
                answers.push(stage.step(states)?);
            }
            let mut block = Vec::new();
            stage.world.save_state_packed(&mut block);
            let mut other = Stage::set_up(scene, 0)?;
            other.world.restore_state(&block).map_err(|error| error.to_string())?;
            for (frame, states) in (half..).zip(&scene.frames[half..]) {
                other.move_surfaces(frame)?;
                answers.push(other.step(states)?);
            }
            Ok(answers)
        }
    }
}

/// Other states nearby.
fn shaken(states: &[State; 2], size: f64, random: &mut Random) -> [State; 2] {
    states.map(|state| {
        let pose = state.pose();
        let shift: Vec3 = random.vector(0.2 * size);
        let pose = Pose {
            position: pose.position + shift,
            orientation: random.small_rotation(0.3) * pose.orientation,
        };
        State::from_motion(&pose, &state.twist())
    })
}
