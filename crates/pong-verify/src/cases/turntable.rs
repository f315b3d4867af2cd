//! W14: a ball on a turntable.

use super::rolling::{MASS, RADIUS};
use crate::case::{Case, Outcome};
use crate::measure::Crossings;
use crate::row::Row;
use crate::scene::{Bristle, Duo, G, at, set_spring, with_friction};
use pong_executive::{Integrator, MassProperties, Path, Pose, RigidBody, Twist, Vec3};

pub const W14: Case = Case {
    id: "W14",
    title: "Ball rolling on a turntable",
    set_up: "The ball of V11 rolls on a plane that turns at 2 rad/s, from 0.3 m off the axis at 0.1 m/s, once round its \
             own circle, Runge-Kutta, dt 1e-3 s.",
    source: "J. A. Burns, Am. J. Phys. 49 (1981): the centre of a solid ball runs on a circle with 2/7 of the table's \
             speed of turning, v̇ = (2/7)·Ω × v",
    rows,
};

const TURNING: f64 = 2.0;
const SPEED: f64 = 0.1;

fn rows() -> Outcome {
    let stiffness = 1e5;
    let bristle = Bristle { mu: 0.5, excess: 0.0, stiffness: 6e4, damping: 260.0 };
    let duo = with_friction(Duo::new("ground_rough", "ball_rough")?, &bristle)?
        .mover(|s| set_spring(s, stiffness, 440.0))?;
    let twist = Twist { linear: Vec3::zeros(), angular: Vec3::z() * TURNING };
    let table = RigidBody::prescribed("table", Path::ConstantTwist { pose: Pose::identity(), twist });
    let start = Vec3::new(0.3, 0.0, RADIUS - MASS * G / stiffness);
    // Its lowest point moves with the table: v − R·(ω_y, −ω_x) = Ω·(−y, x).
    let spin = Vec3::new(TURNING * start.x / RADIUS, SPEED / RADIUS, 0.0);
    let ball = RigidBody::free("ball", MassProperties::sphere(MASS, RADIUS))
        .at(at(start))
        .moving(Twist { linear: Vec3::x() * SPEED, angular: spin });
    let mut run = duo.simulate((Integrator::RungeKutta4, 1e-3), table, ball)?.with_gravity();
    let rate = 2.0 / 7.0 * TURNING;
    let period = core::f64::consts::TAU / rate;
    let mut crossings = Crossings::default();
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut home = Vec3::zeros();
    while crossings.times.len() < 2 && run.sim.time() < 3.0 * period {
        run.sim.step()?;
        let (place, velocity) = (run.sim.pose(run.ground).position, run.sim.twist(run.ground).linear);
        let force = run.sim.contact_wrench(run.ground).force;
        crossings.push(run.sim.time(), velocity.y, force.y / MASS);
        (least, most) = (least.min(place.y), most.max(place.y));
        if (run.sim.time() - period).abs() < 5e-4 {
            home = place + velocity * (period - run.sim.time());
        }
    }
    Ok(vec![
        Row::relative("period of the circle", "s", period, crossings.period(), 1e-4),
        Row::relative("diameter of the circle", "m", 2.0 * SPEED / rate, most - least, 1e-4),
        Row::below("way from the start after one period", "m", (home - start).norm(), 1e-4),
    ])
}
