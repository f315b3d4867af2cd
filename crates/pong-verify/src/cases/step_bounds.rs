//! W13: largest stable step.

use crate::case::{Case, Failure, Outcome};
use crate::row::Row;
use crate::scene::{Duo, G, at, point_mass, set_spring};
use pong_executive::{Integrator, Vec3};

pub const W13: Case = Case {
    id: "W13",
    title: "Longest stable steps",
    set_up: "A sprung mass under its weight, disturbed by a millionth of its static depth, 2.5 % or 5 % on \
             either side of the bounds; κ = k·dt²/m, γ = c·dt/m. 1 stands for growth.",
    source: "semi-implicit Euler: κ + 2γ < 4; Runge-Kutta: ω·dt < 2.828, or γ < 2.785 without spring; wrench held over a \
             frame T: k·T/2 < c < 2m/T",
    rows,
};

const MASS: f64 = 1.0;
const STEP: f64 = 1e-3;

/// Tests whether a small disturbance grows.
fn grows(integrator: Integrator, kappa: f64, gamma: f64) -> Result<bool, Failure> {
    let stiffness = kappa * MASS / (STEP * STEP);
    let depth = MASS * G / stiffness;
    let duo = Duo::new("point", "ground")?.mover(|s| set_spring(s, stiffness, gamma * MASS / STEP))?;
    let start = 1e-6 * depth;
    let body = point_mass(MASS).at(at(Vec3::z() * (start - depth)));
    let mut run = duo.on_ground((integrator, STEP), body)?.with_gravity();
    let mut largest = 0.0_f64;
    for step in 0..4000 {
        run.sim.step()?;
        let off = (run.position().z + depth).abs();
        if off > 1e-2 * depth {
            return Ok(true);
        }
        if step >= 3900 {
            largest = largest.max(off);
        }
    }
    // A bounded oscillation may exceed its start; instability over 4,000 steps grows far beyond.
    Ok(largest > 1e2 * start)
}

fn rows() -> Outcome {
    let euler = Integrator::SemiImplicitEuler;
    let kutta = Integrator::RungeKutta4;
    let hold = Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 };
    let square = |x: f64| x * x;
    // Name, integrator, and (κ, γ) inside and outside of the stability bound.
    let cases = [
        ("semi-implicit Euler, κ alone", euler, (3.9, 0.0), (4.1, 0.0)),
        ("semi-implicit Euler, κ and γ", euler, (1.0, 1.4625), (1.0, 1.5375)),
        ("Runge-Kutta, κ alone", kutta, (square(2.757), 0.0), (square(2.899), 0.0)),
        ("Runge-Kutta, γ with a weak spring", kutta, (1e-3, 2.715), (1e-3, 2.855)),
        ("held wrench, least damping", hold, (0.1, 0.0525), (0.1, 0.0475)),
        ("held wrench, most damping", hold, (0.1, 1.95), (0.1, 2.05)),
    ];
    let mut rows = Vec::new();
    for (name, integrator, inside, outside) in cases {
        for (where_, (kappa, gamma), expected) in [("inside", inside, 0), ("outside", outside, 1)] {
            let got = usize::from(grows(integrator, kappa, gamma)?);
            rows.push(Row::count(format!("{name}: growth {where_}"), expected, got));
        }
    }
    Ok(rows)
}
