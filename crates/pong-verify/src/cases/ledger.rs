//! W11: energy balance: kinetic + potential + stored + dissipated is constant.

use super::bounce::clamped_restitution;
use crate::case::{Case, Failure, Outcome};
use crate::measure::order;
use crate::row::Row;
use crate::scene::{Bristle, Duo, G, at, moving, point_mass, set_damping, set_spring, with_friction};
use pong_executive::{Integrator, Load, MassProperties, RigidBody, Vec3};

pub const W11: Case = Case {
    id: "W11",
    title: "Energy ledger",
    set_up: "A block on four damped points slides at 1 m/s and heaves, μ = 0.3, 0.2 s, Runge-Kutta; error of the balance \
             over the initial energy. A point mass held by friction under a pull, and one that bounces.",
    source: "kinetic + potential + stored + dissipated = constant; the engine's ledger integrates work between commits by the \
             trapezoid rule, the run by what the stages gave. Stored ½·N²/k + ½·F²/k_t; a bounce takes ½·m·v²·(1 − e²)",
    rows,
};

const MASS: f64 = 1.0;

/// Largest error of the balance by the engine's ledger and by the run's own sum, and the heat at the end, J.
fn balance(step: f64) -> Result<[f64; 3], Failure> {
    let bristle = Bristle { mu: 0.3, excess: 0.0, stiffness: 6e4, damping: 120.0 };
    let duo = Duo::with_ledger("block_rough", "ground_rough", true)?.mover(|s| set_damping(s, 40.0))?;
    let rest = 0.05 - MASS * G / 4e5;
    let body = RigidBody::free("block", MassProperties::cuboid(MASS, [0.2, 0.2, 0.1]))
        .at(at(Vec3::z() * (rest - 2e-5)))
        .moving(moving(Vec3::x()));
    let mut run =
        with_friction(duo, &bristle)?.on_ground((Integrator::RungeKutta4, step), body)?.with_gravity();
    run.sim.commit_initial_states()?;
    let balances = |run: &crate::scene::Run| {
        let energy = run.sim.energy();
        [energy.mechanical() + run.sim.world().ledger().dissipated, energy.balance()]
    };
    let start = balances(&run);
    let mut worst = [0.0_f64; 2];
    for _ in 0..libm::round(0.2 / step) as u64 {
        run.sim.step()?;
        for (worst, (now, start)) in worst.iter_mut().zip(balances(&run).iter().zip(&start)) {
            *worst = worst.max((now - start).abs());
        }
    }
    Ok([worst[0], worst[1], run.sim.energy().contact_loss])
}

fn rows() -> Outcome {
    let ([coarse, ..], [fine, ..]) = (balance(1e-4)?, balance(5e-5)?);
    let [error, of_run, heat] = balance(1e-5)?;
    // Friction takes μ·m·g over the path 1·t − ½·μ·g·t², less the energy for the bristle's break-away.
    let way = 0.2 - 0.5 * 0.3 * G * 0.04;
    let friction = 0.3 * MASS * G * way;
    Ok(vec![
        Row::below("error of the balance over ½mv², work between commits", "", error / 0.5, 1e-6)
            .with_order(order(coarse, fine)),
        Row::below("error of the balance over ½mv², work by stages", "", of_run / 0.5, 1e-9),
        Row::relative("dissipated by friction and damping", "J", friction, heat, 1e-3),
        held()?,
        bounced()?,
    ])
}

/// Energy of normal spring and bristle under a pull within the friction limit.
fn held() -> Result<Row, Failure> {
    let (stiffness, pull) = (1e5, 3.0);
    let bristle = Bristle { mu: 0.5, excess: 0.0, stiffness: 6e4, damping: 400.0 };
    let duo = Duo::with_ledger("point_rough", "ground_rough", true)?.mover(|s| set_damping(s, 600.0))?;
    let mut run = with_friction(duo, &bristle)?
        .on_ground((Integrator::RungeKutta4, 1e-3), point_mass(MASS))?
        .with_gravity();
    // The pull begins once the mass is at rest.
    run.sim.add_load(Load::force_over_time(run.body, move |time| {
        Vec3::x() * (pull * (time - 0.2).clamp(0.0, 1.0))
    }))?;
    run.sim.run_for(1.6)?;
    let weight = MASS * G;
    let expected = 0.5 * (weight * weight / stiffness + pull * pull / bristle.stiffness);
    Ok(Row::relative(
        "stored under a pull that friction holds",
        "J",
        expected,
        run.sim.energy().contacts,
        1e-6,
    ))
}

/// Energy dissipated by a damped bounce.
fn bounced() -> Result<Row, Failure> {
    let (stiffness, zeta) = (1e5_f64, 0.2);
    let omega = (stiffness / MASS).sqrt();
    let duo = Duo::with_ledger("point", "ground", true)?
        .mover(|s| set_spring(s, stiffness, 2.0 * zeta * omega * MASS))?;
    let falling = point_mass(MASS).moving(moving(-Vec3::z()));
    let step = 1e-3 / omega;
    let mut run = duo.on_ground((Integrator::RungeKutta4, step), falling)?;
    run.sim.run_for(4.0 / omega)?;
    let e = clamped_restitution(zeta);
    let heat = run.sim.energy().contact_loss;
    Ok(Row::relative("dissipated by a bounce, ζ = 0.2", "J", 0.5 * MASS * (1.0 - e * e), heat, 2e-3))
}
