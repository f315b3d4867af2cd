//! W9: an ellipsoid rocks on its flat side.
//!
//! Semi-axes a along, c across the plane: the mass centre is h(θ) = √(c²cos²θ + a²sin²θ) high, and the lowest
//! point is displaced by (a² − c²)/c·θ. Without friction the mass centre moves vertically and the body turns
//! about it; rolling, it turns about the lowest point, where the radius of curvature is a²/c.

use crate::case::{Case, Failure, Outcome};
use crate::measure::{Crossings, rotation};
use crate::row::Row;
use crate::scene::{Bristle, Duo, G, Run, with_friction};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Vec3};

pub const W9: Case = Case {
    id: "W9",
    title: "Rocking ellipsoid",
    set_up: "A solid ellipsoid of 2 kg with semi-axes 0.3, 0.25 and 0.2 m tilted by 1e-4 rad, without friction on 1e6 \
             N/m, and rigid, rolling on ground of 1e6 N/m with a bristle of 1e7 N/m.",
    source: "ω² = mg(a² − c²)/(cI) without friction, mg(a²/c − c)/(I + mc²) in rolling",
    rows,
};

const MASS: f64 = 2.0;
const AXES: [f64; 3] = [0.3, 0.25, 0.2];
const STIFFNESS: f64 = 1e6;
const TILT: f64 = 1e-4;

fn egg() -> RigidBody {
    let [x, y, z] = AXES.map(|a| 0.2 * MASS * a * a);
    let height = AXES[2] - MASS * G / STIFFNESS;
    RigidBody::free("egg", MassProperties::principal(MASS, [y + z, z + x, x + y]))
        .at(Pose { position: Vec3::z() * height, orientation: rotation(Vec3::y() * TILT) })
}

fn frequency(mut run: Run, egg_first: bool) -> Result<f64, Failure> {
    let body = if egg_first { run.body } else { run.ground };
    let mut crossings = Crossings::default();
    while crossings.times.len() < 6 && run.sim.time() < 20.0 {
        run.sim.step()?;
        let angle = 2.0 * run.sim.pose(body).orientation.j;
        crossings.push(run.sim.time(), angle, run.sim.twist(body).angular.y);
    }
    Ok(core::f64::consts::TAU / crossings.period())
}

fn rows() -> Outcome {
    let [a, _, c] = AXES;
    let inertia = 0.2 * MASS * (a * a + c * c);
    let smooth = Duo::new("ellipsoid", "ground")?
        .mover(|s| s.stiffness = STIFFNESS)?
        .on_ground((Integrator::RungeKutta4, 5e-4), egg())?
        .with_gravity();
    let free = (MASS * G * (a * a - c * c) / (c * inertia)).sqrt();
    let bristle = Bristle { mu: 0.5, excess: 0.0, stiffness: 1e7, damping: 5000.0 };
    let rough = with_friction(
        Duo::new("ground_rough", "ellipsoid_rough")?.mover(|s| s.stiffness = STIFFNESS)?,
        &bristle,
    )?
    .simulate((Integrator::RungeKutta4, 2e-4), RigidBody::fixed("ground"), egg())?
    .with_gravity();
    let rolling = (MASS * G * (a * a / c - c) / (inertia + MASS * c * c)).sqrt();
    Ok(vec![
        Row::relative("without friction: circular frequency", "rad/s", free, frequency(smooth, true)?, 1e-6),
        Row::relative("rolling: circular frequency", "rad/s", rolling, frequency(rough, false)?, 1e-4),
    ])
}
