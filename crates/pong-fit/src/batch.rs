//! Many short runs of one scene in one call, on all cores: each with its own initial states and parameters,
//! without reading a file again.
//!
//! A run depends on its case alone: results have the same bits for any number of threads.

use crate::error::{FitError, Result};
use crate::parameter::{Original, Parameter};
use pong_executive::scene::{BuiltScene, Scene};
use pong_executive::{BodyId, ExecutiveError, Pose, Quat, Simulation, Twist, Vec3, Wrench};
use pong_geometry::pose::rotation_vector;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Largest number of steps in a run; more are a typing error of a time.
const STEPS_MAX: f64 = 1e8;

/// Distance of a time from a step below which both are one instant, in steps.
const SAME_INSTANT: f64 = 1e-6;

/// One run of a batch.
#[derive(Clone, Debug, Default)]
pub struct Case {
    /// Value of each parameter of the batch, in the parameter's unit.
    pub values: Vec<f64>,
    /// Pose and twist of each body at the first time, in the order of [`Batch::bodies`]; `None`, or no entry,
    /// for that of the scene. Bodies on prescribed paths stay on them.
    pub starts: Vec<Option<(Pose, Twist)>>,
    /// Times of the samples, s, increasing; the run begins at the first.
    pub times: Vec<f64>,
}

/// State of a body and the contact wrench on it at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Pose of the group frame in the common frame.
    pub pose: Pose,
    /// Velocity of its origin and angular velocity, along the common axes.
    pub twist: Twist,
    /// Contact wrench about its origin, along the common axes.
    pub wrench: Wrench,
}

/// Result of a run of a batch.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Sample of each body at each time: those of the first time, then of the second, and so on.
    pub samples: Vec<Sample>,
    /// Largest contact force on each body over all steps, N.
    pub peak_force: Vec<f64>,
}

/// A scene, built once for each thread.
pub struct Batch {
    benches: Vec<Bench>,
    bodies: Vec<String>,
}

impl Batch {
    /// Builds the scene for a number of threads, with these parameters (docs/campaigns.md) free.
    ///
    /// # Errors
    /// A scene that cannot be built; names that lead nowhere or occur twice: all of them at once.
    pub fn new(scene: &Scene, parameters: &[String], threads: usize) -> Result<Self> {
        let first = Bench::new(scene, parameters)?;
        let bodies = first.simulation.bodies().map(|(_, body)| body.name.clone()).collect();
        let mut benches = vec![first];
        for _ in 1..threads {
            benches.push(Bench::new(scene, parameters)?);
        }
        Ok(Self { benches, bodies })
    }

    /// Number of threads for this machine.
    pub fn threads_of_this_machine() -> usize {
        std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
    }

    /// Names of the bodies.
    pub fn bodies(&self) -> &[String] {
        &self.bodies
    }

    /// The parameters.
    pub fn parameters(&self) -> &[Parameter] {
        &self.benches[0].parameters
    }

    /// Runs all cases; the results are in the same order.
    ///
    /// # Errors
    /// In place of a run: a case that does not fit the batch, a value that the engine refuses, or a run that
    /// diverges.
    pub fn run(&mut self, cases: &[Case]) -> Vec<Result<Outcome>> {
        self.map(cases, |bench, case| {
            let bodies = bench.ids.len();
            let mut samples = vec![None; case.times.len() * bodies];
            let peak_force = bench.play(case, &mut |time, body, sample| {
                samples[time * bodies + body] = Some(sample);
            })?;
            Ok(Outcome { samples: samples.into_iter().flatten().collect(), peak_force })
        })
    }

    /// Does some work for each job, each thread with its own copy of the scene; the results are in the order
    /// of the jobs.
    pub(crate) fn map<J: Sync, R: Send>(
        &mut self,
        jobs: &[J],
        work: impl Fn(&mut Bench, &J) -> R + Sync,
    ) -> Vec<R> {
        let next = AtomicUsize::new(0);
        let threads = self.benches.len().min(jobs.len());
        let done = |bench: &mut Bench| {
            let mut results = Vec::new();
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                let Some(job) = jobs.get(index) else { break results };
                results.push((index, work(bench, job)));
            }
        };
        let mut results = if threads <= 1 {
            done(&mut self.benches[0])
        } else {
            std::thread::scope(|scope| {
                let done = &done;
                let all: Vec<_> = self.benches[..threads]
                    .iter_mut()
                    .map(|bench| scope.spawn(move || done(bench)))
                    .collect();
                all.into_iter().flat_map(|thread| thread.join().expect("no work panics")).collect()
            })
        };
        results.sort_by_key(|(index, _)| *index);
        results.into_iter().map(|(_, result)| result).collect()
    }

    /// The copy of the scene of the first thread.
    pub(crate) fn first(&mut self) -> &mut Bench {
        &mut self.benches[0]
    }
}

/// The scene of one thread.
pub(crate) struct Bench {
    simulation: Simulation,
    scene_preload: Vec<(pong_engine::PairId, pong_engine::FrictionPreload)>,
    ids: Vec<BodyId>,
    parameters: Vec<Parameter>,
    original: Original,
}

impl Bench {
    fn new(scene: &Scene, names: &[String]) -> Result<Self> {
        let built = scene.build()?;
        let parameters = find_all(&built, names)?;
        let original = Original::of(&built)?;
        let ids = built.simulation.bodies().map(|(id, _)| id).collect();
        Ok(Self { simulation: built.simulation, scene_preload: built.preload, ids, parameters, original })
    }

    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Sets parameters and starts, and drops everything that an earlier run has left.
    pub fn prepare(&mut self, case: &Case) -> Result<()> {
        let (values, parameters) = (case.values.len(), self.parameters.len());
        if values != parameters {
            let cause = format!("it has {values} values for {parameters} parameters");
            return Err(FitError::new("case", cause, "give one for each"));
        }
        if case.starts.len() > self.ids.len() {
            let cause = format!("it has {} starts for {} bodies", case.starts.len(), self.ids.len());
            return Err(FitError::new("case", cause, "give at most one for each body"));
        }
        let Some(first) = case.times.first() else {
            return Err(FitError::new("case", "it has no times", "give at least the time of its start"));
        };
        let ordered = case.times.windows(2).all(|pair| pair[0] < pair[1]);
        let last = case.times.last().unwrap_or(first);
        if !ordered || !first.is_finite() || (last - first) / self.simulation.step_length() > STEPS_MAX {
            let cause = format!("its times from {first} s to {last} s are not in order, or far too long");
            return Err(FitError::new("case", cause, "give finite times that increase, in s"));
        }
        self.simulation.set_time(*first)?;
        self.original.set(&mut self.simulation, &self.parameters, &case.values, &case.starts)?;
        self.simulation.clear_contact_history()?;
        for (pair, preload) in &self.scene_preload {
            self.simulation.preload_friction(*pair, preload)?;
        }
        self.simulation.commit_initial_states()?;
        Ok(())
    }

    /// Runs a case; `see` gets the number of the time, the number of the body and the sample. Returns the
    /// largest contact force on each body, N.
    pub fn play(&mut self, case: &Case, see: &mut dyn FnMut(usize, usize, Sample)) -> Result<Vec<f64>> {
        self.prepare(case)?;
        let mut peaks = vec![0.0; self.ids.len()];
        let mut now = self.samples(&mut peaks);
        now.iter().enumerate().for_each(|(body, sample)| see(0, body, *sample));
        let (start, h) = (case.times[0], self.simulation.step_length());
        let mut step = 0_u64;
        let mut before = Vec::new();
        for (place, time) in case.times.iter().enumerate().skip(1) {
            let wanted = (time - start) / h;
            while (step as f64) < wanted - SAME_INSTANT {
                std::mem::swap(&mut before, &mut now);
                self.step()?;
                step += 1;
                now = self.samples(&mut peaks);
            }
            let share = wanted - (step as f64 - 1.0);
            for (body, sample) in now.iter().enumerate() {
                let within = (share - 1.0).abs() > SAME_INSTANT && !before.is_empty();
                see(place, body, if within { between(&before[body], sample, share, h) } else { *sample });
            }
        }
        Ok(peaks)
    }

    fn step(&mut self) -> Result<(), ExecutiveError> {
        self.simulation.step()
    }

    fn samples(&self, peaks: &mut [f64]) -> Vec<Sample> {
        let of_body = |(id, peak): (&BodyId, &mut f64)| {
            let wrench = self.simulation.contact_wrench(*id);
            *peak = peak.max(wrench.force.norm());
            Sample { pose: self.simulation.pose(*id), twist: self.simulation.twist(*id), wrench }
        };
        self.ids.iter().zip(peaks).map(of_body).collect()
    }
}

fn find_all(scene: &BuiltScene, names: &[String]) -> Result<Vec<Parameter>> {
    let (mut found, mut faults) = (Vec::new(), Vec::new());
    for (place, name) in names.iter().enumerate() {
        if names[..place].contains(name) {
            faults.push(format!("parameter `{name}`: it is given twice; keep one of them"));
            continue;
        }
        match Parameter::find(name, scene) {
            Ok(parameter) => found.push(parameter),
            Err(error) => faults.push(error.0),
        }
    }
    if faults.is_empty() { Ok(found) } else { Err(FitError(faults.join("\n"))) }
}

/// Sample between two steps, a share of the step `h` (s) after the first: cubic in position, along the arc in
/// orientation, linear in velocities and wrench.
fn between(a: &Sample, b: &Sample, share: f64, h: f64) -> Sample {
    let s = share;
    let (s2, s3) = (s * s, s * s * s);
    let position = a.pose.position * (2.0 * s3 - 3.0 * s2 + 1.0)
        + b.pose.position * (3.0 * s2 - 2.0 * s3)
        + a.twist.linear * ((s3 - 2.0 * s2 + s) * h)
        + b.twist.linear * ((s3 - s2) * h);
    let turn = rotation_vector(&(b.pose.orientation * a.pose.orientation.inverse()));
    let orientation = Quat::from_scaled_axis(turn * s) * a.pose.orientation;
    let mix = |x: &Vec3, y: &Vec3| x + (y - x) * s;
    Sample {
        pose: Pose { position, orientation },
        twist: Twist {
            linear: mix(&a.twist.linear, &b.twist.linear),
            angular: mix(&a.twist.angular, &b.twist.angular),
        },
        wrench: Wrench {
            force: mix(&a.wrench.force, &b.wrench.force),
            moment: mix(&a.wrench.moment, &b.wrench.moment),
        },
    }
}
