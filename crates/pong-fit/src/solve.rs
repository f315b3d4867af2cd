//! Bounded nonlinear least squares by Levenberg and Marquardt, with unknowns that all records share (the
//! parameters) and unknowns of each record (its start).
//!
//! The sum of squares is Σ_r |e_r(z, s_r)|², with z the parameters and s_r the start of record r. Its normal
//! equations are an arrow: each record couples its own start to z alone, so the starts are eliminated record
//! by record (Schur complement), and the system that is solved has the size of z.
//!
//! Derivatives are differences: central in z, forward in s.

use nalgebra::{DMatrix, DVector};

/// Point at which the residuals of a record are wanted.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub record: usize,
    pub z: Vec<f64>,
    pub start: Vec<f64>,
}

/// Residuals of records, each in standard deviations of the sensor.
pub(crate) trait Residuals {
    /// Residuals at each point; `None` where the run failed.
    fn of(&mut self, points: &[Point]) -> Vec<Option<Vec<f64>>>;
}

/// Unknowns and limits of a problem.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    /// Records that take part.
    pub records: Vec<usize>,
    /// Bounds of each parameter.
    pub bounds: Vec<(f64, f64)>,
    /// Difference for the derivative by each parameter.
    pub steps: Vec<f64>,
    /// Parameters that stay as they are.
    pub fixed: Vec<bool>,
    /// Difference for the derivative by each unknown of a start; empty if starts are known.
    pub start_steps: Vec<f64>,
    /// Largest number of iterations.
    pub iterations: usize,
}

/// Solution, or a point on the way to it.
#[derive(Clone, Debug)]
pub(crate) struct Solution {
    pub z: Vec<f64>,
    /// Unknowns of the start of each record that takes part.
    pub starts: Vec<Vec<f64>>,
    /// Sum of squares of each record that takes part.
    pub costs: Vec<f64>,
    /// True if the last iteration gained nothing that counts.
    pub converged: bool,
}

impl Solution {
    /// Sum of squares of all records.
    pub fn cost(&self) -> f64 {
        self.costs.iter().sum()
    }
}

/// Linear model of a record at a point.
pub(crate) struct Linear {
    pub residuals: DVector<f64>,
    /// Derivatives by the parameters.
    pub of_z: DMatrix<f64>,
    /// Derivatives by the unknowns of the start.
    pub of_start: DMatrix<f64>,
}

/// Normal equations of a record: JᵀJ and Jᵀe in blocks.
struct Normal {
    zz: DMatrix<f64>,
    zs: DMatrix<f64>,
    ss: DMatrix<f64>,
    gz: DVector<f64>,
    gs: DVector<f64>,
}

impl Linear {
    fn normal(&self) -> Normal {
        let (z, s, e) = (&self.of_z, &self.of_start, &self.residuals);
        Normal { zz: z.tr_mul(z), zs: z.tr_mul(s), ss: s.tr_mul(s), gz: z.tr_mul(e), gs: s.tr_mul(e) }
    }

    /// JᵀJ and Jᵀe of the parameters, the start of the record eliminated.
    pub fn reduced(&self) -> (DMatrix<f64>, DVector<f64>) {
        self.normal().reduced(0.0)
    }
}

/// Share of the largest diagonal element below which an unknown counts as not moved by the data.
const UNMOVED: f64 = 1e-14;

impl Normal {
    /// The inverse of the block of the start, damped.
    fn inverse_of_start(&self, damping: f64) -> DMatrix<f64> {
        let count = self.ss.nrows();
        let largest = self.ss.diagonal().iter().copied().fold(0.0, f64::max);
        let mut block = self.ss.clone();
        for place in 0..count {
            block[(place, place)] +=
                damping * self.ss[(place, place)] + UNMOVED * largest + f64::MIN_POSITIVE;
        }
        block.cholesky().map_or_else(|| DMatrix::zeros(count, count), |factors| factors.inverse())
    }

    fn reduced(&self, damping: f64) -> (DMatrix<f64>, DVector<f64>) {
        if self.ss.nrows() == 0 {
            return (self.zz.clone(), self.gz.clone());
        }
        let through = &self.zs * self.inverse_of_start(damping);
        (&self.zz - &through * self.zs.transpose(), &self.gz - through * &self.gs)
    }

    /// Change of the start that goes with a change of the parameters.
    fn start_step(&self, damping: f64, dz: &DVector<f64>) -> Vec<f64> {
        if self.ss.nrows() == 0 {
            return Vec::new();
        }
        let right = &self.gs + self.zs.tr_mul(dz);
        (-(self.inverse_of_start(damping) * right)).iter().copied().collect()
    }
}

/// Gain of an iteration, in squared standard deviations of a residual, below which it counts for nothing.
const GAIN: f64 = 0.02;

/// Relative gain of an iteration below which it counts for nothing.
const RELATIVE_GAIN: f64 = 1e-4;

const DAMPING_START: f64 = 1e-3;
const DAMPING_MAX: f64 = 1e8;

/// Solves a problem from a point. `None` if the residuals there cannot be computed.
pub(crate) fn solve(
    problem: &Problem,
    residuals: &mut dyn Residuals,
    z: &[f64],
    starts: &[Vec<f64>],
) -> Option<Solution> {
    let mut now = evaluate(problem, residuals, z.to_vec(), starts.to_vec())?;
    let mut damping = DAMPING_START;
    for _ in 0..problem.iterations {
        let normals: Vec<Normal> = linearise(problem, residuals, &now).iter().map(Linear::normal).collect();
        let degrees = normals.len().max(1);
        let mut gained = None;
        while damping < DAMPING_MAX {
            let (z, starts) = step(problem, &now, &normals, damping);
            let tried = evaluate(problem, residuals, z, starts).filter(|tried| tried.cost() < now.cost());
            if let Some(better) = tried {
                gained = Some(now.cost() - better.cost());
                now = better;
                damping = (damping * 0.2).max(1e-9);
                break;
            }
            damping *= 8.0;
        }
        let scale = (now.cost() / degrees as f64).min(1.0);
        if gained.is_none_or(|gain| gain < GAIN * scale || gain < RELATIVE_GAIN * now.cost()) {
            now.converged = true;
            break;
        }
    }
    Some(now)
}

/// Residuals at a point; `None` if one of the runs failed.
pub(crate) fn evaluate(
    problem: &Problem,
    residuals: &mut dyn Residuals,
    z: Vec<f64>,
    starts: Vec<Vec<f64>>,
) -> Option<Solution> {
    let point =
        |(record, start): (&usize, &Vec<f64>)| Point { record: *record, z: z.clone(), start: start.clone() };
    let points: Vec<Point> = problem.records.iter().zip(&starts).map(point).collect();
    let squares =
        |e: Option<Vec<f64>>| e.map(|e| e.iter().map(|x| x * x).sum::<f64>()).filter(|sum| sum.is_finite());
    let costs: Option<Vec<f64>> = residuals.of(&points).into_iter().map(squares).collect();
    costs.map(|costs| Solution { z, starts, costs, converged: false })
}

/// The linear model of each record at a point.
pub(crate) fn linearise(problem: &Problem, residuals: &mut dyn Residuals, at: &Solution) -> Vec<Linear> {
    let free: Vec<usize> = (0..at.z.len()).filter(|place| !problem.fixed[*place]).collect();
    let mut points = Vec::new();
    for (record, start) in problem.records.iter().zip(&at.starts) {
        let base = Point { record: *record, z: at.z.clone(), start: start.clone() };
        points.push(base.clone());
        for place in &free {
            for sign in [1.0, -1.0] {
                let mut point = base.clone();
                let (low, high) = problem.bounds[*place];
                point.z[*place] = (at.z[*place] + sign * problem.steps[*place]).clamp(low, high);
                points.push(point);
            }
        }
        for (place, step) in problem.start_steps.iter().enumerate() {
            let mut point = base.clone();
            point.start[place] += step;
            points.push(point);
        }
    }
    let computed = residuals.of(&points);
    let width = 1 + 2 * free.len() + problem.start_steps.len();
    computed
        .chunks(width)
        .zip(points.chunks(width))
        .map(|(e, points)| differences(problem, &free, e, points))
        .collect()
}

fn differences(problem: &Problem, free: &[usize], e: &[Option<Vec<f64>>], points: &[Point]) -> Linear {
    let base = e[0].clone().unwrap_or_default();
    let rows = base.len();
    let mut of_z = DMatrix::zeros(rows, points[0].z.len());
    // A run that failed has no part in a difference.
    let taken =
        |index: usize| e[index].as_ref().filter(|e| e.len() == rows).map_or((0, &base), |e| (index, e));
    for (number, place) in free.iter().enumerate() {
        let ((upper, above), (lower, below)) = (taken(1 + 2 * number), taken(2 + 2 * number));
        let apart = points[upper].z[*place] - points[lower].z[*place];
        if apart != 0.0 {
            for row in 0..rows {
                of_z[(row, *place)] = (above[row] - below[row]) / apart;
            }
        }
    }
    let mut of_start = DMatrix::zeros(rows, problem.start_steps.len());
    for (place, step) in problem.start_steps.iter().enumerate() {
        let (_, moved) = taken(1 + 2 * free.len() + place);
        for row in 0..rows {
            of_start[(row, place)] = (moved[row] - base[row]) / step;
        }
    }
    Linear { residuals: DVector::from_vec(base), of_z, of_start }
}

/// Next point with a damping. Parameters at a bound that the descent would cross stay there.
fn step(problem: &Problem, now: &Solution, normals: &[Normal], damping: f64) -> (Vec<f64>, Vec<Vec<f64>>) {
    let count = now.z.len();
    let (mut h, mut g) = (DMatrix::zeros(count, count), DVector::zeros(count));
    for normal in normals {
        let (part, gradient) = normal.reduced(damping);
        h += part;
        g += gradient;
    }
    let diagonal: Vec<f64> = normals.iter().fold(vec![0.0; count], |mut sum, normal| {
        sum.iter_mut().enumerate().for_each(|(place, sum)| *sum += normal.zz[(place, place)]);
        sum
    });
    let mut held = problem.fixed.clone();
    let mut dz = DVector::zeros(count);
    // Each round holds the parameters that the step would carry across a bound.
    for _ in 0..=count {
        dz = solve_free(&h, &g, &diagonal, damping, &held, &dz);
        let mut crossed = false;
        for place in (0..count).filter(|place| !held[*place]).collect::<Vec<_>>() {
            let (low, high) = problem.bounds[place];
            let wanted = now.z[place] + dz[place];
            if wanted < low || wanted > high {
                dz[place] = wanted.clamp(low, high) - now.z[place];
                held[place] = true;
                crossed = true;
            }
        }
        if !crossed {
            break;
        }
    }
    let z = now.z.iter().enumerate().map(|(place, z)| {
        let (low, high) = problem.bounds[place];
        if problem.fixed[place] { *z } else { (z + dz[place]).clamp(low, high) }
    });
    let z: Vec<f64> = z.collect();
    let moved = |(normal, start): (&Normal, &Vec<f64>)| {
        let change = normal.start_step(damping, &dz);
        start.iter().zip(change).map(|(start, change)| start + change).collect()
    };
    (z, normals.iter().zip(&now.starts).map(moved).collect())
}

/// Damped Newton step of the parameters that are not held; the held ones move as `dz` says.
fn solve_free(
    h: &DMatrix<f64>,
    g: &DVector<f64>,
    diagonal: &[f64],
    damping: f64,
    held: &[bool],
    dz: &DVector<f64>,
) -> DVector<f64> {
    let free: Vec<usize> = (0..held.len()).filter(|place| !held[*place]).collect();
    if free.is_empty() {
        return dz.clone();
    }
    let largest = diagonal.iter().copied().fold(0.0, f64::max);
    let mut block = DMatrix::zeros(free.len(), free.len());
    let mut right = DVector::zeros(free.len());
    for (row, i) in free.iter().enumerate() {
        right[row] = -g[*i];
        for place in (0..held.len()).filter(|place| held[*place]) {
            right[row] -= h[(*i, place)] * dz[place];
        }
        for (column, j) in free.iter().enumerate() {
            block[(row, column)] = h[(*i, *j)];
        }
        block[(row, row)] += damping * diagonal[*i] + UNMOVED * largest + f64::MIN_POSITIVE;
    }
    let mut result = dz.clone();
    if let Some(solved) = block.lu().solve(&right) {
        free.iter().enumerate().for_each(|(row, place)| result[*place] = solved[row]);
    } else {
        free.iter().for_each(|place| result[*place] = 0.0);
    }
    result
}
