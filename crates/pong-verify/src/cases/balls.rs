//! V6: elastic balls conserve energy.

use crate::case::{Case, Outcome};
use crate::row::Row;
use crate::scene::{G, Scene};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Simulation, Vec3};

pub const V6: Case = Case {
    id: "V6",
    title: "Elastic bouncing balls",
    set_up: "49 balls of 10 kg and radius 0.1 m fall from 1 to 5 m onto 1e5 N/m, no friction, no damping, 20 s, \
             Runge-Kutta at ω·dt = 0.02. Energies are relative to that of the \
             fall.",
    source: "kinetic + potential + stored energy of every ball is constant (set-up of ETH SimBenchmark's bouncing \
             balls). A spring that sets in at half a step gives 1/12 of k·v·dt² as impulse instead of 1/8, the worst \
             phase: (ω·dt)²/12 of the energy at touch and at release",
    rows,
};

const MASS: f64 = 10.0;
const RADIUS: f64 = 0.1;
const STIFFNESS: f64 = 1e5;
/// Phase of one step, ω·dt, rad.
const TURN: f64 = 0.02;
const DURATION: f64 = 20.0;

/// Bounces of a ball so far.
#[derive(Default)]
struct Watch {
    /// Energy in the flight before the present contact, J.
    before: f64,
    touching: bool,
    /// Relative gain of every bounce.
    gains: Vec<f64>,
}

fn rows() -> Outcome {
    let mut scene = Scene::new(false);
    let ground = scene.add("ground", "ground")?;
    let mut balls = Vec::new();
    for i in 0..49 {
        let ball = scene.add("ball_rough", &format!("ball{i}"))?;
        scene.pair(ball, ground)?;
        balls.push(scene.root(ball)?);
    }
    let ground = scene.root(ground)?;
    scene.tune("ball_rough", |s| s.stiffness = STIFFNESS)?;
    let step = TURN / (STIFFNESS / MASS).sqrt();
    let mut sim = Simulation::new(scene.seal()?, Integrator::RungeKutta4, step)?;
    sim.set_gravity(Vec3::new(0.0, 0.0, -G));
    sim.add_body(RigidBody::fixed("ground").touching(ground))?;
    let mut bodies = Vec::new();
    for (i, interface) in balls.into_iter().enumerate() {
        let (row, column) = ((i / 7) as f64, (i % 7) as f64);
        let position = Vec3::new(column, row, RADIUS + 1.0 + 4.0 * i as f64 / 48.0);
        let ball = RigidBody::free("ball", MassProperties::sphere(MASS, RADIUS))
            .at(Pose { position, ..Pose::identity() });
        bodies.push(sim.add_body(ball.touching(interface))?);
    }
    let energy = |sim: &Simulation, i: usize| {
        let z = sim.pose(bodies[i]).position.z - RADIUS;
        let depth = (-z).max(0.0);
        let speed = sim.twist(bodies[i]).linear.norm();
        (z, 0.5 * MASS * speed * speed + MASS * G * z + 0.5 * STIFFNESS * depth * depth)
    };
    let starts: Vec<f64> = (0..49).map(|i| energy(&sim, i).1).collect();
    let mut watches: Vec<Watch> = starts.iter().map(|&before| Watch { before, ..Watch::default() }).collect();
    for _ in 0..libm::round(DURATION / step) as u64 {
        sim.step()?;
        for (i, watch) in watches.iter_mut().enumerate() {
            let (z, now) = energy(&sim, i);
            if z > 0.0 && watch.touching {
                watch.gains.push((now - watch.before) / starts[i]);
                watch.before = now;
            }
            watch.touching = z <= 0.0;
        }
    }
    let gains: Vec<f64> = watches.iter().flat_map(|watch| watch.gains.iter().copied()).collect();
    let worst = gains.iter().map(|gain| gain.abs()).fold(0.0, f64::max);
    let squares: f64 = gains.iter().map(|gain| gain * gain).sum();
    let usual = (squares / gains.len() as f64).sqrt();
    let drift = gains.iter().sum::<f64>() / gains.len() as f64;
    let end: f64 = (0..49).map(|i| energy(&sim, i).1).sum::<f64>() / starts.iter().sum::<f64>() - 1.0;
    Ok(vec![
        Row::below(
            format!("energy change of a bounce, root mean square of {}", gains.len()),
            "",
            usual,
            2e-5,
        ),
        Row::below("energy change of a bounce, worst", "", worst, TURN * TURN / 6.0),
        Row::below("energy drift per bounce, mean", "", drift.abs(), 1e-6),
        Row::below("energy change of all balls in 20 s", "", end.abs(), 2e-5),
    ])
}
