//! The whole procedure: data checked and split, search from several points, intervals, errors on the test part.

use crate::batch::Batch;
use crate::data::{Data, Quantity, Record, check, load, parse};
use crate::error::{FitError, Result};
use crate::intervals::{self, Around, Profile};
use crate::random::Random;
use crate::settings::{Scale, Settings, Starts};
use crate::solve::{Point, Problem, Solution, evaluate, solve};
use crate::trials::{START_STEP, Trial, Trials};
use crate::watch::{Watch, tell};
use pong_executive::scene::Scene;
use std::path::Path;

/// Number of records of which each try is judged.
const RECORDS_OF_A_TRY: usize = 24;

/// Number of tries that are followed to their optimum.
const FOLLOWED: usize = 3;

/// Least number of records that are split; fewer are split in time.
const SPLIT: usize = 4;

/// Weighted error above which the data and the scene cannot be meant for each other.
const FAR_OFF: f64 = 30.0;

/// Correlation from which on two parameters are reported as moving together.
pub(crate) const TOGETHER: f64 = 0.9;

/// A free parameter, identified.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Name.
    pub name: String,
    /// Unit of all values; empty for a pure number.
    pub unit: &'static str,
    /// Value in the scene, in the unit.
    pub in_scene: f64,
    /// Bounds, in the unit.
    pub bounds: (f64, f64),
    /// Optimum, in the unit.
    pub value: f64,
    /// Interval from the curvature at the optimum, in the unit; infinite if the data do not move it.
    pub linear: (f64, f64),
    /// Interval from the bootstrap over records, in the unit; `None` with less than five records.
    pub bootstrap: Option<(f64, f64)>,
    /// Interval from the profile of the sum of squares, in the unit; `None` without profiles.
    pub profile: Option<(f64, f64)>,
    /// Values within one standard error of the mean sum of squares of the records, in the unit.
    pub one_error: Option<(f64, f64)>,
    /// Median over the records of the largest contact force at both ends of that range, N.
    pub peak_force: Option<(f64, f64)>,
    /// Ends of the profile interval that are bounds: the data allow more than the bounds do.
    pub open: (bool, bool),
    /// False if the data do not move the parameter.
    pub moved: bool,
}

/// Root mean squares of the differences of a set of records.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Errors {
    /// Number of records.
    pub records: usize,
    /// Root mean square of all residuals, in standard deviations of the sensors (a ratio).
    pub weighted: f64,
    /// Root mean square of the magnitude of each quantity's difference, in the quantity's unit.
    pub of: Vec<(Quantity, f64)>,
}

/// A point from which the search began, and where it came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Try {
    /// Values at the beginning, in the units of the parameters.
    pub from: Vec<f64>,
    /// Values at the end; empty for tries that were not followed.
    pub to: Vec<f64>,
    /// Root mean square of the residuals there, in standard deviations of the sensors (a ratio).
    pub weighted: f64,
}

/// Result of an identification.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Name of the scene.
    pub scene: String,
    /// The parameters, in the order of the settings.
    pub parameters: Vec<Estimate>,
    /// Correlation of each two parameters at the optimum (coefficients).
    pub correlations: Vec<Vec<f64>>,
    /// Errors of the records of the fit, with the scene's values and with those found.
    pub train: [Errors; 2],
    /// Errors of the records that took no part, likewise.
    pub test: [Errors; 2],
    /// True if the test part is the later share of the time of each record.
    pub split_in_time: bool,
    /// Median over the records of the largest contact force at the optimum, N.
    pub peak_force: f64,
    /// The points from which the search began.
    pub tries: Vec<Try>,
    /// True if the search came to its end.
    pub converged: bool,
    /// Number of residuals, and of unknowns with those of the starts.
    pub counts: (usize, usize),
    /// Confidence of the intervals, a fraction.
    pub confidence: f64,
    /// Profiles, one for each parameter; empty without profiles.
    pub profiles: Vec<Profile>,
    /// Surfaces and mass properties to paste into a model or the scene.
    pub to_paste: Vec<String>,
    /// Notes and warnings, each with thing, cause and cure.
    pub notes: Vec<String>,
    /// Number of runs that were computed.
    pub runs: u64,
}

/// Identifies parameters of a scene from measured data.
///
/// # Errors
/// Settings, names, data and records that cannot be used; a scene that cannot be run with its own values;
/// an end by the caller.
pub fn fit(scene: &Scene, data: &Data, settings: &Settings, watch: Watch<'_>) -> Result<Fit> {
    settings.check()?;
    let names: Vec<String> = settings.free.iter().map(|free| free.name.clone()).collect();
    let batch = Batch::new(scene, &names, settings.threads)?;
    let checked = check(data, scene)?;
    if !checked.faults.is_empty() {
        return Err(FitError(checked.faults.join("\n")));
    }
    let mut notes = checked.notes;
    let scales =
        settings.free.iter().zip(batch.parameters()).map(|(free, parameter)| Scale::of(free, parameter));
    let scales = scales.collect::<Result<Vec<Scale>>>()?;
    let noise = noise(data, settings)?;
    let split = split(data, settings, &mut notes)?;
    let mut trials = Vec::new();
    for (record, counts_from) in split.records {
        trials.push(Trial::new(record, &batch, settings.starts, counts_from)?);
    }
    let trials = Trials { batch, trials, scales, noise, runs: 0 };
    let study =
        Study { settings, trials, train: split.train, test: split.test, in_time: split.in_time, notes };
    study.run(scene.name(), watch)
}

/// Reads data and identifies parameters: [`load`], then [`fit`].
///
/// # Errors
/// As [`fit`]; a file that cannot be read.
pub fn fit_file(scene: &Scene, data: &Path, settings: &Settings, watch: Watch<'_>) -> Result<Fit> {
    fit(scene, &load(data, &free_bodies(scene)?)?, settings, watch)
}

/// Reads data from the text of a CSV file, which errors call `file`, and identifies parameters.
///
/// # Errors
/// As [`fit`]; every fault of the text.
pub fn fit_text(scene: &Scene, text: &str, file: &str, settings: &Settings, watch: Watch<'_>) -> Result<Fit> {
    fit(scene, &parse(text, file, &free_bodies(scene)?)?, settings, watch)
}

/// Names of the bodies that data may be of.
///
/// # Errors
/// A scene that cannot be built.
pub fn free_bodies(scene: &Scene) -> Result<Vec<String>> {
    let built = scene.build()?;
    let free = built.simulation.bodies().filter(|(_, body)| body.mass().is_some());
    Ok(free.map(|(_, body)| body.name.clone()).collect())
}

/// Noise of each quantity that counts.
fn noise(data: &Data, settings: &Settings) -> Result<[Option<f64>; 6]> {
    let mut noise = [None; 6];
    let mut faults = Vec::new();
    for quantity in Quantity::ALL {
        let place = quantity as usize;
        let measured = data.records.iter().flat_map(|record| &record.rows).any(|row| row.has(quantity));
        let wanted = settings.of.is_empty() || settings.of.contains(&quantity);
        if settings.of.contains(&quantity) && !measured {
            faults.push(format!(
                "{}: it counts, but no row has it; measure it, or leave it out",
                quantity.name()
            ));
        }
        if measured && wanted {
            noise[place] =
                settings.noise[place].or(data.noise[place]).filter(|noise| *noise > 0.0 && noise.is_finite());
            if noise[place].is_none() {
                faults.push(format!(
                    "{name}: the noise of its sensor is not known, so that it cannot be weighed against the others; write \
                     `# noise.{name} = …` ({unit}, standard deviation of one axis) into the data, or give it as a setting, or let \
                     other quantities count alone",
                    name = quantity.name(),
                    unit = quantity.unit(),
                ));
            }
        }
    }
    if faults.is_empty() && noise.iter().all(Option::is_none) {
        faults.push(
            "data: nothing was measured; give columns of positions, orientations, velocities or wrenches"
                .to_owned(),
        );
    }
    if faults.is_empty() { Ok(noise) } else { Err(FitError(faults.join("\n"))) }
}

/// Records of the fit and of the test.
struct Split {
    /// Records with the first time that counts.
    records: Vec<(Record, usize)>,
    train: Vec<usize>,
    test: Vec<usize>,
    in_time: bool,
}

fn split(data: &Data, settings: &Settings, notes: &mut Vec<String>) -> Result<Split> {
    let mut cut: Vec<Record> = Vec::new();
    let mut short = Vec::new();
    for record in &data.records {
        match record.window(settings.from, settings.horizon) {
            Some(record) => cut.push(record),
            None => short.push(record.name.as_str()),
        }
    }
    if !short.is_empty() {
        notes.push(format!(
            "data: {} records have less than two times that count and are left out: {}",
            short.len(),
            short.join(", ")
        ));
    }
    if cut.is_empty() {
        let cure = "give longer records, a later end (`horizon`) or an earlier begin (`from`)";
        return Err(FitError::new("data", "no record has two times that count", cure));
    }
    // A start that is taken as measured has no residual.
    let first = usize::from(settings.starts == Starts::Measured);
    let count = cut.len();
    if count >= SPLIT {
        let of_test = libm::round(settings.test * count as f64) as usize;
        let order = Random::new(settings.seed, 1).order(count);
        let (mut test, mut train) = (order[..of_test].to_vec(), order[of_test..].to_vec());
        test.sort_unstable();
        train.sort_unstable();
        let records = cut.into_iter().map(|record| (record, first)).collect();
        return Ok(Split { records, train, test, in_time: false });
    }
    let mut records = Vec::new();
    let mut ends = Vec::new();
    for record in &cut {
        let end = record.times.len() - (settings.test * record.times.len() as f64) as usize;
        let begin = record.times[0];
        let last = record.times[end.max(2).min(record.times.len()) - 1];
        let early = record.window(0.0, Some(last - begin)).unwrap_or_else(|| record.clone());
        ends.push(early.times.len());
        records.push((early, first));
    }
    records.extend(cut.into_iter().zip(ends));
    let has_test = records[count..].iter().any(|(record, end)| *end < record.times.len());
    let test = if has_test { (count..2 * count).collect() } else { Vec::new() };
    Ok(Split { records, train: (0..count).collect(), test, in_time: true })
}

/// An identification at work.
struct Study<'a> {
    settings: &'a Settings,
    trials: Trials,
    train: Vec<usize>,
    test: Vec<usize>,
    in_time: bool,
    notes: Vec<String>,
}

impl Study<'_> {
    fn run(mut self, scene: &str, watch: Watch<'_>) -> Result<Fit> {
        let scene_values: Vec<f64> = self.trials.batch.parameters().iter().map(|p| p.in_scene).collect();
        let scene_z: Vec<f64> =
            self.trials.scales.iter().zip(&scene_values).map(|(scale, x)| scale.to_search(*x)).collect();
        let (tries, begin) = self.search(&scene_z, watch)?;
        tell(watch, "optimum of all records")?;
        let problem = self.problem(self.train.clone(), None);
        let mut best = self.solve(&problem, &begin).ok_or_else(|| self.fails(&begin))?;
        let mut around = Around::new(&problem, &mut self.trials, &best, self.settings.confidence);
        let mut profiles = Vec::new();
        if self.settings.profiles {
            // A profile may come upon a better optimum; then all begins anew from there.
            for _ in 0..3 {
                match intervals::profiles(&problem, &mut self.trials, &best, &around, watch)? {
                    Ok(found) => {
                        profiles = found;
                        break;
                    }
                    Err(better) => {
                        best = solve(&problem, &mut self.trials, &better.z, &better.starts).unwrap_or(better);
                        around = Around::new(&problem, &mut self.trials, &best, self.settings.confidence);
                    }
                }
            }
        }
        tell(watch, "errors of the test part")?;
        let train_of_scene = self.errors(&self.train.clone(), &scene_z, &[])?;
        let train = self.errors(&self.train.clone(), &best.z, &best.starts)?;
        let starts = if self.in_time { best.starts.clone() } else { Vec::new() };
        let test = [
            self.errors(&self.test.clone(), &scene_z, &[]).unwrap_or_default(),
            self.errors(&self.test.clone(), &best.z, &starts)?,
        ];
        let peak_force = self.peak_force(&best);
        let parameters = self.estimates(&best, &around, &profiles, peak_force);
        let correlations = around.correlations();
        self.tell_shortfalls(&best, &parameters, &correlations, &tries);
        if train.weighted > FAR_OFF {
            self.notes.push(format!(
                "data: at the optimum the runs still miss the measurements by {:.0} standard deviations of the sensors, more than \
                 a law of contact is wrong by; look at the units, the axes, the places of the scene's bodies and the noise given",
                train.weighted
            ));
        }
        let to_paste = crate::paste::texts(&mut self.trials, &best.z)?;
        Ok(Fit {
            scene: scene.to_owned(),
            parameters,
            correlations,
            train: [train_of_scene, train],
            test,
            split_in_time: self.in_time,
            peak_force,
            tries,
            converged: best.converged,
            counts: (around.residuals, around.unknowns),
            confidence: self.settings.confidence,
            profiles,
            to_paste,
            notes: self.notes,
            runs: self.trials.runs,
        })
    }

    /// The problem of some records.
    fn problem(&self, records: Vec<usize>, fixed: Option<bool>) -> Problem {
        let scales = &self.trials.scales;
        let unknowns = records.iter().map(|record| self.trials.trials[*record].unknowns()).max().unwrap_or(0);
        Problem {
            records,
            bounds: scales.iter().map(|scale| scale.bounds()).collect(),
            steps: scales.iter().map(|scale| scale.step()).collect(),
            fixed: vec![fixed.unwrap_or(false); scales.len()],
            start_steps: vec![START_STEP; unknowns],
            iterations: self.settings.iterations,
        }
    }

    fn solve(&mut self, problem: &Problem, z: &[f64]) -> Option<Solution> {
        let starts = vec![vec![0.0; problem.start_steps.len()]; problem.records.len()];
        solve(problem, &mut self.trials, z, &starts)
    }

    /// Points from which the search begins, judged on some of the records; the best of them is followed on all.
    fn search(&mut self, scene_z: &[f64], watch: Watch<'_>) -> Result<(Vec<Try>, Vec<f64>)> {
        let mut random = Random::new(self.settings.seed, 2);
        let count = self.settings.tries;
        let orders: Vec<Vec<usize>> = scene_z.iter().map(|_| random.order(count)).collect();
        let mut points = vec![scene_z.to_vec()];
        (1..count).for_each(|number| {
            let inside = |(place, scale): (usize, &Scale)| {
                let (low, high) = scale.bounds();
                low + (high - low) * (orders[place][number] as f64 + random.unit()) / count as f64
            };
            points.push(self.trials.scales.iter().enumerate().map(inside).collect());
        });
        let records: Vec<usize> = self.train.iter().copied().take(RECORDS_OF_A_TRY).collect();
        let problem = self.problem(records, None);
        let starts = vec![vec![0.0; problem.start_steps.len()]; problem.records.len()];
        let mut judged = Vec::new();
        for (number, z) in points.iter().enumerate() {
            tell(watch, &format!("try {} of {count}", number + 1))?;
            let found = evaluate(&problem, &mut self.trials, z.clone(), starts.clone());
            judged.push((found.map_or(f64::INFINITY, |found| found.cost()), number));
        }
        judged.sort_by(|a, b| a.0.total_cmp(&b.0));
        if judged[0].0.is_infinite() {
            return Err(self.fails(scene_z));
        }
        let mut tries: Vec<Try> = Vec::new();
        let mut best: Option<Solution> = None;
        for (place, (cost, number)) in judged.iter().enumerate().filter(|(_, (cost, _))| cost.is_finite()) {
            let from = self.trials.values(&points[*number]);
            let residuals = self.residuals_of(&problem.records);
            let rms = |cost: f64| (cost / residuals.max(1) as f64).sqrt();
            if place >= FOLLOWED {
                tries.push(Try { from, to: Vec::new(), weighted: rms(*cost) });
                continue;
            }
            tell(watch, &format!("search {} of {}", place + 1, FOLLOWED.min(count)))?;
            let Some(found) = self.solve(&problem, &points[*number]) else { continue };
            tries.push(Try { from, to: self.trials.values(&found.z), weighted: rms(found.cost()) });
            if best.as_ref().is_none_or(|best| found.cost() < best.cost()) {
                best = Some(found);
            }
        }
        let best = best.ok_or_else(|| self.fails(scene_z))?;
        Ok((tries, best.z))
    }

    fn residuals_of(&self, records: &[usize]) -> usize {
        let of = |record: &usize| {
            let trial = &self.trials.trials[*record];
            let rows = trial.record.rows.iter().filter(|row| row.time >= trial.counts_from);
            rows.map(|row| {
                Quantity::ALL
                    .into_iter()
                    .filter(|q| self.trials.noise[*q as usize].is_some() && row.has(*q))
                    .count()
            })
            .sum::<usize>()
        };
        3 * records.iter().map(of).sum::<usize>()
    }

    /// Error of a point at which no run comes to its end.
    fn fails(&mut self, z: &[f64]) -> FitError {
        let unknowns = self.problem(self.train.clone(), None).start_steps.len();
        for record in self.train.clone() {
            let point = Point { record, z: z.to_vec(), start: vec![0.0; unknowns] };
            if let Some(reason) = self.trials.failure(&point) {
                let name = &self.trials.trials[record].record.name;
                return FitError(format!(
                    "record `{name}`: its run fails at the values where the search begins: {reason}"
                ));
            }
        }
        FitError::new(
            "data",
            "the differences to the measurements leave the range of numbers",
            "look at their units",
        )
    }

    /// Errors of some records with these values. Starts that are not given are fitted to the records, the
    /// values held.
    fn errors(&mut self, records: &[usize], z: &[f64], starts: &[Vec<f64>]) -> Result<Errors> {
        if records.is_empty() {
            return Ok(Errors::default());
        }
        let mut problem = self.problem(records.to_vec(), Some(true));
        problem.iterations = problem.iterations.min(8);
        let starts = if starts.is_empty() {
            self.solve(&problem, z).ok_or_else(|| self.fails(z))?.starts
        } else {
            starts.to_vec()
        };
        let points =
            records.iter().zip(starts).map(|(record, start)| Point { record: *record, z: z.to_vec(), start });
        let cases: Vec<crate::Case> = points.map(|point| self.trials.case(&point)).collect();
        let mut sums = [(0.0, 0_usize); 6];
        let (mut weighted, mut count) = (0.0, 0_usize);
        for (record, outcome) in records.iter().zip(self.trials.batch.run(&cases)) {
            for (quantity, difference) in self.trials.differences(*record, &outcome?.samples) {
                let noise = self.trials.noise[quantity as usize].unwrap_or(1.0);
                sums[quantity as usize].0 += difference.norm_squared();
                sums[quantity as usize].1 += 1;
                weighted += difference.norm_squared() / (noise * noise);
                count += 3;
            }
        }
        let root = |(sum, count): (f64, usize)| (sum / count as f64).sqrt();
        let of = Quantity::ALL.into_iter().filter(|quantity| sums[*quantity as usize].1 > 0);
        Ok(Errors {
            records: records.len(),
            weighted: (weighted / count.max(1) as f64).sqrt(),
            of: of.map(|quantity| (quantity, root(sums[quantity as usize]))).collect(),
        })
    }

    /// Median over the records of the largest contact force at a solution, N.
    fn peak_force(&mut self, at: &Solution) -> f64 {
        intervals::median_peak(&mut self.trials, &self.train, at)
    }

    fn estimates(
        &mut self,
        best: &Solution,
        around: &Around,
        profiles: &[Profile],
        peak: f64,
    ) -> Vec<Estimate> {
        let bootstrap = around.bootstrap(self.settings.seed, &best.z);
        let mut estimates = Vec::new();
        for (place, parameter) in self.trials.batch.parameters().iter().enumerate() {
            let scale = self.trials.scales[place];
            let value = |z: f64| scale.to_value(z);
            let profile = profiles.get(place);
            let moved = around.moves(place, &scale);
            let half = around.half_width(place);
            let z = best.z[place];
            let linear = if half.is_finite() && moved {
                (value(z - half), value(z + half))
            } else {
                (scale.low, scale.high)
            };
            estimates.push(Estimate {
                name: parameter.name.clone(),
                unit: parameter.unit,
                in_scene: parameter.in_scene,
                bounds: (scale.low, scale.high),
                value: value(z),
                linear,
                bootstrap: bootstrap.as_ref().map(|all| (value(all[place].0), value(all[place].1))),
                profile: profile.map(|profile| profile.interval),
                one_error: profile.map(|profile| profile.one_error),
                peak_force: profile.map(|profile| profile.peak_force.unwrap_or((peak, peak))),
                open: profile.map_or((false, false), |profile| profile.open),
                moved,
            });
        }
        estimates
    }

    fn tell_shortfalls(
        &mut self,
        best: &Solution,
        parameters: &[Estimate],
        correlations: &[Vec<f64>],
        tries: &[Try],
    ) {
        if !best.converged {
            let line = "search: it has not converged; allow more iterations, or shorten the horizon, after which motion is chaotic";
            self.notes.push(line.to_owned());
        }
        for (place, one) in parameters.iter().enumerate() {
            let (name, unit) = (&one.name, one.unit);
            if !one.moved {
                self.notes.push(format!(
                    "parameter `{name}`: the data do not move it: from bound to bound it changes the differences by less than their \
                     noise; leave it out, or measure something that depends on it"
                ));
                continue;
            }
            let bounds = self.problem(Vec::new(), None).bounds[place];
            let near = 1e-6 * (bounds.1 - bounds.0);
            for (at, end) in [(bounds.0, one.bounds.0), (bounds.1, one.bounds.1)] {
                if (best.z[place] - at).abs() <= near {
                    self.notes.push(format!(
                        "parameter `{name}`: the optimum is at its bound of {end} {unit}; widen the bounds if the value is possible, or \
                         look for what the model lacks"
                    ));
                }
            }
            for (other, correlation) in correlations[place].iter().enumerate().take(place) {
                if correlation.abs() >= TOGETHER && parameters[other].moved {
                    self.notes.push(format!(
                        "parameters `{}` and `{name}`: they move together (correlation {correlation:.3}), so that the data tell hardly \
                         more than one combination of them; fix one, or measure something that parts them",
                        parameters[other].name
                    ));
                }
            }
        }
        let followed: Vec<&Try> = tries.iter().filter(|one| !one.to.is_empty()).collect();
        if let Some(least) = followed.iter().map(|one| one.weighted).min_by(f64::total_cmp) {
            let apart = followed.iter().filter(|one| one.weighted > 1.05 * least).count();
            if apart > 0 {
                self.notes.push(format!(
                    "search: {apart} of {} tries ended at a worse local optimum; more tries make the best one surer",
                    followed.len()
                ));
            }
        }
    }
}
