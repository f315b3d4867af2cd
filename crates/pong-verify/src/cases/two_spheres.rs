//! V7 and W8: two spheres in free space.

use super::bounce::clamped_restitution;
use crate::case::{Case, Failure, Outcome};
use crate::measure::order;
use crate::row::Row;
use crate::scene::{Bristle, Scene, at, set_bristle, set_damping};
use pong_executive::{BodyId, Integrator, MassProperties, RigidBody, Simulation, Twist, Vec3};

pub const V7: Case = Case {
    id: "V7",
    title: "Two colliding spheres",
    set_up: "Two balls of 100 kg and radius 1 m, centres 12 m apart, closing at 2 m/s, pair stiffness 3502.5367 N/m, \
             pair damping 70.0507 N·s/m, Runge-Kutta, dt 1e-4 s.",
    source: "set-up of NASA JEOD's contact verification; touch at 10 m/2 m/s; depth (v/ω)·exp(−(ζ/s)·atan(s/ζ)); e as \
             in V3 with the reduced mass 50 kg",
    rows: head_on,
};

pub const W8: Case = Case {
    id: "W8",
    title: "Oblique collision of two rough spheres",
    set_up: "As V7, 0.7 m off centre, with friction 0.3 and spin.",
    source: "sums of momentum and of angular momentum about a fixed point stay what they were",
    rows: oblique,
};

const MASS: f64 = 100.0;
const REDUCED: f64 = 50.0;
const STIFFNESS: f64 = 3502.5367;
const DAMPING: f64 = 70.0507;

struct Pair {
    sim: Simulation,
    balls: [BodyId; 2],
}

/// Two balls on the x axis, the second `aside` off it.
fn pair(file: &str, step: f64, aside: f64, spins: [Vec3; 2]) -> Result<Pair, Failure> {
    let mut scene = Scene::new(false);
    let objects = [scene.add(file, "first")?, scene.add(file, "second")?];
    scene.pair(objects[0], objects[1])?;
    scene.tune(file, |s| {
        // Two equal springs in series halve the stiffness, and each has half of the closing speed.
        s.stiffness = 2.0 * STIFFNESS;
        set_damping(s, 2.0 * DAMPING);
        if file == "ball_large_rough" {
            set_bristle(s, &Bristle { mu: 0.3, excess: 0.2, stiffness: 4000.0, damping: 100.0 });
        }
    })?;
    let interfaces = [scene.root(objects[0])?, scene.root(objects[1])?];
    let mut sim = Simulation::new(scene.seal()?, Integrator::RungeKutta4, step)?;
    let mut add = |i: usize| {
        let side = [-1.0, 1.0][i];
        let ball = RigidBody::free(["first", "second"][i], MassProperties::principal(MASS, [40.0; 3]))
            .at(at(Vec3::new(6.0 * side, [0.0, aside][i], 0.0)))
            .moving(Twist { linear: Vec3::x() * -side, angular: spins[i] });
        sim.add_body(ball.touching(interfaces[i]))
    };
    let balls = [add(0)?, add(1)?];
    Ok(Pair { sim, balls })
}

/// Head-on collision: largest depth by a fit through the last points, and contact duration.
fn head_on() -> Outcome {
    let Pair { mut sim, balls } = pair("ball", 1e-4, 0.0, [Vec3::zeros(); 2])?;
    let (mut touch, mut deepest) = (f64::NAN, 0.0_f64);
    while sim.time() < 6.0 {
        sim.step()?;
        if let [contact] = sim.world().contacts().as_slice() {
            if touch.is_nan() {
                touch = sim.time() - contact.depth / contact.depth_rate;
            }
            deepest = deepest.max(contact.depth);
        }
    }
    let omega = (STIFFNESS / REDUCED).sqrt();
    let zeta = DAMPING / (2.0 * (STIFFNESS * REDUCED).sqrt());
    let s = (1.0 - zeta * zeta).sqrt();
    let depth = 2.0 / omega * libm::exp(-(zeta / s) * libm::atan2(s, zeta));
    let e = clamped_restitution(zeta);
    let speeds = balls.map(|ball| sim.twist(ball).linear.x);
    Ok(vec![
        Row::relative("time of touch", "s", 5.0, touch, 1e-4),
        Row::relative("largest depth", "m", depth, deepest, 1e-4),
        Row::absolute("e", "", e, (speeds[1] - speeds[0]) / 2.0, 1e-4),
        Row::absolute("velocity of the first ball after", "m/s", -e, speeds[0], 1e-4),
        Row::below("sum of momenta", "kg·m/s", MASS * (speeds[0] + speeds[1]), 1e-12 * MASS),
    ])
}

fn oblique() -> Outcome {
    let spins = [Vec3::new(0.3, -0.2, 0.5), Vec3::new(0.1, 0.4, -0.6)];
    let momenta = |pair: &Pair| {
        let mut linear = Vec3::zeros();
        let mut angular = Vec3::zeros();
        for ball in pair.balls {
            let velocity = pair.sim.twist(ball).linear;
            linear += velocity * MASS;
            angular +=
                pair.sim.pose(ball).position.cross(&velocity) * MASS + pair.sim.twist(ball).angular * 40.0;
        }
        (linear, angular)
    };
    let run = |step: f64| {
        let mut pair = pair("ball_large_rough", step, 0.7, spins)?;
        let before = momenta(&pair);
        pair.sim.run_for(6.0)?;
        let after = momenta(&pair);
        let moved = pair.sim.twist(pair.balls[0]).linear - Vec3::x();
        Ok::<_, Failure>(((after.0 - before.0).norm(), (after.1 - before.1).norm(), moved.norm()))
    };
    let (coarse, fine) = (run(2e-3)?, run(1e-3)?);
    // The method conserves the angular momentum of position × velocity only to its order.
    Ok(vec![
        Row::below("change of the sum of momenta", "kg·m/s", fine.0, 1e-12 * MASS),
        Row::below("change of the sum of angular momenta", "kg·m²/s", fine.1, 1e-9 * MASS)
            .with_order(order(coarse.1, fine.1)),
        Row::count("the collision turned the balls (1 = yes)", 1, usize::from(fine.2 > 0.5)),
    ])
}
