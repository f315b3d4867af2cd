//! A study: the reference, every level run once for comparison, then all of them in turn for timing.

use crate::sweep::choice::{self, Point, percentile};
use crate::sweep::errors::{Errors, Quantity, errors};
use crate::sweep::hashes;
use crate::sweep::level::{Level, Lever, Motion};
use crate::sweep::open_loop::{LogAlternative, LoggedRun};
use crate::sweep::plan::{Plan, PlanSettings};
use crate::sweep::record::Record;
use crate::sweep::reference::Reference;
use crate::sweep::run::Ended;
use crate::sweep::store::Store;
use crate::sweep::subject::Subject;
use crate::{Result, StudyError};
use pong_executive::scene::Scene;
use pong_executive::{Integrator, Simulation};
use pong_model::{Extensions, Fnv};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::path::Path;

/// Settings of a study.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Choice of the levels.
    pub plan: PlanSettings,
    /// The largest relative error allowed for a level.
    pub within: f64,
    /// The quantities compared.
    pub of: Vec<Quantity>,
    /// Number of timings of every level.
    pub rounds: u32,
    /// Most halvings of the reference's step for convergence.
    pub refinements: u32,
    /// True to ignore results kept earlier.
    pub fresh: bool,
    /// Extensions for the models, and the folders allowed for their files.
    pub extensions: Extensions,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            plan: PlanSettings::default(),
            within: 0.02,
            of: Quantity::ALL.to_vec(),
            rounds: 3,
            refinements: 2,
            fresh: false,
            extensions: Extensions::new(),
        }
    }
}

/// Progress of a study.
#[derive(Clone, Debug)]
pub struct Progress<'a> {
    /// Engine calls done.
    pub done: u64,
    /// Engine calls in all, approximately.
    pub of: u64,
    /// The present run.
    pub doing: &'a str,
}

/// Called before every run; a study stopped by it can be continued later.
type Watch<'a> = &'a mut dyn FnMut(&Progress<'_>) -> ControlFlow<()>;

/// Result of a level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// It reached the end.
    Reached {
        /// Its errors.
        errors: Errors,
        /// Hash of every bit of its record.
        hash: u64,
        /// Steps in which the engine hit a limit.
        incomplete: u64,
    },
    /// A state left the range of numbers.
    Diverged {
        /// Time at which it was noticed, s.
        time_s: f64,
    },
}

impl Answer {
    /// The errors, if the end was reached.
    pub fn errors(&self) -> Option<&Errors> {
        match self {
            Self::Reached { errors, .. } => Some(errors),
            Self::Diverged { .. } => None,
        }
    }
}

/// Times of a level.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The shortest of all rounds, frame by frame, ns.
    pub frames_ns: Vec<u64>,
    /// The median frame of each round, ns.
    pub medians_ns: Vec<u64>,
}

impl Times {
    fn add(&mut self, round: Vec<u64>) {
        self.medians_ns.push(percentile(&round, 0.5));
        if self.frames_ns.is_empty() {
            self.frames_ns = round;
        } else {
            self.frames_ns.iter_mut().zip(round).for_each(|(kept, new)| *kept = new.min(*kept));
        }
    }

    /// The median frame, ns.
    pub fn median_ns(&self) -> u64 {
        percentile(&self.frames_ns, 0.5)
    }

    /// The 99th percentile of the frames, ns.
    pub fn tail_ns(&self) -> u64 {
        percentile(&self.frames_ns, 0.99)
    }

    /// Spread of the medians of the rounds: largest over smallest, less one.
    pub fn spread(&self) -> f64 {
        let least = self.medians_ns.iter().min().copied().unwrap_or(0).max(1);
        self.medians_ns.iter().max().copied().unwrap_or(0) as f64 / least as f64 - 1.0
    }
}

/// Reason for a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A step and an integrator.
    Grid,
    /// A change of one lever at a level of the grid.
    Around {
        /// The row of that level.
        anchor: usize,
        /// The lever.
        lever: Lever,
    },
}

/// A level and its results.
#[derive(Clone, Debug)]
pub struct Row {
    /// The level.
    pub level: Level,
    /// Its name.
    pub name: String,
    /// Its reason.
    pub place: Place,
    /// Its result.
    pub answer: Answer,
    /// Its times; `None` if it did not reach the end.
    pub times: Option<Times>,
    /// True if it is on the Pareto front of median frame time and worst error.
    pub on_front: bool,
}

/// Results of a study.
#[derive(Clone, Debug)]
pub struct Study {
    /// Name of the scene.
    pub scene: String,
    /// The plan.
    pub plan: Plan,
    /// Accuracy of the reference; `None` for a log, whose levels are compared with the engine at every frame.
    pub reference: Option<Reference>,
    /// For a log: the largest difference between the engine's wrenches and the log's own, relative to the
    /// peak.
    pub apart: Option<f64>,
    /// The levels: the grid, then those around the base, then those around the level chosen by its errors alone.
    pub rows: Vec<Row>,
    /// The row of the level with fewest engine calls within the tolerance, around which levers were varied
    /// again.
    pub second: Option<usize>,
    /// The row with the least median time within the tolerance; `None` if there is none or the reference has
    /// not converged.
    pub cheapest: Option<usize>,
    /// True if the reference is accurate enough to judge levels.
    pub converged: bool,
    /// The tolerance: a relative error.
    pub within: f64,
    /// The quantities compared.
    pub of: Vec<Quantity>,
}

impl Study {
    /// True if a log was studied.
    pub fn is_log(&self) -> bool {
        self.reference.is_none()
    }

    /// The estimated error of the reference in the quantities compared.
    pub fn uncertainty(&self) -> f64 {
        self.reference.as_ref().map_or(0.0, |reference| reference.uncertainty(&self.of))
    }

    /// The worst relative error of a row in the quantities compared.
    pub fn error(&self, row: &Row) -> Option<f64> {
        row.answer.errors().map(|errors| errors.worst(&self.of))
    }

    /// For a lever that must not change the answer, true if the row has the same bits as its anchor; `None`
    /// for others.
    pub fn same_bits(&self, row: &Row) -> Option<bool> {
        let Place::Around { anchor, lever } = row.place else { return None };
        let hash = |answer: &Answer| match answer {
            Answer::Reached { hash, .. } => Some(*hash),
            Answer::Diverged { .. } => None,
        };
        (!lever.changes_answers()).then(|| hash(&row.answer) == hash(&self.rows[anchor].answer))
    }
}

/// Studies a scene file and keeps finished results in a folder, so that a study that was stopped goes on
/// where it was.
///
/// # Errors
/// A scene or a model with a fault, a folder that cannot be written, a study stopped by `watch`.
pub fn study(scene: &Path, output: &Path, settings: &Settings, watch: Watch<'_>) -> Result<Study> {
    let text = pong_model::files::read_text(scene).unwrap_or_default();
    let scene = Scene::load(scene)?;
    let scene = scene.with_extensions(settings.extensions.clone());
    let built = scene.build()?;
    let plan = Plan::new(&scene, built.simulation.bodies().len(), &settings.plan)?;
    let hash = hashes::hash_of_scene(&scene, &text)?;
    let radii = radii(&built.simulation);
    drop(built);
    let store = Store::open(output, settings.fresh)?;
    let subject = Subject::Scene(Box::new(scene));
    let mut job = Job::new(subject, settings, &plan, hash, radii, store, watch);
    let (reference, record) = job.reference()?;
    let tolerance = settings.within - reference.uncertainty(&settings.of);
    let (rows, second) = job.rows(reference.steps_per_frame, &record, tolerance)?;
    let converged = reference.has_converged(&settings.of, settings.within);
    let scene = job.subject.name().to_owned();
    let (within, of, reference) = (settings.within, settings.of.clone(), Some(reference));
    Ok(judge(Study {
        scene,
        plan,
        reference,
        apart: None,
        rows,
        second,
        cheapest: None,
        converged,
        within,
        of,
    }))
}

/// Studies a log, open loop: its motions are played in the engine at every level, and the wrenches are
/// compared.
///
/// The step is the number of its frames that the engine sees; the wrench is held in between. Energy and pose
/// are not compared.
///
/// # Errors
/// As [`study`], and a log that cannot be read or whose world cannot be rebuilt.
pub fn study_log(
    log: &Path,
    alternatives: &[LogAlternative],
    output: &Path,
    settings: &Settings,
    watch: Watch<'_>,
) -> Result<Study> {
    let mut log = LoggedRun::open(log, alternatives, &settings.extensions)?;
    let mut settings = settings.clone();
    settings.of.retain(|quantity| !matches!(quantity, Quantity::Energy | Quantity::Pose));
    if settings.of.is_empty() {
        let line = "the motions of a log are what they are; ask for any of wrench, impulse, peak";
        return Err(StudyError::new("--of", line));
    }
    if log.restores() {
        settings.plan.levers.retain(|lever| !matches!(lever, Lever::Friction | Lever::Alternatives));
    }
    let plan = Plan::of_log(&mut log, &settings.plan)?;
    let (hash, radii) = (log.hash()?, vec![0.0; log.bodies()]);
    let store = Store::open(output, settings.fresh)?;
    let mut job = Job::new(Subject::Log(Box::new(log)), &settings, &plan, hash, radii, store, watch);
    let base = &plan.grid[plan.base];
    job.tell(base, "reference")?;
    let Ended::Whole(record) = job.subject.record(base, &plan.frames)? else {
        return Err(StudyError::new("log", "its end was not reached; use another copy of it"));
    };
    let (rows, second) = job.rows(base.steps_per_frame, &record, settings.within)?;
    let scene = job.subject.name().to_owned();
    let Subject::Log(log) = &job.subject else { unreachable!("a log was put in") };
    let (apart, within, of) = (log.apart(), settings.within, settings.of.clone());
    let (reference, converged) = (None, true);
    Ok(judge(Study { scene, plan, reference, apart, rows, second, cheapest: None, converged, within, of }))
}

/// Error from which a level is on no front, however fast it is: as large as that of no answer at all.
const USELESS: f64 = 1.0;

/// Marks the Pareto front and the cheapest level.
fn judge(mut study: Study) -> Study {
    let timed: Vec<(usize, Point)> = (0..study.rows.len())
        .filter_map(|index| {
            let row = &study.rows[index];
            let time = row.times.as_ref()?.median_ns() as f64;
            Some((index, Point { time, error: study.error(row)? }))
        })
        .collect();
    let points: Vec<Point> = timed.iter().map(|(_, point)| *point).collect();
    for ((index, point), on_front) in timed.iter().zip(choice::front(&points)) {
        study.rows[*index].on_front = on_front && point.error < USELESS;
    }
    let tolerance = study.within - study.uncertainty();
    let cheapest = choice::cheapest(&points, tolerance).filter(|_| study.converged);
    study.cheapest = cheapest.map(|place| timed[place].0);
    study
}

/// The level with the fewest engine calls: independent of the clock, so that the same levels are run every
/// time.
fn fewest_calls(rows: &[Row], of: &[Quantity], tolerance: f64) -> Option<usize> {
    let error = |row: &Row| row.answer.errors().map_or(f64::INFINITY, |errors| errors.worst(of));
    let good = (0..rows.len()).filter(|index| error(&rows[*index]) <= tolerance);
    good.min_by(|a, b| {
        let (a, b) = (&rows[*a], &rows[*b]);
        let calls = a.level.calls_per_frame().cmp(&b.level.calls_per_frame());
        calls.then(error(a).total_cmp(&error(b)))
    })
}

/// Radii of gyration of the free bodies, m: √(largest moment of inertia / mass).
fn radii(simulation: &Simulation) -> Vec<f64> {
    let radius = |mass: &pong_executive::MassProperties| {
        (mass.inertia.diagonal().iter().copied().fold(0.0, f64::max) / mass.mass).sqrt()
    };
    simulation.bodies().map(|(_, body)| body.mass().map_or(0.0, radius)).collect()
}

/// A study in progress.
struct Job<'a> {
    subject: Subject,
    settings: &'a Settings,
    plan: &'a Plan,
    inputs: u64,
    radii: Vec<f64>,
    store: Store,
    done: u64,
    all: u64,
    watch: Watch<'a>,
}

impl<'a> Job<'a> {
    fn new(
        subject: Subject,
        settings: &'a Settings,
        plan: &'a Plan,
        mut hash: Fnv,
        radii: Vec<f64>,
        store: Store,
        watch: Watch<'a>,
    ) -> Self {
        hash.word(plan.frames.frame_s.to_bits());
        hash.word(plan.frames.count);
        hash.word(plan.frames.instants.into());
        let mut job =
            Self { subject, settings, plan, inputs: hash.value(), radii, store, done: 0, all: 0, watch };
        job.all = job.calls_in_all();
        job
    }

    /// Approximate number of engine calls of the study.
    fn calls_in_all(&self) -> u64 {
        let (plan, settings) = (self.plan, self.settings);
        let runs = 1 + u64::from(settings.rounds);
        let grid: u64 = plan.grid.iter().map(Level::calls_per_frame).sum();
        let base = &plan.grid[plan.base];
        let around = plan.around(base, &self.subject.alternatives(), &settings.plan).len() as u64;
        let reference = 4 * (2 + 4 + 8) * u64::from(plan.finest);
        plan.frames.count * (runs * (grid + around * base.calls_per_frame()) + reference)
    }

    /// Every level, compared and timed, and the level around which levers were varied again.
    fn rows(
        &mut self,
        reference_steps: u32,
        record: &Record,
        tolerance: f64,
    ) -> Result<(Vec<Row>, Option<usize>)> {
        let plan = self.plan;
        let mut rows = Vec::new();
        for level in &plan.grid {
            rows.push(self.row(level, Place::Grid, reference_steps, record)?);
        }
        self.around(plan.base, &mut rows, reference_steps, record)?;
        let second = fewest_calls(&rows[..plan.grid.len()], &self.settings.of, tolerance);
        if let Some(second) = second.filter(|second| *second != plan.base) {
            self.around(second, &mut rows, reference_steps, record)?;
        }
        self.time(&mut rows)?;
        Ok((rows, second))
    }

    /// Reports the next run; fails if the study is to stop.
    fn tell(&mut self, level: &Level, doing: &str) -> Result<()> {
        let doing = format!("{doing} {}", level.name(self.plan.frames.frame_s));
        let progress = Progress { done: self.done, of: self.all.max(self.done), doing: &doing };
        let flow = (self.watch)(&progress);
        self.done += self.plan.frames.count * level.calls_per_frame();
        match flow {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(StudyError::new("study", "stopped; run it again to go on")),
        }
    }

    fn key(&self, parts: &[u64], level: Option<&Level>) -> u64 {
        let mut hash = Fnv::default();
        hash.word(self.inputs);
        parts.iter().for_each(|part| hash.word(*part));
        hash.text(&level.map(|level| format!("{level:?}")).unwrap_or_default());
        hash.value()
    }

    /// The reference and its record, kept earlier or run now.
    fn reference(&mut self) -> Result<(Reference, Record)> {
        let (of, settings) = (&self.settings.of, self.settings);
        let mut parts = vec![self.plan.finest.into(), settings.refinements.into(), settings.within.to_bits()];
        parts.extend(of.iter().map(|quantity| *quantity as u64));
        let key = self.key(&parts, None);
        if let (Some(reference), Some(record)) = (self.store.get("reference", key), self.store.record(key)) {
            return Ok((reference, record));
        }
        let (reference, record) = self.refine()?;
        self.store.put_record(key, &record)?;
        self.store.put("reference", key, &reference)?;
        Ok((reference, record))
    }

    /// Halves the step until three runs in a row agree well enough, or the limit of halvings is reached.
    fn refine(&mut self) -> Result<(Reference, Record)> {
        let mut steps = self.plan.finest;
        let (mut last, mut difference): (Option<Record>, Option<Errors>) = (None, None);
        for run in 0..3 + self.settings.refinements {
            steps *= 2;
            let level = Level::plain(Motion::Integrated(Integrator::RungeKutta4), steps);
            self.tell(&level, "reference")?;
            let Ended::Whole(record) = self.subject.record(&level, &self.plan.frames)? else { continue };
            let now = last.as_ref().map(|coarser| errors(coarser, &record, &self.radii));
            if let (Some(before), Some(now)) = (difference, now) {
                let reference = Reference::new(steps, &before, &now);
                let converged = reference.has_converged(&self.settings.of, self.settings.within);
                if converged || run + 1 == 3 + self.settings.refinements {
                    return Ok((reference, record));
                }
            }
            (last, difference) = (Some(record), now);
        }
        let step = crate::sweep::level::seconds(self.plan.frames.frame_s / f64::from(steps));
        let line = format!(
            "even Runge-Kutta at a step of {step} does not reach the end three times; give a shorter --frame or more \
             --halvings"
        );
        Err(StudyError::new("reference", line))
    }

    fn row(&mut self, level: &Level, place: Place, reference_steps: u32, record: &Record) -> Result<Row> {
        let key = self.key(&[reference_steps.into()], Some(level));
        let answer = match self.store.get("level", key) {
            Some(kept) => kept,
            None => {
                self.tell(level, "errors of")?;
                let answer = self.answer(level, record)?;
                self.store.put("level", key, &answer)?;
                answer
            }
        };
        let name = level.name(self.plan.frames.frame_s);
        Ok(Row { level: level.clone(), name, place, answer, times: None, on_front: false })
    }

    fn answer(&mut self, level: &Level, reference: &Record) -> Result<Answer> {
        Ok(match self.subject.record(level, &self.plan.frames)? {
            Ended::Diverged(time_s) => Answer::Diverged { time_s },
            Ended::Whole(record) => Answer::Reached {
                errors: errors(&record, reference, &self.radii),
                hash: record.hash(),
                incomplete: record.incomplete,
            },
        })
    }

    fn around(
        &mut self,
        anchor: usize,
        rows: &mut Vec<Row>,
        reference_steps: u32,
        record: &Record,
    ) -> Result<()> {
        let (level, alternatives) = (rows[anchor].level.clone(), self.subject.alternatives());
        for (lever, level) in self.plan.around(&level, &alternatives, &self.settings.plan) {
            rows.push(self.row(&level, Place::Around { anchor, lever }, reference_steps, record)?);
        }
        Ok(())
    }

    /// Times every level that reached the end, round after round, so that disturbances affect all alike.
    fn time(&mut self, rows: &mut [Row]) -> Result<()> {
        for round in 1..=self.settings.rounds {
            for row in rows.iter_mut().filter(|row| row.answer.errors().is_some()) {
                let key = self.key(&[], Some(&row.level));
                let mut times: Times = self.store.get("times", key).unwrap_or_default();
                if times.medians_ns.len() < round as usize {
                    self.tell(&row.level, &format!("time, round {round}, of"))?;
                    times.add(self.subject.time(&row.level, &self.plan.frames)?);
                    self.store.put("times", key, &times)?;
                }
                row.times = Some(times);
            }
        }
        Ok(())
    }
}
