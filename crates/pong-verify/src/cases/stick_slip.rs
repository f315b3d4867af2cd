//! V16, V17: one mass held by a spring on a moving belt, and held by friction for a long time.

use crate::case::{Case, Failure, Outcome};
use crate::measure::{radians, rotation};
use crate::row::Row;
use crate::scene::{Bristle, Duo, G, Run, at, moving, point_mass, set_damping, with_friction};
use pong_executive::{Integrator, Load, Path, Pose, RigidBody, Spring, SpringEnd, Vec3};

pub const V16: Case = Case {
    id: "V16",
    title: "Stick-slip on a belt",
    set_up: "1 kg pressed with 10 N on a belt at 0.1 m/s, held by 2 N/m, μ_k = 0.1, μ_s = 0.15, k_t = 1e5 N/m, \
             Runge-Kutta, dt 1e-3 s.",
    source: "first break at F_s/(kV); period 2(F_s − F_k)/(kV) + (π + 2·atan(Vk/(ω(F_s − F_k))))/ω",
    rows: belt,
};

pub const V17: Case = Case {
    id: "V17",
    title: "No drift under friction",
    set_up: "1 kg, μ = 0.5: pulled 0…80 % of break-away at 1 Hz for 10 cycles; then 3,600 s on a slope at half the \
             friction angle, semi-implicit Euler, dt 1e-3 s.",
    source: "below break-away a bristle gives way only as an elastic spring",
    rows: drift,
};

const MASS: f64 = 1.0;

fn belt() -> Outcome {
    let (press, stiffness, speed) = (10.0, 2.0, 0.1);
    let (mu_k, excess) = (0.1, 0.5);
    let bristle = Bristle { mu: mu_k, excess, stiffness: 1e5, damping: 2.0 * (1e5 * MASS).sqrt() };
    let duo = Duo::new("point_rough", "ground_rough")?.mover(|s| set_damping(s, 600.0))?;
    let along = moving(Vec3::x() * speed);
    let belt = RigidBody::prescribed("belt", Path::ConstantTwist { pose: Pose::identity(), twist: along });
    let body = point_mass(MASS).at(at(Vec3::z() * (-press / 1e5))).moving(along);
    let mut run = with_friction(duo, &bristle)?.simulate((Integrator::RungeKutta4, 1e-3), body, belt)?;
    run.sim.add_load(Load::force(run.body, Vec3::z() * -press))?;
    let pull = [stiffness, 0.0, 0.0, 0.0, 0.0, 0.0];
    let (wall, hook) = (SpringEnd::ground(Pose::identity()), SpringEnd::on(run.body, Pose::identity()));
    run.sim.add_spring(Spring::new(wall, hook, pull))?;
    let (f_s, f_k) = (press * mu_k * (1.0 + excess), press * mu_k);
    let (mut breaks, mut stretch, mut stuck) = (Vec::new(), Vec::new(), true);
    let mut largest = f64::NEG_INFINITY;
    while breaks.len() < 5 && run.sim.time() < 60.0 {
        run.sim.step()?;
        let sticks = run.contact()?.sticks;
        largest = largest.max(run.position().x);
        if stuck && !sticks {
            breaks.push(run.sim.time());
        }
        if !stuck && sticks {
            stretch.push(run.position().x);
        }
        stuck = sticks;
    }
    let [first, second, .., last] = breaks.as_slice() else {
        return Err("the mass never breaks away".into());
    };
    let omega = (stiffness / MASS).sqrt();
    let drop = f_s - f_k;
    let period = 2.0 * drop / (stiffness * speed)
        + (core::f64::consts::PI + 2.0 * libm::atan(speed * stiffness / (omega * drop))) / omega;
    // In slip the mass oscillates about F_k/k, starting from F_s/k with the speed of the belt.
    let swing = libm::hypot(drop / stiffness, speed / omega);
    Ok(vec![
        Row::relative("first break", "s", f_s / (stiffness * speed), *first, 2e-3),
        Row::relative("period", "s", period, (last - second) / (breaks.len() - 2) as f64, 2e-3),
        Row::relative("largest stretch", "m", f_k / stiffness + swing, largest, 2e-3),
        Row::relative("stretch when it sticks again", "m", (f_k - drop) / stiffness, stretch[0], 2e-3),
    ])
}

fn held(integrator: Integrator, slope: f64) -> Result<Run, Failure> {
    let bristle = Bristle { mu: 0.5, excess: 0.0, stiffness: 6e4, damping: 240.0 };
    let duo =
        with_friction(Duo::new("point_rough", "ground_rough")?.mover(|s| set_damping(s, 300.0))?, &bristle)?;
    let turn = rotation(Vec3::y() * slope);
    let ground = RigidBody::fixed("ground").at(Pose { position: Vec3::zeros(), orientation: turn });
    let depth = MASS * G * libm::cos(slope) / 1e5;
    let body = point_mass(MASS).at(Pose { position: turn * (Vec3::z() * -depth), orientation: turn });
    Ok(duo.simulate((integrator, 1e-3), body, ground)?.with_gravity())
}

fn drift() -> Outcome {
    let mut cyclic = held(Integrator::RungeKutta4, 0.0)?;
    let largest = 0.8 * 0.5 * MASS * G;
    let pull =
        move |time: f64| Vec3::x() * (0.5 * largest * (1.0 - libm::cos(core::f64::consts::TAU * time)));
    cyclic.sim.add_load(Load::force_over_time(cyclic.body, pull))?;
    let mut reached = 0.0_f64;
    for _ in 0..10_000 {
        cyclic.sim.step()?;
        reached = reached.max(cyclic.position().x);
    }
    let mut steady = held(Integrator::SemiImplicitEuler, radians(0.5 * libm::atan(0.5).to_degrees()))?;
    steady.sim.run_for(1.0)?;
    let before = steady.position();
    steady.sim.run_for(3599.0)?;
    let crept = (steady.position() - before).norm();
    Ok(vec![
        Row::relative("cyclic: largest displacement (elastic)", "m", largest / 6e4, reached, 1e-2),
        Row::below("cyclic: net slip of 10 cycles", "m", cyclic.position().x.abs(), 1e-8),
        Row::below("steady: creep in 3,599 s", "m", crept, 1e-6),
    ])
}
