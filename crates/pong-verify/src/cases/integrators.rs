//! W12: a sprung mass under each integrator.

use crate::case::{Case, Failure, Outcome};
use crate::measure::order;
use crate::row::Row;
use crate::scene::{Duo, G, at, point_mass};
use pong_executive::{Integrator, Vec3};

pub const W12: Case = Case {
    id: "W12",
    title: "Orders of the integrators",
    set_up: "A point mass of 1 kg heaves undamped by half its static depth on 1e5 N/m; place after 5¼ periods \
             against the closed form, at a step and at half of it.",
    source: "z = z₀ + A·cos ωt; Runge-Kutta has order 4, semi-implicit Euler and a held wrench order 1",
    rows,
};

const MASS: f64 = 1.0;
const STIFFNESS: f64 = 1e5;
const DEPTH: f64 = MASS * G / STIFFNESS;

/// Position error, relative to the amplitude.
fn error(integrator: Integrator, steps: u32) -> Result<f64, Failure> {
    // After five and a quarter periods a phase error shows in full.
    let omega = (STIFFNESS / MASS).sqrt();
    let duration = 10.5 * core::f64::consts::PI / omega;
    let body = point_mass(MASS).at(at(Vec3::z() * (-0.5 * DEPTH)));
    let duo = Duo::new("point", "ground")?.mover(|s| s.stiffness = STIFFNESS)?;
    let step = duration / f64::from(steps);
    let mut run = duo.on_ground((integrator, step), body)?.with_gravity();
    for _ in 0..steps {
        run.sim.step()?;
    }
    let expected = DEPTH * (0.5 * libm::cos(omega * duration) - 1.0);
    Ok((run.position().z - expected) / (0.5 * DEPTH))
}

fn rows() -> Outcome {
    let hold = Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 };
    let cases = [
        ("Runge-Kutta", Integrator::RungeKutta4, 330, 4.0, 0.1),
        ("semi-implicit Euler", Integrator::SemiImplicitEuler, 3162, 1.0, 0.1),
        ("zero-order hold", hold, 31620, 1.0, 0.1),
    ];
    let mut rows = Vec::new();
    for (name, integrator, steps, expected, tolerance) in cases {
        let (coarse, fine) = (error(integrator, steps)?, error(integrator, 2 * steps)?);
        let got = order(coarse, fine);
        rows.push(
            Row::absolute(format!("{name}: observed order"), "", expected, got, tolerance).with_order(got),
        );
    }
    Ok(rows)
}
