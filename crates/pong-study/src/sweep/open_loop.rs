//! A log as the subject of a study: its motions played in the engine, again and again.

use crate::sweep::hashes::{hash_file, hash_model};
use crate::sweep::level::Level;
use crate::sweep::record::{Record, vector};
use crate::sweep::rewrite;
use crate::sweep::run::Frames;
use crate::{Result, StudyError};
use pong_engine::{EngineError, WorkerSettings};
use pong_geometry::Wrench;
use pong_model::Model;
use pong_model::{Extensions, Fnv};
use pong_record::{Event, Log, LogError, ReplayOptions, RerunFrame, rerun};
use std::path::{Path, PathBuf};

/// Replacement files for some models of a log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogAlternative {
    /// Name of the alternative.
    pub name: String,
    /// Names of models of the log, and the files that replace theirs.
    pub models: Vec<(String, PathBuf)>,
}

/// A log that is run many times.
pub(crate) struct LoggedRun {
    log: Log,
    alternatives: Vec<LogAlternative>,
    extensions: Extensions,
    /// The largest difference between the engine's wrenches and the log's own, relative to the largest in the
    /// log; `None` until known.
    apart: Option<f64>,
}

impl LoggedRun {
    /// Opens a log.
    pub fn open(folder: &Path, alternatives: &[LogAlternative], extensions: &Extensions) -> Result<Self> {
        let log = Log::open(folder)?;
        for alternative in alternatives {
            for (name, _) in &alternative.models {
                if !log.run().models.iter().any(|model| model.name == *name) {
                    let known: Vec<&str> = log.run().models.iter().map(|model| model.name.as_str()).collect();
                    let line = format!(
                        "the log has no model `{name}`; name one of those it has: {}",
                        known.join(", ")
                    );
                    return Err(StudyError::new(&format!("alternative `{}`", alternative.name), line));
                }
            }
        }
        Ok(Self { log, alternatives: alternatives.to_vec(), extensions: extensions.clone(), apart: None })
    }

    pub fn name(&self) -> &str {
        &self.log.run().name
    }

    pub fn alternatives(&self) -> Vec<String> {
        self.alternatives.iter().map(|alternative| alternative.name.clone()).collect()
    }

    /// True if a contact state was restored while the log was written: it fits only the same models and laws.
    pub fn restores(&self) -> bool {
        self.log.events().iter().any(|event| matches!(event.event, Event::Restore { .. }))
    }

    pub fn bodies(&self) -> usize {
        self.log.run().bodies.len()
    }

    /// Frames made of `logged` frames of the log each; the remainder is not run.
    pub fn frames(&mut self, logged: u32) -> Result<Frames> {
        let count = self.log.frame_count() / u64::from(logged);
        if count == 0 {
            let line =
                format!("it has {} frames, fewer than {logged}; record more of them", self.log.frame_count());
            return Err(StudyError::new("log", line));
        }
        let last = count * u64::from(logged) - 1;
        let mut rows = self.log.frame_rows(0, 1)?;
        rows.extend(self.log.frame_rows(last, 1)?);
        let mean = match rows[..] {
            [first, .., last_row] if last > 0 => (last_row.time - first.time) / last as f64,
            _ => 0.0,
        };
        Ok(Frames { frame_s: mean * f64::from(logged), count, instants: logged })
    }

    /// The largest relative difference between the engine's wrenches and the log's own, once the unchanged
    /// log was run.
    pub fn apart(&self) -> Option<f64> {
        self.apart
    }

    /// A hash of all inputs that determine the answers.
    pub fn hash(&self) -> Result<Fnv> {
        let mut hash = Fnv::default();
        hash.text(env!("CARGO_PKG_VERSION"));
        let folder = self.log.folder();
        let tables = ["frames", "states", "wrenches"].into_iter();
        let tables = tables.filter_map(|name| Some(self.log.run().tables.get(name)?.file.as_str()));
        for file in ["run.json"].into_iter().chain(tables) {
            hash_file(&mut hash, &folder.join(file))?;
        }
        hash.text(&format!("{:?}", self.log.events()));
        for alternative in &self.alternatives {
            hash.text(&format!("{alternative:?}"));
            alternative
                .models
                .iter()
                .try_for_each(|(_, file)| hash_model(&mut hash, file, &self.extensions))?;
        }
        Ok(hash)
    }

    /// Records a level; skipped frames have the wrench of the last frame evaluated.
    pub fn record(&mut self, level: &Level, frames: &Frames) -> Result<Record> {
        let bodies = self.bodies();
        let mut gathered = Gathered::new(bodies, frames);
        self.run(level, frames, &mut |frame| gathered.take(frame))?;
        if level.settings().is_empty() && level.steps_per_frame == frames.instants {
            self.apart = Some(gathered.apart());
        }
        Ok(gathered.record)
    }

    /// Times a level: for each frame, all engine calls in it.
    pub fn time(&mut self, level: &Level, frames: &Frames) -> Result<Vec<u64>> {
        let mut times = vec![0; frames.count as usize];
        let logged = u64::from(frames.instants);
        self.run(level, frames, &mut |frame| {
            times[(frame.index / logged) as usize] += frame.took_ns;
            Ok(())
        })?;
        Ok(times)
    }

    fn run(
        &mut self,
        level: &Level,
        frames: &Frames,
        each: &mut dyn FnMut(&RerunFrame<'_>) -> Result<(), LogError>,
    ) -> Result<()> {
        let run = self.log.run();
        let names: Vec<String> = run.models.iter().map(|model| model.name.clone()).collect();
        let wanted = level.alternative.as_ref();
        let found = wanted.and_then(|name| self.alternatives.iter().find(|other| other.name == *name));
        let instead = found.map_or(Vec::new(), |alternative| alternative.models.clone());
        let extensions = self.extensions.clone();
        let rewrite = |index: usize, model: Model| {
            let other = instead.iter().find(|(name, _)| *name == names[index]);
            let model = match other {
                Some((_, file)) => {
                    pong_model::load(file, &extensions).map_err(|errors| errors.to_string())?
                }
                None => model,
            };
            rewrite::model(model, level)
        };
        let workers = WorkerSettings { workers: level.workers, ..WorkerSettings::default() };
        let options = ReplayOptions {
            workers: (level.workers > 0).then_some(workers),
            rewrite: Some(&rewrite),
            extensions: extensions.clone(),
            ..ReplayOptions::default()
        };
        let wanted = frames.count * u64::from(frames.instants);
        let every = u64::from(frames.instants / level.steps_per_frame);
        let name = level.name(frames.frame_s);
        let result = rerun(&mut self.log, options, (wanted, every), each);
        result.map_err(|error| StudyError::new(&name, error))
    }
}

/// A record of a log being built.
struct Gathered {
    record: Record,
    time: f64,
    /// Largest difference from the log's wrenches, and their largest magnitude: force, moment.
    off: [f64; 2],
    size: [f64; 2],
}

impl Gathered {
    fn new(bodies: usize, frames: &Frames) -> Self {
        let record = Record::empty(bodies, frames.instants);
        Self { record, time: f64::NAN, off: [0.0; 2], size: [0.0; 2] }
    }

    fn take(&mut self, frame: &RerunFrame<'_>) -> Result<(), LogError> {
        let time = frame.logged.row.time;
        // The first frame ends no interval.
        let half = if self.time.is_nan() { 0.0 } else { 0.5 * (time - self.time) };
        let last = self.record.rows.len().saturating_sub(self.record.bodies * crate::sweep::record::VALUES);
        for (body, interface) in frame.bodies.iter().enumerate() {
            let wrench = frame.world.wrench_common(*interface).map_err(refused)?;
            let now = six(&wrench);
            let before = if half == 0.0 { now } else { self.before(last, body) };
            self.record.add(body, &before, &now, half);
            self.record.peak(body, &now);
            self.record.rows.extend(now);
            let state = &frame.logged.states[body];
            self.record.rows.extend(state.position);
            self.record.rows.extend(state.orientation);
            let logged = &frame.logged.wrenches[body];
            for (place, (own, other)) in
                [(now[..3].to_vec(), logged.force), (now[3..].to_vec(), logged.moment)]
                    .into_iter()
                    .enumerate()
            {
                self.off[place] = self.off[place].max((vector(&own) - vector(&other)).norm());
                self.size[place] = self.size[place].max(vector(&other).norm());
            }
        }
        self.record.incomplete += u64::from(!frame.world.report().status.is_complete());
        self.time = time;
        Ok(())
    }

    /// The wrench on a body at the previous instant, whose rows begin at an index.
    fn before(&self, rows: usize, body: usize) -> [f64; 6] {
        let start = rows.min(self.record.rows.len()) + body * crate::sweep::record::VALUES;
        let mut six = [0.0; 6];
        six.copy_from_slice(&self.record.rows[start..start + 6]);
        six
    }

    fn apart(&self) -> f64 {
        let share = |place: usize| {
            if self.off[place] == 0.0 { 0.0 } else { self.off[place] / self.size[place] }
        };
        share(0).max(share(1))
    }
}

fn six(wrench: &Wrench) -> [f64; 6] {
    let (f, m) = (wrench.force, wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

fn refused(error: EngineError) -> LogError {
    error.into()
}
