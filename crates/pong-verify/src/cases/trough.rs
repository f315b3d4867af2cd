//! W6: a ball in a trough of two walls of one surface.

use crate::case::{Case, Outcome};
use crate::row::Row;
use crate::scene::{Duo, G, at, set_spring};
use pong_executive::{Integrator, MassProperties, RigidBody, Vec3};

pub const W6: Case = Case {
    id: "W6",
    title: "Sphere in a trough",
    set_up: "A rigid ball of 1 kg and radius 0.1 m at rest in troughs of triangles with 60°, 90° and 120° between the \
             walls, 1e5 N/m each.",
    source: "walls at up to 90° push with their whole springs: N = mg/(2·sin β), β half the angle; wider ones share one \
             spring where their normals agree: the ball sinks by mg/k",
    rows,
};

const MASS: f64 = 1.0;
const RADIUS: f64 = 0.1;
const STIFFNESS: f64 = 1e5;

fn rows() -> Outcome {
    let mut rows = Vec::new();
    for degrees in [60.0, 90.0, 120.0_f64] {
        let duo = Duo::new(&format!("trough_{degrees}"), "ball_rough")?
            .mover(|s| set_spring(s, STIFFNESS, 400.0))?;
        let sine = libm::sin(crate::measure::radians(0.5 * degrees));
        let touch = RADIUS / sine;
        let ball = RigidBody::free("ball", MassProperties::sphere(MASS, RADIUS)).at(at(Vec3::z() * touch));
        let fixed = RigidBody::fixed("trough");
        let mut run = duo.simulate((Integrator::RungeKutta4, 5e-4), fixed, ball)?.with_gravity();
        run.sim.run_for(1.0)?;
        let weight = MASS * G;
        let depth =
            if degrees <= 90.0 { weight / (2.0 * STIFFNESS * sine) } else { weight * sine / STIFFNESS };
        let contacts = run.contacts();
        rows.push(Row::count(format!("{degrees}°: contacts"), 2, contacts.len()));
        let deepest = contacts.iter().map(|c| c.depth).fold(0.0, f64::max);
        rows.push(Row::relative(format!("{degrees}°: depth in each wall"), "m", depth, deepest, 1e-9));
        let sunk = touch - run.sim.pose(run.ground).position.z;
        rows.push(Row::relative(format!("{degrees}°: way down from touch"), "m", depth / sine, sunk, 1e-9));
        let force = run.sim.contact_wrench(run.ground).force.z;
        rows.push(Row::relative(format!("{degrees}°: force on the ball"), "N", weight, force, 1e-9));
    }
    Ok(rows)
}
