//! A run with changed models: a scene, or the motions of a log.

use crate::runs::motions::{Commit, Gatherer, Motions, rows};
use crate::runs::play::{Held, Player, bodies};
use crate::runs::subject::Subject;
use crate::{Result, StudyError};
use pong_engine::EngineError;
use pong_executive::scene::{BuiltScene, Scene, Variation};
use pong_model::{Extensions, Model};
use pong_record::{Event, FrameRow, Log, LoggedEvent, ReplayOptions, rerun, world_of_log};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A run.
pub(crate) struct Run {
    pub name: String,
    source: Source,
    /// Index of each model's subject, with the file of the model (scene) or its position (log).
    models: Vec<(PathBuf, usize)>,
    /// Number of its frames.
    pub frames: u64,
    extensions: Extensions,
}

enum Source {
    Scene(Box<Scene>),
    Log(PathBuf),
}

/// Called with the number of frames done; its error ends the run.
pub(crate) type Tick<'a> = &'a mut dyn FnMut(u64) -> Result<()>;

/// Ranges of the frames to keep, given the positions of a log's events.
type Rows<'a> = &'a mut dyn FnMut(&[u64]) -> Vec<(u64, u64)>;

impl Run {
    /// Reads a scene, or the folder of a log; new models are added to the subjects.
    pub fn load(
        path: &Path,
        duration_s: Option<f64>,
        extensions: &Extensions,
        subjects: &mut Vec<Subject>,
    ) -> Result<Self> {
        if path.is_dir() {
            Self::of_log(path, duration_s, extensions, subjects)
        } else {
            Self::of_scene(path, duration_s, extensions, subjects)
        }
    }

    fn of_scene(
        path: &Path,
        duration_s: Option<f64>,
        extensions: &Extensions,
        subjects: &mut Vec<Subject>,
    ) -> Result<Self> {
        let scene = Scene::load(path)?;
        let scene = scene.with_extensions(extensions.clone());
        let built = scene.build()?;
        let mut models = Vec::new();
        for file in &built.model_files {
            models.push((file.clone(), subject(file, false, extensions, subjects)?));
        }
        let steps = duration_s.map_or(built.steps as f64, |duration| libm::round(duration / scene.step()));
        let name = scene.name().to_owned();
        let extensions = extensions.clone();
        let source = Source::Scene(Box::new(scene));
        Ok(Self { name, source, models, frames: steps as u64 + 1, extensions })
    }

    fn of_log(
        path: &Path,
        duration_s: Option<f64>,
        extensions: &Extensions,
        subjects: &mut Vec<Subject>,
    ) -> Result<Self> {
        let mut log = open(path)?;
        let mut models = Vec::new();
        for index in 0..log.run().models.len() {
            let file = log.model_path(index).unwrap_or_default();
            models.push((file.clone(), subject(&file, true, extensions, subjects)?));
        }
        let mut frames = log.frame_count();
        if let Some(duration) = duration_s {
            let rows = log.frame_rows(0, frames)?;
            let first = rows.first().map_or(0.0, |row| row.time);
            frames = rows.iter().take_while(|row| row.time - first <= duration).count() as u64;
        }
        let (name, source) = (log.run().name.clone(), Source::Log(path.to_owned()));
        Ok(Self { name, source, models, frames, extensions: extensions.clone() })
    }

    /// Runs it unchanged and keeps its motions, at most `wanted` frames.
    pub fn gather(&self, wanted: u64, tick: Tick<'_>) -> Result<Motions> {
        let mut rows_without = |events: &[u64]| rows(self.frames, wanted, events);
        let motions = self.repeat(None, &mut rows_without, tick)?;
        if motions.windows.is_empty() {
            return Err(StudyError::new(&self.name, "it has no frame to tune for; give a run that has some"));
        }
        Ok(motions)
    }

    /// Runs all of it again with other models, one for each subject; returns the first frame with another
    /// answer.
    pub fn differs(&self, made: &[Arc<Model>], motions: &Motions, tick: Tick<'_>) -> Result<Option<String>> {
        let again = self.repeat(Some(made), &mut |_| Vec::new(), tick)?.answers;
        if again.len() != motions.answers.len() {
            return Ok(Some("the number of frames".to_owned()));
        }
        let mut pairs = again.iter().zip(&motions.answers).enumerate();
        Ok(pairs.find_map(|(frame, (new, old))| Some(format!("{} of frame {frame}", new.difference(old)?))))
    }

    /// Runs it from its start and keeps the frames of `rows`, which is called with the positions of a log's
    /// events.
    fn repeat(&self, made: Option<&[Arc<Model>]>, rows: Rows<'_>, tick: Tick<'_>) -> Result<Motions> {
        match &self.source {
            Source::Scene(scene) => {
                let built = build(scene, made.map(|made| (self, made)))?;
                self.follow(built, rows(&[]), tick)
            }
            Source::Log(path) => {
                let mut log = open(path)?;
                let events = places_of_events(&mut log, self.frames)?;
                self.rerun(log, made.unwrap_or_default(), rows(&events), tick)
            }
        }
    }

    /// A world that plays kept motions, with a model for each subject.
    pub fn player(&self, made: &[Arc<Model>]) -> Result<Player> {
        let held = match &self.source {
            Source::Scene(scene) => Held::Scene(Box::new(build(scene, Some((self, made)))?)),
            Source::Log(path) => {
                let instead = |index: usize| Some(Arc::clone(&made[self.models[index].1]));
                let options = self.options(&instead);
                Held::World(Box::new(world_of_log(&open(path)?, options)?))
            }
        };
        Player::new(held).map_err(|error| self.refused(&error))
    }

    /// Options for running a log with these models in place of its own.
    fn options<'a>(&self, instead: &'a dyn Fn(usize) -> Option<Arc<Model>>) -> ReplayOptions<'a> {
        let extensions = self.extensions.clone();
        ReplayOptions { instead: Some(instead), extensions, ..ReplayOptions::default() }
    }

    pub fn refused(&self, error: &EngineError) -> StudyError {
        StudyError::new(&self.name, error)
    }

    /// Runs the scene; keeps every answer, and the frames of `rows`.
    fn follow(&self, mut built: BuiltScene, rows: Vec<(u64, u64)>, tick: Tick<'_>) -> Result<Motions> {
        let refused = |error: EngineError| self.refused(&error);
        let bodies = bodies(built.simulation.world()).map_err(refused)?;
        let mut gatherer = Gatherer::new(rows);
        for frame in 0..self.frames {
            gatherer.before(built.simulation.world()).map_err(refused)?;
            let moved =
                if frame == 0 { built.simulation.commit_initial_states() } else { built.simulation.step() };
            moved.map_err(|error| StudyError::new(&self.name, error))?;
            gatherer.after(built.simulation.world(), &bodies, Commit::All).map_err(refused)?;
            tick(frame + 1)?;
        }
        Ok(gatherer.finish())
    }

    /// Runs the log's motions, event by event; keeps the same.
    fn rerun(
        &self,
        mut log: Log,
        made: &[Arc<Model>],
        rows: Vec<(u64, u64)>,
        tick: Tick<'_>,
    ) -> Result<Motions> {
        let instead = |index: usize| made.get(self.models[index].1).cloned();
        let options = || self.options(&instead);
        let mut gatherer = Gatherer::new(rows);
        let fresh = world_of_log(&log, options())?;
        gatherer.before(&fresh).map_err(|error| self.refused(&error))?;
        drop(fresh);
        let events = log.events().to_vec();
        rerun(&mut log, options(), (self.frames, 1), &mut |frame| -> Result<()> {
            let commit = commit(&frame.logged.row, &events);
            let gathered = gatherer.after(frame.world, frame.bodies, commit);
            gathered.and_then(|()| gatherer.before(frame.world)).map_err(|error| self.refused(&error))?;
            tick(frame.index + 1)
        })?;
        Ok(gatherer.finish())
    }
}

/// The host's commit of a frame of the log.
fn commit(row: &FrameRow, events: &[LoggedEvent]) -> Commit {
    let accepted = |event: &LoggedEvent| match &event.event {
        Event::Commit { pairs } if event.frame == row.frame => Some(pairs.clone()),
        _ => None,
    };
    match row.committed {
        FrameRow::EVALUATED => Commit::Nothing,
        FrameRow::COMMITTED_SOME => {
            Commit::Pairs(events.iter().filter_map(accepted).flatten().map(|pair| pair as usize).collect())
        }
        _ => Commit::All,
    }
}

/// Sorted positions of the log's frames before which its host did more than set states.
fn places_of_events(log: &mut Log, frames: u64) -> Result<Vec<u64>> {
    let changes = log.events().iter().filter(|event| !matches!(event.event, Event::Commit { .. }));
    let numbers: Vec<u64> = changes.map(|event| event.frame).collect();
    let rows = log.frame_rows(0, frames)?;
    let mut places: Vec<u64> =
        numbers.iter().map(|number| rows.partition_point(|row| row.frame < *number) as u64).collect();
    places.sort_unstable();
    places.dedup();
    Ok(places)
}

/// The subject of a model file; an earlier one if the contents are equal.
fn subject(file: &Path, in_log: bool, extensions: &Extensions, subjects: &mut Vec<Subject>) -> Result<usize> {
    let new = Subject::load(file, in_log, extensions)?;
    let known = subjects.iter().position(|known| known.hash == new.hash && known.text == new.text);
    Ok(known.unwrap_or_else(|| {
        subjects.push(new);
        subjects.len() - 1
    }))
}

fn build(scene: &Scene, made: Option<(&Run, &[Arc<Model>])>) -> Result<BuiltScene> {
    let instead = |file: &Path| {
        let (run, made) = made?;
        let (_, subject) = run.models.iter().find(|(other, _)| other == file)?;
        Some(Arc::clone(&made[*subject]))
    };
    let variation = Variation { instead: Some(&instead), ..Variation::default() };
    Ok(scene.build_varied(&variation)?)
}

fn open(path: &Path) -> Result<Log> {
    Ok(Log::open(path)?)
}
