//! V9: a block slides to a stop.

use crate::case::{Case, Outcome};
use crate::row::Row;
use crate::scene::{Bristle, Duo, G, at, moving, set_damping, with_friction};
use pong_executive::{Integrator, MassProperties, RigidBody, Vec3};

pub const V9: Case = Case {
    id: "V9",
    title: "Sliding to a stop",
    set_up: "1 kg on four points at 5 m/s, μ = 0.5, Runge-Kutta, dt 1e-3 s.",
    source: "distance v²/(2·μ·g), time v/(μ·g)",
    rows,
};

const MASS: f64 = 1.0;
const MU: f64 = 0.5;
const SPEED: f64 = 5.0;

fn rows() -> Outcome {
    let duo = Duo::new("block_rough", "ground_rough")?.mover(|s| set_damping(s, 200.0))?;
    let duo = with_friction(duo, &Bristle { mu: MU, excess: 0.0, stiffness: 6e4, damping: 120.0 })?;
    let body = RigidBody::free("block", MassProperties::cuboid(MASS, [0.2, 0.2, 0.1]))
        .at(at(Vec3::z() * (0.05 - MASS * G / 4e5)))
        .moving(moving(Vec3::new(0.6 * SPEED, 0.8 * SPEED, 0.0)));
    let mut run = duo.on_ground((Integrator::RungeKutta4, 1e-3), body)?.with_gravity();
    let mut stop = f64::NAN;
    while run.sim.time() < 1.5 {
        run.sim.step()?;
        if stop.is_nan() && run.contacts().iter().any(|contact| contact.sticks) && run.sim.time() > 0.5 {
            stop = run.sim.time();
        }
    }
    let path = Vec3::new(run.position().x, run.position().y, 0.0);
    let heading = libm::atan2(path.y, path.x);
    Ok(vec![
        Row::relative("distance", "m", SPEED * SPEED / (2.0 * MU * G), path.norm(), 1e-3),
        Row::relative("time until a point sticks", "s", SPEED / (MU * G), stop, 2e-3),
        Row::absolute("heading", "rad", libm::atan2(0.8, 0.6), heading, 1e-9),
        Row::below("speed after 1.5 s", "m/s", run.velocity().norm(), 1e-9),
    ])
}
