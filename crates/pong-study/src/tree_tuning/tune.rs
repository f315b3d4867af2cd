//! The whole procedure: read runs, keep motions, search, compare the whole run, time before and after in
//! turn, write files.

use crate::runs::counts::Counts;
use crate::runs::motions::Motions;
use crate::runs::output::{Output, headed};
use crate::runs::run::Run;
use crate::runs::subject::hash_of_trees;
use crate::runs::subject::{Shape, Subject};
use crate::tree_tuning::bench::{Bench, FrameTimes, relative};
use crate::tree_tuning::search::{Found, LEAST_GAIN, OVER_NOISE, Proposal, base, search};
use crate::tree_tuning::words;
use crate::{Result, StudyError};
use pong_model::{Extensions, Model};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Suffix of the names of tuned files, and the text at their head.
pub(crate) const TUNED: &str = "tuned";
pub(crate) const DONE: &str = "Bounds and leaves by `pong tune`";

/// Settings of a tuning.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Number of timings of every proposal; before and after three times as many.
    pub rounds: u32,
    /// Frames of each run that are timed in the end; the search uses a quarter of them.
    pub frames: u64,
    /// Part of each run to use, s.
    pub duration_s: Option<f64>,
    /// Output of files.
    pub output: Output,
    /// Extensions for the models, and the folders allowed for their files.
    pub extensions: Extensions,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            rounds: 5,
            frames: 4096,
            duration_s: None,
            output: Output::default(),
            extensions: Extensions::new(),
        }
    }
}

/// Progress of a tuning.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// Frames of a run, done and in all, while it is run from end to end.
    Running {
        /// Purpose of the run.
        doing: String,
        /// Frames done.
        done: u64,
        /// Frames in all.
        of: u64,
    },
    /// The present trial of the search.
    Searching(String),
}

/// Called now and then; a tuning stopped by it writes nothing.
type Watch<'a> = &'a mut dyn FnMut(&Progress) -> ControlFlow<()>;

/// Reports progress; fails if the tuning is to stop.
fn tell(watch: Watch<'_>, progress: &Progress) -> Result<()> {
    match watch(progress) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(StudyError::new("tuning", "stopped; run it again")),
    }
}

/// Result of a tuning.
#[derive(Clone, Debug)]
pub struct Tuned {
    /// The runs, in the order they were given.
    pub runs: Vec<RunTuned>,
    /// The models, each once.
    pub models: Vec<ModelTuned>,
    /// Proposals that were refused because they would have changed an answer, or could not be made.
    pub refused: Vec<String>,
    /// Number of proposals compared bit by bit, and of those timed.
    pub tried: [usize; 2],
    /// The fraction by which the time is shorter.
    pub gain: f64,
    /// The relative difference of two timings of the same thing, in the last timing.
    pub noise: f64,
    /// True if files were written.
    pub taken: bool,
}

/// A run before and after.
#[derive(Clone, Debug)]
pub struct RunTuned {
    /// Its name.
    pub name: String,
    /// Frames of the whole run, all of them compared.
    pub frames: u64,
    /// Frames in which the engine left contacts out because of a limit.
    pub limited: u64,
    /// Before, before once more, and after: the shortest time of each timed frame, ns.
    pub times_ns: [Vec<u64>; 3],
    /// Counts over these frames before and after.
    pub counts: [Counts; 2],
}

/// A model before and after.
#[derive(Clone, Debug)]
pub struct ModelTuned {
    /// Its name.
    pub name: String,
    /// Its file.
    pub file: PathBuf,
    /// Changes, group by group; empty if there are none.
    pub changes: Vec<String>,
    /// The file that was written.
    pub written: Option<PathBuf>,
}

/// Tunes the models of some runs, each a scene file or the folder of a log, for all of them together.
///
/// # Errors
/// A run or a model with a fault, an output file that exists or cannot be written, a tuning stopped by
/// `watch`.
pub fn tune(paths: &[&Path], settings: &Settings, watch: Watch<'_>) -> Result<Tuned> {
    check(settings)?;
    let mut subjects = Vec::new();
    let mut runs = Vec::new();
    for path in paths {
        runs.push(Run::load(path, settings.duration_s, &settings.extensions, &mut subjects)?);
    }
    settings.output.check(&subjects, TUNED)?;
    let mut motions = Vec::new();
    for run in &runs {
        motions.push(run.gather(settings.frames, &mut ticker(watch, "runs", run))?);
    }
    Job { subjects, runs, motions, settings }.tune(watch)
}

fn check(settings: &Settings) -> Result<()> {
    if let Some(duration) = settings.duration_s.filter(|duration| !(*duration > 0.0 && duration.is_finite()))
    {
        return Err(StudyError::new(
            "--duration",
            format!("it is {duration} s; give a finite time above zero"),
        ));
    }
    if settings.rounds == 0 || settings.frames == 0 {
        return Err(StudyError::new("settings", "nothing is timed; give at least 1 round and 1 frame"));
    }
    Ok(())
}

/// Reports the number of frames done, now and then.
fn ticker<'w>(watch: Watch<'w>, doing: &str, run: &Run) -> impl FnMut(u64) -> Result<()> + use<'w> {
    let (doing, of) = (format!("{doing} {}", run.name), run.frames);
    move |done| {
        if !done.is_multiple_of(256) && done != of {
            return Ok(());
        }
        tell(watch, &Progress::Running { doing: doing.clone(), done, of })
    }
}

struct Job<'a> {
    subjects: Vec<Subject>,
    runs: Vec<Run>,
    motions: Vec<Motions>,
    settings: &'a Settings,
}

/// Stride of the windows that the search plays.
const STRIDE: usize = 4;

impl Job<'_> {
    fn tune(&self, watch: Watch<'_>) -> Result<Tuned> {
        let authored: Proposal = self.subjects.iter().map(|subject| subject.shape.authored()).collect();
        self.check_player(&authored)?;
        let shapes: Vec<&Shape> = self.subjects.iter().map(|subject| &subject.shape).collect();
        let mut bench = self.bench(STRIDE);
        let mut hears = |words: &str| tell(watch, &Progress::Searching(words.to_owned()));
        let mut found = search(&mut bench, &shapes, authored.clone(), self.settings.rounds, &mut hears)?;
        if found.best != authored
            && let Some(why) = self.whole_runs(&mut bench, &found.best, watch)?
        {
            let differing = (0..shapes.len()).filter(|model| found.best[*model] != authored[*model]);
            found.refused.extend(differing.map(|model| (model, found.best[model].clone(), why.clone())));
            found.best.clone_from(&authored);
        }
        tell(watch, &Progress::Searching("before and after".to_owned()))?;
        let mut tuned = self.timed(&authored, &found)?;
        tuned.taken = found.best != authored && tuned.gain > LEAST_GAIN.max(OVER_NOISE * tuned.noise);
        if tuned.taken {
            self.write(&mut bench, &found.best, &mut tuned)?;
        }
        Ok(tuned)
    }

    fn bench(&self, stride: usize) -> Bench<'_> {
        let fewest = self.motions.iter().map(|motions| motions.windows.len()).min().unwrap_or(1);
        Bench::new(&self.subjects, &self.runs, &self.motions, stride.min(fewest.max(1)))
    }

    /// Checks that the unchanged models give the run's own bits when its motions are played.
    fn check_player(&self, authored: &Proposal) -> Result<()> {
        match self.bench(1).compare(authored)? {
            Ok(_) => Ok(()),
            Err(why) => Err(StudyError::new(
                "motions",
                format!("played again, with nothing changed, {why}; the run cannot be tuned for"),
            )),
        }
    }

    /// Compares every frame of every run with other models; returns the first difference.
    fn whole_runs(
        &self,
        bench: &mut Bench<'_>,
        proposal: &Proposal,
        watch: Watch<'_>,
    ) -> Result<Option<String>> {
        let models = bench.models(proposal)?.0;
        for (run, motions) in self.runs.iter().zip(&self.motions) {
            let what = run.differs(&models, motions, &mut ticker(watch, "compares", run))?;
            if let Some(what) = what {
                return Ok(Some(format!("{what} of `{}` would not be the same bits", run.name)));
            }
        }
        Ok(None)
    }

    /// Times before, before once more and after, in turn; returns the report.
    fn timed(&self, authored: &Proposal, found: &Found) -> Result<Tuned> {
        let mut bench = self.bench(1);
        let refused = |why: String| StudyError::new("compare", why);
        let before = bench.compare(authored)?.map_err(refused)?;
        let after = bench.compare(&found.best)?.map_err(refused)?;
        let times = bench.times(&[authored, &found.best, authored], 3 * self.settings.rounds)?;
        let [one, new, two]: [Vec<FrameTimes>; 3] = times.try_into().expect("three were timed");
        let (least, noise) = base(1.0, relative(&two, &one));
        let gain = 1.0 - relative(&new, &one) / least;
        let mut runs = Vec::new();
        for (index, (run, motions)) in self.runs.iter().zip(&self.motions).enumerate() {
            runs.push(RunTuned {
                name: run.name.clone(),
                frames: run.frames,
                limited: motions.limited,
                times_ns: [one[index].clone(), two[index].clone(), new[index].clone()],
                counts: [before[index].clone(), after[index].clone()],
            });
        }
        let models = self.subjects.iter().zip(authored).zip(&found.best);
        let models = models.map(|((subject, before), after)| ModelTuned {
            name: subject.shape.name.clone(),
            file: subject.file.clone(),
            changes: words::changes(&subject.shape, before, after),
            written: None,
        });
        let refused = found.refused.iter().map(|(model, grouping, why)| {
            let shape = &self.subjects[*model].shape;
            let changes = words::changes(shape, &authored[*model], grouping);
            format!("{}: {why} ({})", shape.name, changes.join(", "))
        });
        Ok(Tuned {
            models: models.collect(),
            refused: refused.collect(),
            runs,
            tried: [found.compared, found.timed],
            gain,
            noise,
            taken: false,
        })
    }

    fn write(&self, bench: &mut Bench<'_>, best: &Proposal, tuned: &mut Tuned) -> Result<()> {
        let names: Vec<&str> = self.runs.iter().map(|run| run.name.as_str()).collect();
        for (index, subject) in self.subjects.iter().enumerate() {
            if best[index] != subject.shape.authored() {
                let text = headed(&subject.text(&best[index])?, DONE, &names.join("`, `"));
                let trees = bench.trees_of(best, index)?;
                let expected = |model: &Model| model.hash == subject.hash && hash_of_trees(model) == trees;
                let written = self.settings.output.write((subject, TUNED), &text, &expected)?;
                tuned.models[index].written = Some(written);
            }
        }
        Ok(())
    }
}
