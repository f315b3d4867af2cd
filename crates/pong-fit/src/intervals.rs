//! Uncertainty at an optimum: curvature, bootstrap over records, profiles.
//!
//! * *Curvature*: covariance s²·(JᵀJ)⁻¹ of the parameters with all starts eliminated; s² is the sum of squares
//!   over the degrees of freedom.
//! * *Bootstrap*: records are drawn with replacement, and the optimum of each draw is that of one Newton step
//!   from the optimum of all (one-step bootstrap). It makes no assumption about the noise within a record.
//! * *Profile*: the parameter is held at values away from the optimum and all other unknowns are fitted again,
//!   until the sum of squares has risen by s²·t², with t the quantile of Student's distribution.

use crate::error::Result;
use crate::random::Random;
use crate::settings::Scale;
use crate::solve::{Linear, Point, Problem, Solution, linearise, solve};
use crate::trials::Trials;
use crate::watch::{Watch, tell};
use nalgebra::{DMatrix, DVector};

/// Number of draws of the bootstrap.
const DRAWS: usize = 2000;

/// Least number of records that are drawn from.
const ENOUGH: usize = 5;

/// Largest number of points on each side of a profile.
const POINTS: usize = 8;

/// Iterations for the other unknowns at a point of a profile.
const ITERATIONS: usize = 6;

/// Sum of squares gained by the whole interval between the bounds, in s², below which the data do not move a
/// parameter.
const UNMOVED: f64 = 4.0;

/// Profile of the sum of squares over a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Values of the parameter in its unit, increasing, with the rise of the sum of squares above its least
    /// value, in s² (a ratio).
    pub points: Vec<(f64, f64)>,
    /// Values whose rise is below the threshold of the confidence, in the unit of the parameter.
    pub interval: (f64, f64),
    /// Values whose mean sum of squares is within one standard error, over the records, of the least, in the
    /// unit of the parameter.
    pub one_error: (f64, f64),
    /// Least and greatest median of the largest contact force over that range, N.
    pub peak_force: Option<(f64, f64)>,
    /// Ends of the interval that are bounds of the parameter.
    pub open: (bool, bool),
    /// Rise at the ends of the interval and of the range of one standard error, in s² (ratios).
    pub thresholds: (f64, f64),
}

/// Linear model around an optimum.
pub(crate) struct Around {
    /// JᵀJ and Jᵀe of each record, its start eliminated.
    records: Vec<(DMatrix<f64>, DVector<f64>)>,
    information: DMatrix<f64>,
    covariance: Option<DMatrix<f64>>,
    /// Sum of squares over the degrees of freedom.
    pub variance: f64,
    /// Quantile of Student's distribution for the confidence.
    quantile: f64,
    tail: f64,
    /// Standard error of the sum of squares over the records.
    error_of_cost: f64,
    pub residuals: usize,
    pub unknowns: usize,
}

impl Around {
    pub fn new(problem: &Problem, trials: &mut Trials, best: &Solution, confidence: f64) -> Self {
        let linear = linearise(problem, trials, best);
        let residuals: usize = linear.iter().map(|record| record.residuals.len()).sum();
        let count = best.z.len();
        let unknowns = count + problem.records.len() * problem.start_steps.len();
        let degrees = residuals.saturating_sub(unknowns).max(1) as f64;
        let records: Vec<_> = linear.iter().map(Linear::reduced).collect();
        let mut information = DMatrix::zeros(count, count);
        records.iter().for_each(|(part, _)| information += part);
        let mean = best.cost() / best.costs.len() as f64;
        let spread: f64 = best.costs.iter().map(|cost| (cost - mean) * (cost - mean)).sum();
        let others = best.costs.len().saturating_sub(1).max(1) as f64;
        let tail = 0.5 * (1.0 - confidence);
        Self {
            covariance: inverse(&information),
            records,
            information,
            variance: best.cost() / degrees,
            quantile: student(1.0 - tail, degrees),
            tail,
            error_of_cost: (spread / others * best.costs.len() as f64).sqrt(),
            residuals,
            unknowns,
        }
    }

    /// Standard error of a parameter; infinite if the data do not determine it.
    fn error(&self, place: usize) -> f64 {
        let squared = self.covariance.as_ref().map(|covariance| covariance[(place, place)] * self.variance);
        squared.filter(|squared| *squared > 0.0).map_or(f64::INFINITY, f64::sqrt)
    }

    /// Half of the interval from the curvature.
    pub fn half_width(&self, place: usize) -> f64 {
        self.quantile * self.error(place)
    }

    /// True if the data move a parameter.
    pub fn moves(&self, place: usize, scale: &Scale) -> bool {
        let (low, high) = scale.bounds();
        let gained = self.information[(place, place)] * (high - low) * (high - low);
        gained > UNMOVED * self.variance.max(f64::MIN_POSITIVE)
    }

    pub fn correlations(&self) -> Vec<Vec<f64>> {
        let count = self.information.nrows();
        let one = |i: usize, j: usize| match &self.covariance {
            _ if i == j => 1.0,
            Some(c) => (c[(i, j)] / (c[(i, i)] * c[(j, j)]).sqrt()).clamp(-1.0, 1.0),
            None => f64::NAN,
        };
        (0..count).map(|i| (0..count).map(|j| one(i, j)).collect()).collect()
    }

    /// Interval of each parameter around its optimum, on the scale of the search; `None` with too few records.
    pub fn bootstrap(&self, seed: u64, best: &[f64]) -> Option<Vec<(f64, f64)>> {
        let (count, width) = (self.records.len(), best.len());
        if count < ENOUGH {
            return None;
        }
        let mut random = Random::new(seed, 3);
        let mut drawn: Vec<Vec<f64>> = vec![Vec::with_capacity(DRAWS); width];
        for _ in 0..DRAWS {
            let (mut information, mut gradient) = (DMatrix::zeros(width, width), DVector::zeros(width));
            for _ in 0..count {
                let (part, slope) = &self.records[random.below(count)];
                information += part;
                gradient += slope;
            }
            if let Some(inverse) = inverse(&information) {
                let change = -(inverse * gradient);
                drawn.iter_mut().zip(change.iter()).for_each(|(all, change)| all.push(*change));
            }
        }
        // Draws of few records spread too little by the share that the mean of n takes from their variance.
        let correction = (count as f64 / (count as f64 - 1.0)).sqrt() * self.quantile_of_records(count);
        let interval = |all: Vec<f64>, best: f64| {
            let mut all = all;
            all.sort_by(f64::total_cmp);
            let at = |share: f64| {
                all.get((share * (all.len().max(1) - 1) as f64) as usize).copied().unwrap_or(f64::NAN)
            };
            (best + correction * at(self.tail), best + correction * at(1.0 - self.tail))
        };
        Some(drawn.into_iter().zip(best).map(|(all, best)| interval(all, *best)).collect())
    }

    /// Ratio of the quantile of Student's distribution for this number of records to the normal one.
    fn quantile_of_records(&self, count: usize) -> f64 {
        student(1.0 - self.tail, count as f64 - 1.0) / normal(1.0 - self.tail)
    }
}

/// Inverse of a symmetric positive matrix, scaled first by its diagonal; `None` if it has none.
fn inverse(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let count = matrix.nrows();
    let largest = matrix.diagonal().iter().copied().fold(0.0, f64::max);
    let scale: Vec<f64> = matrix.diagonal().iter().map(|x| x.max(1e-18 * largest).sqrt()).collect();
    if scale.iter().any(|x| !(*x > 0.0 && x.is_finite())) {
        return None;
    }
    let unit = DMatrix::from_fn(count, count, |i, j| matrix[(i, j)] / (scale[i] * scale[j]));
    let unit = unit + DMatrix::identity(count, count) * 1e-13;
    let inverse = unit.cholesky()?.inverse();
    Some(DMatrix::from_fn(count, count, |i, j| inverse[(i, j)] / (scale[i] * scale[j])))
}

/// Quantile of the normal distribution, by bisection of the error function.
pub(crate) fn normal(share: f64) -> f64 {
    let (mut low, mut high) = (-40.0, 40.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let below = 0.5 * libm::erfc(-middle / std::f64::consts::SQRT_2);
        if below < share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Quantile of Student's distribution with some degrees of freedom, by the expansion of Cornish and Fisher.
pub(crate) fn student(share: f64, degrees: f64) -> f64 {
    let z = normal(share);
    let (z3, z5, n) = (z * z * z, z * z * z * z * z, degrees.max(1.0));
    z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n)
}

/// Median over records of the largest contact force at a solution, N.
pub(crate) fn median_peak(trials: &mut Trials, records: &[usize], at: &Solution) -> f64 {
    let point = |(record, start): (&usize, &Vec<f64>)| Point {
        record: *record,
        z: at.z.clone(),
        start: start.clone(),
    };
    let points: Vec<Point> = records.iter().zip(&at.starts).map(point).collect();
    let mut peaks: Vec<f64> = trials.peaks(&points).into_iter().flatten().collect();
    peaks.sort_by(f64::total_cmp);
    peaks.get(peaks.len() / 2).copied().unwrap_or(0.0)
}

/// Profiles of all parameters; in place of them a better optimum, if one was found on the way.
pub(crate) fn profiles(
    problem: &Problem,
    trials: &mut Trials,
    best: &Solution,
    around: &Around,
    watch: Watch<'_>,
) -> Result<Result<Vec<Profile>, Solution>> {
    let mut all = Vec::new();
    for place in 0..best.z.len() {
        let mut sides = Vec::new();
        for direction in [-1.0, 1.0] {
            let name = trials.batch.parameters()[place].name.clone();
            tell(watch, &format!("profile of {name}, {}", if direction < 0.0 { "below" } else { "above" }))?;
            match side(problem, trials, best, around, (place, direction)) {
                Ok(side) => sides.push(side),
                Err(better) => return Ok(Err(better)),
            }
        }
        let [below, above] = [sides.remove(0), sides.remove(0)];
        all.push(joined(trials, problem, best, around, place, (below, above)));
    }
    Ok(Ok(all))
}

/// One side of a profile: places on the scale of the search with the rise there, in s², from the optimum
/// outwards, and the solutions.
struct Side {
    points: Vec<(f64, f64)>,
    solutions: Vec<Solution>,
    /// Bound on this side.
    bound: f64,
}

fn side(
    problem: &Problem,
    trials: &mut Trials,
    best: &Solution,
    around: &Around,
    (place, direction): (usize, f64),
) -> Result<Side, Solution> {
    let (low, high) = problem.bounds[place];
    let bound = if direction < 0.0 { low } else { high };
    let variance = around.variance.max(f64::MIN_POSITIVE);
    let threshold = (around.quantile * around.quantile).max(around.error_of_cost / variance);
    let mut problem = problem.clone();
    problem.fixed[place] = true;
    problem.iterations = ITERATIONS;
    let mut side = Side { points: Vec::new(), solutions: Vec::new(), bound };
    let mut at = best.clone();
    let usual = around.error(place).min(0.25 * (high - low));
    let mut length = 1.05 * threshold.sqrt() * usual;
    for _ in 0..POINTS {
        let from = at.z[place];
        let mut z = at.z.clone();
        z[place] = (best.z[place] + direction * length).clamp(low, high);
        if (z[place] - from).abs() < 1e-9 * (high - low) {
            break;
        }
        follow(&mut z, place, from, around);
        for (z, (low, high)) in z.iter_mut().zip(&problem.bounds) {
            *z = z.clamp(*low, *high);
        }
        let Some(found) = solve(&problem, trials, &z, &at.starts) else {
            // Runs fail from here on: the parameter cannot go farther.
            length = 0.5 * (length + (from - best.z[place]).abs());
            continue;
        };
        let rise = (found.cost() - best.cost()) / variance;
        if rise < -0.1 {
            return Err(found);
        }
        side.points.push((found.z[place], rise.max(0.0)));
        side.solutions.push(found.clone());
        if rise >= threshold || found.z[place] == bound {
            break;
        }
        length *= (1.1 * (threshold / rise.max(1e-3 * threshold)).sqrt()).clamp(1.3, 3.0);
        at = found;
    }
    Ok(side)
}

/// Moves the other parameters along with one, as the linear model says.
fn follow(z: &mut [f64], place: usize, from: f64, around: &Around) {
    let Some(covariance) = &around.covariance else { return };
    let change = z[place] - from;
    let own = covariance[(place, place)];
    for (other, value) in z.iter_mut().enumerate().filter(|(other, _)| *other != place) {
        let slope = covariance[(other, place)] / own;
        if slope.is_finite() {
            *value += slope * change;
        }
    }
}

impl Side {
    /// The place where the rise crosses a threshold, and true if the bound is reached before.
    fn crossing(&self, begin: f64, threshold: f64) -> (f64, bool) {
        let mut before = (begin, 0.0);
        for point in &self.points {
            if point.1 >= threshold {
                let root = |rise: f64| rise.max(0.0).sqrt();
                let share = (threshold.sqrt() - root(before.1))
                    / (root(point.1) - root(before.1)).max(f64::MIN_POSITIVE);
                return (before.0 + (point.0 - before.0) * share.clamp(0.0, 1.0), false);
            }
            before = *point;
        }
        (self.bound, true)
    }
}

fn joined(
    trials: &mut Trials,
    problem: &Problem,
    best: &Solution,
    around: &Around,
    place: usize,
    (below, above): (Side, Side),
) -> Profile {
    let scale = trials.scales[place];
    let variance = around.variance.max(f64::MIN_POSITIVE);
    let thresholds = (around.quantile * around.quantile, around.error_of_cost / variance);
    let begin = best.z[place];
    let ends = |threshold: f64| [below.crossing(begin, threshold), above.crossing(begin, threshold)];
    let [low, high] = ends(thresholds.0);
    let [low_one, high_one] = ends(thresholds.1);
    let inside = [(&below, low_one.0), (&above, high_one.0)];
    let mut peaks = vec![median_peak(trials, &problem.records, best)];
    for (side, end) in inside {
        // The last solution within the range, and the first beyond it, bound the force at its end.
        let nearest = side
            .solutions
            .iter()
            .min_by(|a, b| (a.z[place] - end).abs().total_cmp(&(b.z[place] - end).abs()));
        peaks.extend(nearest.map(|solution| median_peak(trials, &problem.records, solution)));
    }
    let mut points: Vec<(f64, f64)> = below.points.iter().rev().copied().collect();
    points.push((begin, 0.0));
    points.extend(&above.points);
    let value = |z: f64| scale.to_value(z);
    Profile {
        points: points.into_iter().map(|(z, rise)| (value(z), rise)).collect(),
        interval: (value(low.0), value(high.0)),
        one_error: (value(low_one.0), value(high_one.0)),
        peak_force: Some((
            peaks.iter().copied().fold(f64::INFINITY, f64::min),
            peaks.iter().copied().fold(0.0, f64::max),
        )),
        open: (low.1, high.1),
        thresholds,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        assert!((normal(0.975) - 1.959_964).abs() < 1e-6);
        assert!((student(0.975, 30.0) - 2.042).abs() < 2e-3);
        assert!((student(0.975, 10.0) - 2.228).abs() < 5e-3);
    }
}
