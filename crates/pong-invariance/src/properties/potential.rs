//! Incremental potential of a step (docs/theory.md, 7): its wrenches against central differences of its energy.

use super::tangent::{branches, moved, over_frames, scale};
use crate::base::Base;
use crate::judge::Verdict;
use crate::play::{Answer, Stage};
use crate::random::Random;
use crate::scene::Scene;
use pong_engine::{EngineError, PairPotential, State};

/// Largest difference, relative to the largest wrench.
const TOLERANCE: f64 = 1e-6;

/// Length of the step, s.
const STEP_S: f64 = 0.01;

/// Checks the potentials of all frames whose energies are smooth around their states.
pub fn of_differences(base: &mut Base, _: &mut Random) -> Verdict {
    over_frames(base, |stage, scene, states, answer| {
        let potentials = match stage.world.incremental_potentials(STEP_S) {
            Err(EngineError::BadValue { .. }) => return Ok(false),
            potentials => potentials.map_err(|error| (1.0, error.to_string()))?,
        };
        let exact = slopes_of(&potentials, stage, scene.size);
        let Some(differences) = by_differences(stage, scene, states, answer) else { return Ok(false) };
        compare(&exact, &differences).map_or(Ok(true), Err)
    })
}

/// Derivatives of the energy by a translation, or a rotation times the size, of A and of B.
fn slopes_of(potentials: &[PairPotential], stage: &Stage, size: f64) -> [f64; 12] {
    std::array::from_fn(|column| {
        let of_pair = |potential: &PairPotential| {
            let wrench = &potential.wrenches[usize::from(potential.groups[1] == stage.groups[column / 6])];
            let part = if column % 6 < 3 { &wrench.force } else { &wrench.moment };
            -part[column % 3] * scale(column, size)
        };
        potentials.iter().map(of_pair).sum()
    })
}

fn energy(stage: &mut Stage, states: &[State; 2], answer: &Answer) -> Option<f64> {
    let found = stage.evaluate(states).ok()?;
    if branches(&found) != branches(answer) {
        return None;
    }
    Some(stage.world.incremental_potentials(STEP_S).ok()?.iter().map(|potential| potential.energy).sum())
}

/// Derivatives by central differences of two widths, extrapolated, and their errors. `None` if a contact begins or ends
/// within the widths, or the two widths disagree.
fn by_differences(
    stage: &mut Stage,
    scene: &Scene,
    states: &[State; 2],
    answer: &Answer,
) -> Option<[(f64, f64); 12]> {
    let least = answer.contacts.iter().map(|touch| touch.depth).fold(f64::INFINITY, f64::min);
    let width = (1e-5 * least).clamp(1e-9 * scene.size, 1e-4 * scene.size);
    let mut found = [(0.0, 0.0); 12];
    let mut largest = 0.0_f64;
    for (column, found) in found.iter_mut().enumerate() {
        let mut side = |by: f64| {
            let mut beside = *states;
            let state = &mut beside[column / 6];
            *state = moved(state, column % 6, by * scale(column, scene.size), false);
            energy(stage, &beside, answer)
        };
        let here = side(0.0)?;
        // Slope, and how far the one-sided slopes are apart.
        let mut slope = |width: f64| {
            let (ahead, behind) = (side(width)?, side(-width)?);
            Some(((ahead - behind) / (2.0 * width), (ahead + behind - 2.0 * here).abs() / width))
        };
        let ((wide, bend), (narrow, less)) = (slope(width)?, slope(0.5 * width)?);
        let rounding = 1e-14 * here.abs() / width;
        // The one-sided slopes approach each other with the width, except at a kink.
        if less > 0.75 * bend + 10.0 * rounding {
            return None;
        }
        // A jump or a kink within the widths spoils the extrapolation by up to 7/3 of their difference.
        *found = ((4.0 * narrow - wide) / 3.0, 3.0 * (wide - narrow).abs() + rounding);
        largest = largest.max(wide.abs());
    }
    found.iter().all(|(_, error)| *error < TOLERANCE * largest).then_some(found)
}

fn compare(exact: &[f64; 12], differences: &[(f64, f64); 12]) -> Option<(f64, String)> {
    let largest = exact.iter().fold(f64::MIN_POSITIVE, |most, slope| most.max(slope.abs()));
    let off = |column: usize| (exact[column] - differences[column].0).abs() - differences[column].1;
    let worst = (0..12).max_by(|&a, &b| off(a).total_cmp(&off(b)))?;
    (off(worst) > TOLERANCE * largest).then(|| {
        let says = format!(
            "column {worst}: {:e}, by differences {:e}; largest {largest:e}",
            exact[worst], differences[worst].0
        );
        (off(worst) / largest, says)
    })
}
