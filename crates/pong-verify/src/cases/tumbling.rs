//! V24: torque-free tumbling of a body. Checks the integrator, on which all other cases depend.

use crate::case::{Case, Failure, Outcome};
use crate::measure::order;
use crate::row::Row;
use crate::scene::Scene;
use pong_executive::{BodyId, Integrator, MassProperties, RigidBody, Simulation, Twist, Vec3};

pub const V24: Case = Case {
    id: "V24",
    title: "Tumbling body in free flight",
    set_up: "Principal moments 1, 2, 3 kg·m². Leaving the middle axis along the separatrix (ω₂ = tanh λt), and 60 s of \
             flips from ω₂ = 1 with ω₁ = 1e-3, Runge-Kutta, dt 1e-3 s.",
    source: "Euler's equations; λ = ω₂·√((I₂ − I₁)(I₃ − I₂)/(I₁I₃)), ω₁ = sech λt, ω₃ = λ·sech λt",
    rows,
};

fn body(spin: Vec3, step: f64) -> Result<(Simulation, BodyId), Failure> {
    let mut sim = Simulation::new(Scene::new(false).seal()?, Integrator::RungeKutta4, step)?;
    let mass = MassProperties::principal(1.0, [1.0, 2.0, 3.0]);
    let body = RigidBody::free("body", mass).moving(Twist { linear: Vec3::zeros(), angular: spin });
    let body = sim.add_body(body)?;
    Ok((sim, body))
}

/// Angular velocity along the axes of the body.
fn spin(sim: &Simulation, body: BodyId) -> Vec3 {
    sim.pose(body).orientation.inverse() * sim.twist(body).angular
}

fn rows() -> Outcome {
    let rate = 1.0 / 3.0_f64.sqrt();
    let duration = 5.0;
    let run = |step: f64| {
        let (mut sim, id) = body(Vec3::new(1.0, 0.0, rate), step)?;
        sim.run_for(duration)?;
        Ok::<_, Failure>(spin(&sim, id))
    };
    let expected =
        Vec3::new(1.0, 0.0, rate) / libm::cosh(rate * duration) + Vec3::y() * libm::tanh(rate * duration);
    let errors = [0.05, 0.025].map(|step| run(step).map(|got| (got - expected).norm()));
    let [coarse, fine] = errors;
    let got = run(1e-3)?;
    let growth = libm::acosh(1.0 / got.x) / duration;
    let mut rows = vec![
        Row::relative("growth rate", "1/s", rate, growth, 1e-9).with_order(order(coarse?, fine?)),
        Row::below("angular velocity off the closed form after 5 s", "rad/s", (got - expected).norm(), 1e-9),
    ];
    rows.extend(flips()?);
    Ok(rows)
}

fn flips() -> Result<Vec<Row>, Failure> {
    let (mut sim, id) = body(Vec3::new(1e-3, 1.0, 0.0), 1e-3)?;
    let momentum = |sim: &Simulation| {
        let spin = spin(sim, id);
        sim.pose(id).orientation * Vec3::new(spin.x, 2.0 * spin.y, 3.0 * spin.z)
    };
    let energy = |sim: &Simulation| {
        let spin = spin(sim, id);
        0.5 * (spin.x * spin.x + 2.0 * spin.y * spin.y + 3.0 * spin.z * spin.z)
    };
    let (l0, e0) = (momentum(&sim), energy(&sim));
    let (mut l_off, mut e_off, mut flips, mut side) = (0.0_f64, 0.0_f64, 0, 1.0);
    while sim.time() < 60.0 {
        sim.step()?;
        l_off = l_off.max((momentum(&sim) - l0).norm() / l0.norm());
        e_off = e_off.max((energy(&sim) / e0 - 1.0).abs());
        let about = spin(&sim, id).y;
        if about * side < -0.5 {
            (flips, side) = (flips + 1, -side);
        }
    }
    Ok(vec![
        Row::below(format!("angular momentum, worst change over {flips} flips"), "", l_off, 1e-9),
        Row::below("energy, worst change", "", e_off, 1e-9),
    ])
}
