//! W1: the exponent 3/2.

use crate::case::{Case, Outcome};
use crate::row::Row;
use crate::scene::{Duo, G, moving, point_mass, set_dissipation};
use pong_executive::{Integrator, RigidBody, Vec3};

pub const W1: Case = Case {
    id: "W1",
    title: "Hertz exponent 3/2",
    set_up: "1 kg on 1e7 N/m^1.5: at rest, and bouncing at 1 m/s without dissipation.",
    source: "(mg/k)^(2/3); H. Hertz (1882): δ_max = (5mv²/(4k))^(2/5), duration 2·δ_max/v·∫dx/√(1 − x^2.5) = \
             (4√π/5)·Γ(2/5)/Γ(9/10)·δ_max/v",
    rows,
};

const MASS: f64 = 1.0;
const STIFFNESS: f64 = 1e7;
const SPEED: f64 = 1.0;

fn duo(dissipation: f64) -> Result<Duo, crate::Failure> {
    Duo::new("point_hertz", "ground_hertz")?.mover(|s| {
        s.stiffness = STIFFNESS;
        set_dissipation(s, dissipation);
    })
}

fn rows() -> Outcome {
    let body = point_mass(MASS);
    let ground = || RigidBody::fixed("ground");
    // Dissipation 70 s/m damps small motion about rest near critical.
    let mut rest =
        duo(70.0)?.simulate((Integrator::RungeKutta4, 1e-3), body.clone(), ground())?.with_gravity();
    rest.sim.run_for(1.0)?;
    let falling = body.moving(moving(Vec3::z() * -SPEED));
    let mut run = duo(0.0)?.simulate((Integrator::RungeKutta4, 1e-6), falling, ground())?;
    let mut deepest = 0.0_f64;
    loop {
        run.sim.step()?;
        deepest = deepest.max(-run.position().z);
        if run.position().z > 0.0 {
            break;
        }
        if run.sim.time() > 0.1 {
            return Err("the mass does not come back".into());
        }
    }
    let depth = libm::pow(5.0 * MASS * SPEED * SPEED / (4.0 * STIFFNESS), 0.4);
    let factor = 0.8 * core::f64::consts::PI.sqrt() * libm::tgamma(0.4) / libm::tgamma(0.9);
    let touching = run.sim.time() - run.position().z / run.velocity().z;
    let still = libm::pow(MASS * G / STIFFNESS, 2.0 / 3.0);
    Ok(vec![
        Row::relative("depth at rest", "m", still, rest.contact()?.depth, 1e-9),
        Row::relative("largest depth of the bounce", "m", depth, deepest, 1e-6),
        Row::relative("duration of the bounce", "s", factor * depth / SPEED, touching, 1e-6),
        Row::relative("speed of rebound", "m/s", SPEED, run.velocity().z, 1e-9),
    ])
}
