//! W5: bars and boxes at rest on a plane and on blocks.

use crate::case::{Case, Failure, Outcome};
use crate::row::Row;
use crate::scene::{Duo, G, Run, at, set_spring};
use pong_executive::{Integrator, MassProperties, RigidBody, Vec3};

pub const W5: Case = Case {
    id: "W5",
    title: "Bars and boxes at rest",
    set_up: "2 kg as a bar 0.4 m long with its mass centre 0.1 m off the middle, on a plane and on a block; the bar with \
             its mass centre in the middle across the seam of two blocks; a box on four points on a block. 1e5 N/m, \
             friction off.",
    source: "moment balance; the ends of a bar carry half the stiffness each, so a bar lying flat carries k·δ",
    rows,
};

const MASS: f64 = 2.0;
const STIFFNESS: f64 = 1e5;

fn settle(mover: &str, ground: &str, middle: Vec3, start: Vec3) -> Result<Run, Failure> {
    let duo = Duo::new(mover, ground)?
        .mover(|s| set_spring(s, STIFFNESS, 400.0))?
        .ground(|s| s.stiffness = f64::INFINITY)?;
    let mass = MassProperties::principal(MASS, [0.02, 0.03, 0.03]).with_mass_center(middle);
    let body = RigidBody::free("body", mass).at(at(start));
    let mut run = duo.on_ground((Integrator::RungeKutta4, 5e-4), body)?.with_gravity();
    run.sim.run_for(1.0)?;
    Ok(run)
}

fn rows() -> Outcome {
    let weight = MASS * G;
    let mut rows = Vec::new();
    for (ground, name) in [("ground", "plane"), ("tiles_rough", "block")] {
        let run = settle("bar", ground, Vec3::zeros(), Vec3::zeros())?;
        // The ends are 0.1 and 0.3 m from the mass centre.
        for (end, share) in [(0, 0.75), (1, 0.25)] {
            let load: f64 = run.contacts().iter().filter(|c| c.end == end).map(|c| c.normal_force).sum();
            rows.push(Row::relative(
                format!("bar on a {name}: load of end {end}"),
                "N",
                share * weight,
                load,
                1e-6,
            ));
        }
    }
    // The seam between the first two blocks is at x = 1.5 m.
    let across = settle("bar", "tiles_rough", Vec3::x() * 0.1, Vec3::x() * 1.35)?;
    let load: f64 = across.contacts().iter().map(|c| c.normal_force).sum();
    rows.push(Row::relative("bar across a seam: depth", "m", weight / STIFFNESS, -across.position().z, 1e-6));
    rows.push(Row::relative("bar across a seam: load", "N", weight, load, 1e-9));
    let boxed = settle("box_points", "tiles_rough", Vec3::zeros(), Vec3::new(0.3, 0.1, 0.05))?;
    let depth = weight / (4.0 * STIFFNESS);
    rows.push(Row::relative("box: depth", "m", depth, 0.05 - boxed.position().z, 1e-9));
    for contact in boxed.contacts() {
        let name = format!("box: load of corner {}", contact.a.primitive);
        rows.push(Row::relative(name, "N", 0.25 * weight, contact.normal_force, 1e-9));
    }
    Ok(rows)
}
