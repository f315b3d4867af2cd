//! V3, V4, V28: one bounce of a point mass, averaged over the phase of touch within a step.

use crate::case::{Case, Failure, Outcome};
use crate::measure::bisect;
use crate::row::Row;
use crate::scene::{Duo, at, moving, point_mass, set_dissipation, set_spring};
use pong_executive::{Integrator, Vec3};

pub const V3: Case = Case {
    id: "V3",
    title: "One bounce, linear law that never pulls",
    set_up: "1 kg at 1 m/s onto 1e5 N/m, no ramp, Runge-Kutta at ω·dt = 0.01, 16 phases of touch.",
    source: "ζ < 1: e = exp(−(ζ/s)·atan2(2ζs, 2ζ² − 1)), s = √(1 − ζ²); ζ = 1: e = exp(−2)",
    rows: linear,
};

pub const V4: Case = Case {
    id: "V4",
    title: "One bounce, Hunt-Crossley law",
    set_up: "1 kg at 1 m/s, χ·v = 1 and 10, exponents 1 and 3/2, Runge-Kutta, 16 phases of touch.",
    source: "ln((1 + χv)/(1 − χev)) = χv·(1 + e); Hunt and Crossley, J. Appl. Mech. 42 (1975), integrated",
    rows: hunt_crossley,
};

pub const V28: Case = Case {
    id: "V28",
    title: "Zero-order hold makes energy",
    set_up: "One undamped bounce with the wrench held over a frame T, mean over 200 phases of touch.",
    source: "e = exp(π·ω·T/4): holding a force delays it by T/2, which is a damping of −k·T/2",
    rows: zero_order_hold,
};

pub const W16: Case = Case {
    id: "W16",
    title: "Damping given as restitution",
    set_up: "As V3 and V4 with model files that say `restitution` instead of a damping: 0.25 for 1 kg with the linear \
             law, 0.5 at 1 m/s with the Hunt-Crossley law.",
    source: "the restitution asked for comes out; textbook ζ, without the clamp, would give 0.361 for 0.25",
    rows: by_restitution,
};

const MASS: f64 = 1.0;
const SPEED: f64 = 1.0;
const STIFFNESS: f64 = 1e5;

/// Ratio of rebound to impact speed for every phase of touch.
fn restitutions(
    duo: impl Fn() -> Result<Duo, Failure>,
    method: (Integrator, f64),
    phases: usize,
) -> Result<Vec<f64>, Failure> {
    restitutions_of(duo, (MASS, SPEED), method, phases)
}

/// Bounces of a point of this mass (kg) and speed (m/s).
pub(super) fn restitutions_of(
    duo: impl Fn() -> Result<Duo, Failure>,
    (mass, speed): (f64, f64),
    method: (Integrator, f64),
    phases: usize,
) -> Result<Vec<f64>, Failure> {
    (0..phases)
        .map(|phase| {
            let gap = speed * method.1 * (phase as f64 + 0.5) / phases as f64;
            let start = point_mass(mass).at(at(Vec3::z() * gap)).moving(moving(Vec3::z() * -speed));
            let mut run = duo()?.on_ground(method, start)?;
            run.sim.step()?;
            while run.position().z <= 0.0 || run.velocity().z <= 0.0 {
                run.sim.step()?;
                if run.sim.time() > 1.0 {
                    return Err("the mass does not come back".into());
                }
            }
            Ok(run.velocity().z / speed)
        })
        .collect()
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn worst(values: &[f64], expected: f64) -> f64 {
    values.iter().map(|value| (value - expected).abs()).fold(0.0, f64::max)
}

fn linear() -> Outcome {
    let omega = (STIFFNESS / MASS).sqrt();
    let mut rows = Vec::new();
    for (zeta, name) in [(0.05, "0.05"), (0.25528, "0.25528"), (0.7, "0.7"), (1.0, "1")] {
        let expected = clamped_restitution(zeta);
        let damping = 2.0 * zeta * (STIFFNESS * MASS).sqrt();
        let duo = || Duo::new("point", "ground")?.mover(|s| set_spring(s, STIFFNESS, damping));
        let got = restitutions(duo, (Integrator::RungeKutta4, 0.01 / omega), 16)?;
        rows.push(Row::absolute(format!("ζ = {name}: e, mean"), "", expected, mean(&got), 1e-4));
        let off = worst(&got, expected);
        rows.push(Row::below(format!("ζ = {name}: e, worst phase less expected"), "", off, 1e-3));
    }
    Ok(rows)
}

/// Restitution of F = max(0, kδ + cδ').
pub fn clamped_restitution(zeta: f64) -> f64 {
    if zeta == 1.0 {
        return libm::exp(-2.0);
    }
    let s = (1.0 - zeta * zeta).sqrt();
    libm::exp(-(zeta / s) * libm::atan2(2.0 * zeta * s, 2.0 * zeta * zeta - 1.0))
}

fn hunt_crossley() -> Outcome {
    let mut rows = Vec::new();
    for (law, stiffness, name) in [("hunt_crossley", 1e5, "exponent 1"), ("hertz", 1e7, "exponent 3/2")] {
        for chi in [1.0, 10.0] {
            let expected = rebound(chi * SPEED) / chi / SPEED;
            let duo = || {
                Duo::new(&format!("point_{law}"), &format!("ground_{law}"))?.mover(|s| {
                    s.stiffness = stiffness;
                    set_dissipation(s, chi);
                })
            };
            let step = 0.005 / (1e5_f64 / MASS).sqrt();
            let got = restitutions(duo, (Integrator::RungeKutta4, step), 16)?;
            rows.push(Row::absolute(format!("{name}, χv = {chi}: e, mean"), "", expected, mean(&got), 1e-4));
            let off = worst(&got, expected);
            rows.push(Row::below(format!("{name}, χv = {chi}: e, worst phase less expected"), "", off, 1e-4));
        }
    }
    Ok(rows)
}

/// χ·v_o from χ·v_i.
fn rebound(chi_v: f64) -> f64 {
    bisect(0.0, 1.0, |out| libm::log1p(chi_v) - libm::log1p(-out) < chi_v + out)
}

fn by_restitution() -> Outcome {
    let step = 0.005 / (STIFFNESS / MASS).sqrt();
    let cases = [
        ("linear law", "point_restitution", "ground", 0.25),
        ("Hunt-Crossley law", "point_hunt_crossley_restitution", "ground_hunt_crossley", 0.5),
    ];
    let mut rows = Vec::new();
    for (name, mover, ground, expected) in cases {
        let got = restitutions(|| Duo::new(mover, ground), (Integrator::RungeKutta4, step), 16)?;
        rows.push(Row::absolute(format!("{name}: e, mean"), "", expected, mean(&got), 1e-4));
    }
    Ok(rows)
}

fn zero_order_hold() -> Outcome {
    let omega = (STIFFNESS / MASS).sqrt();
    let mut rows = Vec::new();
    for (phase, tolerance) in [(0.01, 0.01), (0.1, 0.02)] {
        let expected = libm::exp(core::f64::consts::FRAC_PI_4 * phase);
        let duo = || Duo::new("point", "ground")?.mover(|s| s.stiffness = STIFFNESS);
        let hold = Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 };
        let got = mean(&restitutions(duo, (hold, phase / omega), 200)?);
        rows.push(Row::relative(
            format!("ωT = {phase}: e − 1, mean"),
            "",
            expected - 1.0,
            got - 1.0,
            tolerance,
        ));
    }
    Ok(rows)
}
