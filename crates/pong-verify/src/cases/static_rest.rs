//! V1: a mass on a spring comes to rest at m·g/k.

use crate::case::{Case, Outcome};
use crate::row::Row;
use crate::scene::{Duo, G, point_mass, set_spring};
use pong_executive::Integrator;

pub const V1: Case = Case {
    id: "V1",
    title: "Static rest",
    set_up: "1 kg on a contact of 1e5 N/m, dropped from touch, damped near critical, 1 s.",
    source: "depth = m·g/k",
    rows,
};

const MASS: f64 = 1.0;
const STIFFNESS: f64 = 1e5;

fn rows() -> Outcome {
    let critical = 2.0 * (STIFFNESS * MASS).sqrt();
    let duo = Duo::new("point", "ground")?.mover(|s| set_spring(s, STIFFNESS, 0.9 * critical))?;
    let body = point_mass(MASS);
    let mut run = duo.on_ground((Integrator::RungeKutta4, 1e-3), body)?.with_gravity();
    run.sim.run_for(1.0)?;
    let contact = run.contact()?;
    let depth = MASS * G / STIFFNESS;
    Ok(vec![
        Row::relative("depth", "m", depth, contact.depth, 1e-9),
        Row::relative("height of the mass", "m", -depth, run.position().z, 1e-9),
        Row::relative("normal force", "N", MASS * G, contact.normal_force, 1e-9),
    ])
}
