//! A study: the reference, every level once to be compared, then all of them in turn to be timed.

use crate::choice::{self, Point, percentile};
use crate::error::TradeError;
use crate::errors::{Errors, Quantity, errors};
use crate::hash::Fnv;
use crate::level::{Level, Lever};
use crate::plan::{Plan, PlanSettings};
use crate::record::Record;
use crate::reference::Reference;
use crate::run::{self, Ended};
use crate::store::Store;
use pong_executive::Simulation;
use pong_executive::scene::Scene;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::path::Path;

/// How a study is made.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Which levels.
    pub plan: PlanSettings,
    /// The relative error that a level may have.
    pub within: f64,
    /// The quantities that count.
    pub of: Vec<Quantity>,
    /// How often every level is timed.
    pub rounds: u32,
    /// How often the reference's step may be halved again to make it converge.
    pub refinements: u32,
    /// Nothing that was kept earlier is used.
    pub fresh: bool,
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
        }
    }
}

/// How far a study is.
#[derive(Clone, Debug)]
pub struct Progress<'a> {
    /// Done, in calls of the engine.
    pub done: u64,
    /// All of it, about.
    pub of: u64,
    /// What is run now.
    pub doing: &'a str,
}

/// Called before every run; a study that is told to break stops there and can go on later.
type Watch<'a> = &'a mut dyn FnMut(&Progress<'_>) -> ControlFlow<()>;

/// What a level answers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// It reached the end.
    Reached {
        /// Its errors.
        errors: Errors,
        /// Hash of every bit of its record.
        hash: u64,
        /// Steps in which the engine left something out.
        incomplete: u64,
    },
    /// A state left the range of numbers.
    Diverged {
        /// When that was noticed, s.
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

    /// The frame than which half are shorter, ns.
    pub fn median_ns(&self) -> u64 {
        percentile(&self.frames_ns, 0.5)
    }

    /// The frame than which 99 of 100 are shorter, ns.
    pub fn tail_ns(&self) -> u64 {
        percentile(&self.frames_ns, 0.99)
    }

    /// By how much the median of a round may differ from that of another: largest over smallest, less one.
    pub fn spread(&self) -> f64 {
        let least = self.medians_ns.iter().min().copied().unwrap_or(0).max(1);
        self.medians_ns.iter().max().copied().unwrap_or(0) as f64 / least as f64 - 1.0
    }
}

/// Why a level is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A step and an integrator.
    Grid,
    /// One lever pulled at a level of the grid.
    Around {
        /// The row of that level.
        anchor: usize,
        /// The lever.
        lever: Lever,
    },
}

/// A level and what came of it.
#[derive(Clone, Debug)]
pub struct Row {
    /// The level.
    pub level: Level,
    /// Its name.
    pub name: String,
    /// Why it is there.
    pub place: Place,
    /// What it answered.
    pub answer: Answer,
    /// What it took; `None` if it did not reach the end.
    pub times: Option<Times>,
    /// Whether it is on the Pareto front of median frame time and worst error.
    pub on_front: bool,
}

/// All that a study found.
#[derive(Clone, Debug)]
pub struct Study {
    /// Name of the scene.
    pub scene: String,
    /// The plan.
    pub plan: Plan,
    /// What the levels were compared with.
    pub reference: Reference,
    /// The levels: the grid, then those around the base, then those around the level chosen by its errors alone.
    pub rows: Vec<Row>,
    /// The row of the level with fewest calls of the engine within the tolerance, around which levers were pulled again.
    pub second: Option<usize>,
    /// The row of least median time within the tolerance; `None` if there is none or the reference has not converged.
    pub cheapest: Option<usize>,
    /// Whether the reference is good enough to judge by.
    pub converged: bool,
    /// The tolerance.
    pub within: f64,
    /// The quantities that count.
    pub of: Vec<Quantity>,
}

impl Study {
    /// The worst relative error of a row in the quantities that count.
    pub fn error(&self, row: &Row) -> Option<f64> {
        row.answer.errors().map(|errors| errors.worst(&self.of))
    }

    /// Whether a row of a lever that changes no answer has the same bits as its anchor; `None` for all others.
    pub fn same_bits(&self, row: &Row) -> Option<bool> {
        let Place::Around { anchor, lever } = row.place else { return None };
        let hash = |answer: &Answer| match answer {
            Answer::Reached { hash, .. } => Some(*hash),
            Answer::Diverged { .. } => None,
        };
        (!lever.changes_answers()).then(|| hash(&row.answer) == hash(&self.rows[anchor].answer))
    }
}

/// Studies a scene file and keeps what is finished in a folder, so that a study that was stopped goes on where it was.
pub fn study(
    scene: &Path,
    output: &Path,
    settings: &Settings,
    watch: Watch<'_>,
) -> Result<Study, TradeError> {
    let text = std::fs::read_to_string(scene).unwrap_or_default();
    let scene = Scene::load(scene).map_err(|errors| TradeError(errors.to_string()))?;
    let built = scene.build().map_err(|errors| TradeError(errors.to_string()))?;
    let plan = Plan::new(&scene, built.simulation.bodies().len(), &settings.plan)?;
    let mut job = Job {
        inputs: inputs(&scene, &text, &plan)?,
        radii: radii(&built.simulation),
        store: Store::open(output, settings.fresh)?,
        done: 0,
        all: calls_in_all(&scene, &plan, settings),
        scene: &scene,
        settings,
        plan: &plan,
        watch,
    };
    let (reference, record) = job.reference()?;
    let mut rows = Vec::new();
    for level in &plan.grid {
        rows.push(job.row(level, Place::Grid, &reference, &record)?);
    }
    job.around(plan.base, &mut rows, &reference, &record)?;
    let converged = reference.has_converged(&settings.of, settings.within);
    let tolerance = settings.within - reference.uncertainty(&settings.of);
    let second = fewest_calls(&rows[..plan.grid.len()], &settings.of, tolerance);
    if let Some(second) = second.filter(|second| *second != plan.base) {
        job.around(second, &mut rows, &reference, &record)?;
    }
    job.time(&mut rows)?;
    let name = scene.name().to_owned();
    let (within, of) = (settings.within, settings.of.clone());
    let study = Study { scene: name, plan, reference, rows, second, cheapest: None, converged, within, of };
    Ok(judge(study))
}

/// An answer as far off as none at all is on no front, however fast it is.
const USELESS: f64 = 1.0;

/// Marks the front and names the cheapest.
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
    let tolerance = study.within - study.reference.uncertainty(&study.of);
    let cheapest = choice::cheapest(&points, tolerance).filter(|_| study.converged);
    study.cheapest = cheapest.map(|place| timed[place].0);
    study
}

/// The level that asks the engine least often: known without a clock, so that the same levels are run every time.
fn fewest_calls(rows: &[Row], of: &[Quantity], tolerance: f64) -> Option<usize> {
    let error = |row: &Row| row.answer.errors().map_or(f64::INFINITY, |errors| errors.worst(of));
    let good = (0..rows.len()).filter(|index| error(&rows[*index]) <= tolerance);
    good.min_by(|a, b| {
        let (a, b) = (&rows[*a], &rows[*b]);
        let calls = a.level.calls_per_frame().cmp(&b.level.calls_per_frame());
        calls.then(error(a).total_cmp(&error(b)))
    })
}

/// A hash of everything that decides the answers.
fn inputs(scene: &Scene, text: &str, plan: &Plan) -> Result<u64, TradeError> {
    let mut hash = Fnv::default();
    hash.text(env!("CARGO_PKG_VERSION"));
    hash.text(text);
    for file in scene.model_files() {
        let unreadable = |reason| TradeError::new(&file.display().to_string(), &format!("{reason}"));
        hash.text(&std::fs::read_to_string(&file).map_err(unreadable)?);
        // Meshes lie in files of their own; what is wrong with a model is told when it is run.
        let model = pong_model::load(&file, &pong_geometry::extension::Extensions::new());
        hash.word(model.map_or(0, |model| model.hash));
    }
    hash.word(plan.frames.frame_s.to_bits());
    hash.word(plan.frames.count);
    hash.word(plan.frames.instants.into());
    Ok(hash.value())
}

/// Radii of gyration of the free bodies, m: √(largest moment of inertia / mass).
fn radii(simulation: &Simulation) -> Vec<f64> {
    let radius = |mass: &pong_executive::MassProperties| {
        (mass.inertia.diagonal().iter().copied().fold(0.0, f64::max) / mass.mass).sqrt()
    };
    simulation.bodies().map(|(_, body)| body.mass().map_or(0.0, radius)).collect()
}

/// Calls of the engine that a study will make, about.
fn calls_in_all(scene: &Scene, plan: &Plan, settings: &Settings) -> u64 {
    let runs = 1 + u64::from(settings.rounds);
    let grid: u64 = plan.grid.iter().map(Level::calls_per_frame).sum();
    let base = &plan.grid[plan.base];
    let around = plan.around(base, scene, &settings.plan).len() as u64 * base.calls_per_frame();
    let reference = 4 * (2 + 4 + 8) * u64::from(plan.finest);
    plan.frames.count * (runs * (grid + around) + reference)
}

/// A study at work.
struct Job<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    plan: &'a Plan,
    inputs: u64,
    radii: Vec<f64>,
    store: Store,
    done: u64,
    all: u64,
    watch: Watch<'a>,
}

impl Job<'_> {
    /// Tells what is run next; an error if it is to stop.
    fn tell(&mut self, level: &Level, doing: &str) -> Result<(), TradeError> {
        let doing = format!("{doing} {}", level.name(self.plan.frames.frame_s));
        let progress = Progress { done: self.done, of: self.all.max(self.done), doing: &doing };
        let flow = (self.watch)(&progress);
        self.done += self.plan.frames.count * level.calls_per_frame();
        match flow {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(TradeError::new("study", "stopped; run it again to go on")),
        }
    }

    fn key(&self, parts: &[u64], level: Option<&Level>) -> u64 {
        let mut hash = Fnv::default();
        hash.word(self.inputs);
        parts.iter().for_each(|part| hash.word(*part));
        hash.text(&level.map(|level| format!("{level:?}")).unwrap_or_default());
        hash.value()
    }

    /// The reference and its record, kept or run.
    fn reference(&mut self) -> Result<(Reference, Record), TradeError> {
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

    /// Halves the step until three runs in a row agree well enough, or no more halvings are left.
    fn refine(&mut self) -> Result<(Reference, Record), TradeError> {
        let mut steps = self.plan.finest;
        let (mut last, mut difference): (Option<Record>, Option<Errors>) = (None, None);
        for run in 0..3 + self.settings.refinements {
            steps *= 2;
            let level = Level::plain(pong_executive::Integrator::RungeKutta4, steps);
            self.tell(&level, "reference")?;
            let Ended::Whole(record) = run::record(self.scene, &level, &self.plan.frames)? else { continue };
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
        let step = crate::level::seconds(self.plan.frames.frame_s / f64::from(steps));
        let line = format!(
            "even Runge-Kutta at a step of {step} does not reach the end three times; give a shorter --frame or more \
             --halvings"
        );
        Err(TradeError::new("reference", &line))
    }

    fn row(
        &mut self,
        level: &Level,
        place: Place,
        reference: &Reference,
        record: &Record,
    ) -> Result<Row, TradeError> {
        let key = self.key(&[reference.steps_per_frame.into()], Some(level));
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

    fn answer(&self, level: &Level, reference: &Record) -> Result<Answer, TradeError> {
        Ok(match run::record(self.scene, level, &self.plan.frames)? {
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
        reference: &Reference,
        record: &Record,
    ) -> Result<(), TradeError> {
        let level = rows[anchor].level.clone();
        for (lever, level) in self.plan.around(&level, self.scene, &self.settings.plan) {
            rows.push(self.row(&level, Place::Around { anchor, lever }, reference, record)?);
        }
        Ok(())
    }

    /// Times every level that reached the end, round after round, so that what disturbs hits all alike.
    fn time(&mut self, rows: &mut [Row]) -> Result<(), TradeError> {
        for round in 1..=self.settings.rounds {
            for row in rows.iter_mut().filter(|row| row.answer.errors().is_some()) {
                let key = self.key(&[], Some(&row.level));
                let mut times: Times = self.store.get("times", key).unwrap_or_default();
                if times.medians_ns.len() < round as usize {
                    self.tell(&row.level, &format!("time, round {round}, of"))?;
                    times.add(run::time(self.scene, &row.level, &self.plan.frames)?);
                    self.store.put("times", key, &times)?;
                }
                row.times = Some(times);
            }
        }
        Ok(())
    }
}
