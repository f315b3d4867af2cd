//! Bodies that overlap deeply when a run begins.

use super::extreme::{Answer, Extreme, Length};
use super::rig::{Rig, block, model, sheet, spring};
use crate::case::{Failure, Outcome};
use crate::row::Row;
use crate::scene::at;
use pong_engine::Config;
use pong_executive::{Integrator, MassProperties, RigidBody, Simulation, Vec3};

pub const DEEP: Extreme = Extreme {
    id: "E10",
    asked: "Deep overlap at the start: the body is pushed out by the shortest way, with no more energy than the \
            springs held.",
    set_up: "A sphere of 0.1 m and 1 kg starts at rest with 1 % to 190 % of its radius in a plane, a block, a sheet \
             and another sphere (1e5 N/m, undamped), and is released. Runge-Kutta at ω·dt = 0.01.",
    answer: Answer::Safe,
    limit: "without an earlier pose the nearest face pushes; a sheet pushes up to its thickness; energy in the overlap \
            becomes speed: √(k/m)·δ",
    also: "`crates/pong-engine/tests/it/side_of_entry.rs`, case W15",
    rows,
};

const STIFFNESS: f64 = 1e5;
const RADIUS: f64 = 0.1;

/// Grounds with the highest point at the origin, and the largest depth of the ball.
fn grounds() -> Vec<(&'static str, String, f64)> {
    let half = Vec3::new(0.5, 0.5, 0.25);
    vec![
        ("plane", "Plane(name: \"y\", normal: (0,0,1), offset: 0.0)".to_owned(), 1.9),
        ("block", block("y", Vec3::new(0.0, 0.0, -0.25), half, |p| p), 1.9),
        ("sheet", sheet("y", "", 4, |x, y| Vec3::new(x, y, 0.0)), 1.9),
        ("sphere", "Sphere(name: \"y\", center: (0,0,-0.3), radius: 0.3)".to_owned(), 1.9),
    ]
}

/// Separation speed of the ball over √(k/m)·δ, and its distance from the vertical over the height.
fn let_go(ground: &str, depth: f64) -> Result<(f64, f64), Failure> {
    let ball =
        model(&spring(STIFFNESS), &format!("Sphere(name: \"x\", center: (0,0,0), radius: {RADIUS:?})"));
    let rigid = model("stiffness: inf, normal: Linear(damping: 0.0)", ground);
    let rig = Rig::with(Config { ledger: true, ..Config::default() }, &ball, &rigid)?;
    let omega = STIFFNESS.sqrt();
    let mut sim = Simulation::new(rig.world, Integrator::RungeKutta4, 0.01 / omega)?;
    let start = at(Vec3::new(0.013, 0.007, RADIUS - depth));
    let mass = MassProperties::principal(1.0, [1e9; 3]);
    let body = sim.add_body(RigidBody::free("ball", mass).at(start).touching(rig.sides[0]))?;
    sim.add_body(RigidBody::fixed("ground").touching(rig.sides[1]))?;
    sim.commit_initial_states()?;
    // Away from the middle, the depth in a ball is less than the height below its top.
    let depth = sim.world().contacts_iter().map(|contact| contact.depth).fold(depth.min(0.0), f64::max);
    sim.run_for(4.0 / omega)?;
    let velocity = sim.twist(body).linear;
    Ok((velocity.norm() / (omega * depth), velocity.xy().norm() / velocity.norm()))
}

fn rows(_: Length) -> Outcome {
    let mut rows = Vec::new();
    for (name, ground, deepest) in grounds() {
        let shares = [0.01, 0.1, 0.5, 0.99, 1.0, 1.01, 1.5, deepest];
        let (mut speed, mut aside) = (0.0_f64, 0.0_f64);
        for share in shares {
            let (left, across) = let_go(&ground, share * RADIUS)?;
            speed = speed.max((left - 1.0).abs());
            aside = aside.max(across);
        }
        rows.push(Row::below(format!("{name}: speed over √(k/m)·δ, less 1, worst"), "", speed, 1e-4));
        if name != "sphere" {
            rows.push(Row::below(format!("{name}: part of the speed along the ground"), "", aside, 1e-9));
        }
    }
    Ok(rows)
}
