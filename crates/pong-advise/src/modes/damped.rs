//! Eigenvalues of the damped system, with the whole of K and D, and the modes to which they belong.
//!
//! An eigenvalue s and its vector solve (s² + D·s + K)·q = 0 in coordinates in which every mass is one. A mode q of the
//! undamped system predicts the two roots of s² + (qᵀDq)·s + qᵀKq = 0; the eigenvalues nearest to them are those of this
//! mode.

use super::kind::{ModeKind, bad};
use nalgebra::{Complex, DMatrix, Schur};
use pong_engine::EngineError;

/// A motion of the damped system that grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// Growth rate, 1/s: the motion grows by the factor e in the time 1/rate.
    pub rate: f64,
    /// Frequency, Hz: above 0 for flutter, 0 for a motion that leaves the state without oscillation.
    pub frequency: f64,
}

/// Eigenvalues of the damped system.
pub(super) struct Damped {
    /// The two eigenvalues of each mode that oscillates, 1/s.
    pub pairs: Vec<Option<[Complex<f64>; 2]>>,
    pub growths: Vec<Growth>,
}

impl Damped {
    pub fn new(
        stiffness: &DMatrix<f64>,
        damping: &DMatrix<f64>,
        (rates, vectors, kinds): (&[f64], &DMatrix<f64>, &[ModeKind]),
        tolerance: f64,
    ) -> Result<Self, EngineError> {
        let (stiffness, damping) = (vectors.tr_mul(stiffness) * vectors, vectors.tr_mul(damping) * vectors);
        let kept: Vec<usize> = (0..rates.len())
            .filter(|index| {
                kinds[*index] != ModeKind::Rigid || acts_on(&stiffness, &damping, *index, tolerance)
            })
            .collect();
        let pick = |matrix: &DMatrix<f64>| matrix.select_rows(&kept).select_columns(&kept);
        let eigenvalues = eigenvalues(&pick(&stiffness), &pick(&damping))?;
        let scale = eigenvalues.iter().map(|value| value.norm()).fold(0.0, f64::max);
        // The root of the tolerance: a double eigenvalue turns an error of K into its root.
        let grows = |value: &&Complex<f64>| value.re > tolerance.sqrt() * scale && value.im >= 0.0;
        let growth =
            |value: &Complex<f64>| Growth { rate: value.re, frequency: value.im / std::f64::consts::TAU };
        let growths = eigenvalues.iter().filter(grows).map(growth).collect();
        let mut pairs = vec![None; rates.len()];
        let oscillating: Vec<usize> =
            (0..rates.len()).filter(|index| kinds[*index] == ModeKind::Oscillation).collect();
        let predicted: Vec<[Complex<f64>; 2]> =
            oscillating.iter().map(|index| roots(damping[(*index, *index)], rates[*index])).collect();
        for (index, pair) in oscillating.iter().zip(matched(&predicted, &eigenvalues)) {
            pairs[*index] = pair;
        }
        Ok(Self { pairs, growths })
    }
}

/// True if damping or the unsymmetric part of the stiffness acts on a mode without stiffness.
fn acts_on(stiffness: &DMatrix<f64>, damping: &DMatrix<f64>, index: usize, tolerance: f64) -> bool {
    let acts = |matrix: &DMatrix<f64>| {
        let within = tolerance * matrix.amax();
        matrix.column(index).amax() > within || matrix.row(index).amax() > within
    };
    acts(stiffness) || acts(damping)
}

/// Roots of s² + d·s + rate = 0.
fn roots(damping: f64, rate: f64) -> [Complex<f64>; 2] {
    let (half, root) = (0.5 * damping, Complex::new(0.25 * damping * damping - rate, 0.0).sqrt());
    if root.re > 0.0 && half > 0.0 {
        // Without cancellation: the product of both roots is the rate.
        let fast = -half - root.re;
        return [Complex::new(rate / fast, 0.0), Complex::new(fast, 0.0)];
    }
    [root - half, -root - half]
}

/// Eigenvalues of s² + D·s + K, 1/s.
fn eigenvalues(stiffness: &DMatrix<f64>, damping: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, EngineError> {
    let size = stiffness.nrows();
    if size == 0 {
        return Ok(Vec::new());
    }
    // A unit of time in which all blocks of the state matrix are of the same size.
    let speed = stiffness.amax().sqrt().max(damping.amax()).max(f64::MIN_POSITIVE);
    let mut state = DMatrix::zeros(2 * size, 2 * size);
    state.view_mut((0, size), (size, size)).fill_with_identity();
    state.view_mut((size, 0), (size, size)).copy_from(&(-stiffness / (speed * speed)));
    state.view_mut((size, size), (size, size)).copy_from(&(-damping / speed));
    let schur = Schur::try_new(state, f64::EPSILON, 100_000)
        .ok_or_else(|| bad("the eigenvalues of the damped system do not converge"))?;
    Ok(schur.complex_eigenvalues().iter().map(|value| value * speed).collect())
}

/// Eigenvalues of each mode: first the conjugate pairs, each to the mode whose prediction is nearest, then two real
/// ones to each of the other modes.
fn matched(predicted: &[[Complex<f64>; 2]], eigenvalues: &[Complex<f64>]) -> Vec<Option<[Complex<f64>; 2]>> {
    let mut found: Vec<Option<[Complex<f64>; 2]>> = vec![None; predicted.len()];
    let oscillating: Vec<Complex<f64>> = eigenvalues.iter().copied().filter(|value| value.im > 0.0).collect();
    let upper = |pair: &[Complex<f64>; 2]| if pair[0].im >= 0.0 { pair[0] } else { pair[1] };
    let wanted: Vec<Complex<f64>> = predicted.iter().map(upper).collect();
    for (mode, value) in nearest(&wanted, &oscillating) {
        found[mode] = Some([oscillating[value], oscillating[value].conj()]);
    }
    let real: Vec<Complex<f64>> = eigenvalues.iter().copied().filter(|value| value.im == 0.0).collect();
    let left: Vec<usize> = (0..predicted.len()).filter(|mode| found[*mode].is_none()).collect();
    let wanted: Vec<Complex<f64>> = left.iter().flat_map(|mode| predicted[*mode]).collect();
    let mut taken = vec![[None; 2]; left.len()];
    for (place, value) in nearest(&wanted, &real) {
        taken[place / 2][place % 2] = Some(real[value]);
    }
    for (mode, pair) in left.iter().zip(taken) {
        if let [Some(slow), Some(fast)] = pair {
            found[*mode] = Some([slow, fast]);
        }
    }
    found
}

/// Pairs of a wanted value and an eigenvalue, each used once, by rising relative distance.
fn nearest(wanted: &[Complex<f64>], values: &[Complex<f64>]) -> Vec<(usize, usize)> {
    let distance =
        |a: &Complex<f64>, b: &Complex<f64>| (a - b).norm() / (a.norm() + b.norm()).max(f64::MIN_POSITIVE);
    let mut all: Vec<(f64, usize, usize)> = Vec::new();
    for (i, one) in wanted.iter().enumerate() {
        all.extend(values.iter().enumerate().map(|(j, value)| (distance(one, value), i, j)));
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut free, mut unused) = (vec![true; wanted.len()], vec![true; values.len()]);
    let mut pairs = Vec::new();
    for (_, i, j) in all {
        if free[i] && unused[j] {
            (free[i], unused[j]) = (false, false);
            pairs.push((i, j));
        }
    }
    pairs
}
