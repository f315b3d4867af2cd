//! W11: the books close: kinetic + potential + stored + dissipated stays.

use crate::measure::order;
use crate::scene::{Bristle, Duo, G, rub, set_damping};
use crate::{Case, Failure, Outcome, Row};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Twist, Vec3};

pub const W11: Case = Case {
    id: "W11",
    title: "Energy ledger",
    set_up: "A block on four damped points slides at 1 m/s and heaves, μ = 0.3, 0.2 s, Runge-Kutta; error of the balance \
             over the initial energy.",
    source: "kinetic + potential + stored + dissipated = constant; the ledger integrates work by the trapezoid rule",
    rows,
};

const MASS: f64 = 1.0;

/// Largest error of the balance, and the heat at the end, J.
fn balance(step: f64) -> Result<(f64, f64), Failure> {
    let bristle = Bristle { mu: 0.3, excess: 0.0, stiffness: 6e4, damping: 120.0 };
    let duo = Duo::with_ledger("block_rough", "ground_rough", true)?.mover(|s| set_damping(s, 40.0))?;
    let rest = 0.05 - MASS * G / 4e5;
    let body = RigidBody::free("block", MassProperties::cuboid(MASS, [0.2, 0.2, 0.1]))
        .at(Pose { position: Vec3::z() * (rest - 2e-5), ..Pose::identity() })
        .moving(Twist { linear: Vec3::x(), angular: Vec3::zeros() });
    let mut run = rub(duo, &bristle)?
        .simulate((Integrator::RungeKutta4, step), body, RigidBody::fixed("ground"))?
        .with_gravity();
    run.sim.settle()?;
    let start = run.sim.energy().balance();
    let mut worst = 0.0_f64;
    for _ in 0..libm::round(0.2 / step) as u64 {
        run.sim.step()?;
        worst = worst.max((run.sim.energy().balance() - start).abs());
    }
    Ok((worst, run.sim.energy().contact_loss))
}

fn rows() -> Outcome {
    let ((coarse, _), (fine, _)) = (balance(1e-4)?, balance(5e-5)?);
    let (error, heat) = balance(1e-5)?;
    // Friction takes μ·m·g over the way 1·t − ½·μ·g·t², less what the bristle takes to break away.
    let way = 0.2 - 0.5 * 0.3 * G * 0.04;
    let friction = 0.3 * MASS * G * way;
    Ok(vec![
        Row::below("error of the balance over ½mv²", "", error / 0.5, 1e-6).with_order(order(coarse, fine)),
        Row::relative("dissipated by friction and damping", "J", friction, heat, 1e-3),
    ])
}
