//! One run of a level.

use crate::sweep::level::{Level, Motion};
use crate::sweep::record::{Record, Recorder};
use crate::sweep::rewrite;
use crate::{Result, StudyError};
use pong_engine::WorkerSettings;
use pong_executive::scene::{BuiltScene, Scene, Variation};
use pong_executive::{ExecutiveError, Simulation};
use std::time::Instant;

/// The frames of a study, the same for every level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    /// Length of a frame, s: the longest step. For a log the mean.
    pub frame_s: f64,
    /// Number of frames.
    pub count: u64,
    /// Most instants in a frame at which runs are compared; a power of two.
    pub instants: u32,
}

/// Outcome of a run.
pub(crate) enum Ended {
    Whole(Record),
    /// A state left the range of numbers at this time, s.
    Diverged(f64),
}

/// Runs a level and records it.
pub(crate) fn record(scene: &Scene, level: &Level, frames: &Frames) -> Result<Ended> {
    let mut simulation = build(scene, level, frames)?.simulation;
    let per_frame = level.steps_per_frame.min(frames.instants);
    let every = u64::from(level.steps_per_frame / per_frame);
    match follow(&mut simulation, per_frame, every, frames.count * u64::from(level.steps_per_frame)) {
        Ok(record) => Ok(Ended::Whole(record)),
        Err(ExecutiveError::Diverged { time, .. }) => Ok(Ended::Diverged(time)),
        Err(error) => Err(StudyError::new(&level.name(frames.frame_s), error)),
    }
}

fn follow(
    simulation: &mut Simulation,
    per_frame: u32,
    every: u64,
    steps: u64,
) -> Result<Record, ExecutiveError> {
    simulation.commit_initial_states()?;
    let mut recorder = Recorder::new(simulation, per_frame);
    for done in 1..=steps {
        simulation.step()?;
        recorder.step(simulation);
        if done.is_multiple_of(every) {
            recorder.instant(simulation);
        }
    }
    Ok(recorder.finish())
}

/// Runs a level that is known to reach the end; returns the time of every frame, ns.
pub(crate) fn time(scene: &Scene, level: &Level, frames: &Frames) -> Result<Vec<u64>> {
    let fails = |error: ExecutiveError| StudyError::new(&level.name(frames.frame_s), error);
    let mut simulation = build(scene, level, frames)?.simulation;
    simulation.commit_initial_states().map_err(fails)?;
    let mut times = Vec::with_capacity(frames.count as usize);
    for _ in 0..frames.count {
        let begin = Instant::now();
        for _ in 0..level.steps_per_frame {
            simulation.step().map_err(fails)?;
        }
        times.push(begin.elapsed().as_nanos() as u64);
    }
    Ok(times)
}

pub(crate) fn build(scene: &Scene, level: &Level, frames: &Frames) -> Result<BuiltScene> {
    let rewrite = |model| rewrite::model(model, level);
    let workers = WorkerSettings { workers: level.workers, ..WorkerSettings::default() };
    let integrator = match level.motion {
        Motion::Integrated(integrator) => Some(integrator),
        Motion::Logged(_) => None,
    };
    let variation = Variation {
        integrator,
        step: Some(frames.frame_s / f64::from(level.steps_per_frame)),
        workers: (level.workers > 0).then_some(workers),
        alternative: level.alternative.as_deref(),
        rewrite: Some(&rewrite),
        ..Variation::default()
    };
    Ok(scene.build_varied(&variation)?)
}
