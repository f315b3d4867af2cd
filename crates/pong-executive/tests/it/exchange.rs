//! An external integrator, given only the rates, arrives at the executive's states.

use crate::common;
use pong_executive::{BodyId, Integrator, MassProperties, RigidBody, Simulation, Twist, Vec3, Wrench};

/// A rough ball that falls, rotating, onto a rough ground 0.1 mm below it.
fn ball() -> (Simulation, BodyId) {
    let text = r#"(format: "pong-scene", version: 1, name: "ball",
        models: { "ball": "ball.ron", "ground": "ground.ron" },
        objects: [
            (name: "ball", model: "ball", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 5e-3, 6e-3),
                mass_center: (0.01, 0.0, 0.02), position: (0.0, 0.0, 0.1001), angular_velocity: (3.0, 8.0, 1.0))]),
            (name: "ground", model: "ground", bodies: [(motion: Fixed)]),
        ],
        pairs: [("ball", "ground")],
        gravity: (0.0, 0.0, -9.81), integrator: RungeKutta4, step: 1e-4, duration: 0.1)"#;
    let simulation = common::simulation_of_balls(text);
    let ball = simulation.bodies().next().unwrap().0;
    (simulation, ball)
}

/// Classic Runge-Kutta on the numbers, quaternions by component; each step is accepted.
fn run_outside(simulation: &mut Simulation, h: f64, steps: u32) -> Vec<f64> {
    let mut x = simulation.state_numbers();
    let mut k = vec![vec![0.0; x.len()]; 4];
    simulation.accept_states(0.0, &x, &mut k[0]).unwrap();
    for step in 0..steps {
        let t = f64::from(step) * h;
        for (stage, share) in [(1, 0.5), (2, 0.5), (3, 1.0)] {
            let trial: Vec<f64> = x.iter().zip(&k[stage - 1]).map(|(x, k)| x + share * h * k).collect();
            simulation.try_states(t + share * h, &trial, &mut k[stage]).unwrap();
        }
        for (i, x) in x.iter_mut().enumerate() {
            *x += h / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
        }
        let (first, _) = k.split_first_mut().unwrap();
        simulation.accept_states(t + h, &x, first).unwrap();
    }
    x
}

#[test]
fn runge_kutta_outside_gets_where_the_executive_gets() {
    let (mut inside, body) = ball();
    inside.run_for(0.1).unwrap();
    let (mut outside, _) = ball();
    run_outside(&mut outside, 1e-4, 1000);
    assert!(outside.world().contact_count() == 1 && outside.contact_wrench(body).force.x.abs() > 0.1);
    let apart = (inside.pose(body).position - outside.pose(body).position).norm();
    let turned = inside.pose(body).orientation.angle_to(&outside.pose(body).orientation);
    // Quaternions integrated by component have another angle at half a step: (ωh)³/96 for each stage that
    // pushes.
    assert!(apart < 1e-9 && turned < 1e-8, "{apart} m, {turned} rad");
}

#[test]
fn trials_change_nothing() {
    let (mut simulation, _) = ball();
    let x = run_outside(&mut simulation, 1e-4, 500);
    let mut rates = vec![0.0; x.len()];
    simulation.accept_states(0.05, &x, &mut rates).unwrap();
    let mut before = Vec::new();
    simulation.world().save_state_packed(&mut before);
    let mut elsewhere = x.clone();
    elsewhere[0] += 0.3;
    elsewhere[2] -= 1e-3;
    for time in [0.2, 0.01] {
        simulation.try_states(time, &elsewhere, &mut vec![0.0; x.len()]).unwrap();
    }
    let mut after = Vec::new();
    simulation.world().save_state_packed(&mut after);
    assert_eq!(before, after);
}

#[test]
fn a_body_that_no_wrench_acts_on_keeps_its_rates() {
    let mut simulation = Simulation::new(common::empty_world(), Integrator::RungeKutta4, 1e-3).unwrap();
    let mass = MassProperties::principal(2.0, [1.0, 1.5, 2.0]).with_mass_center(Vec3::new(0.1, 0.0, 0.0));
    let twist = Twist { linear: Vec3::new(1.0, 0.0, 0.0), angular: Vec3::new(0.0, 0.0, 2.0) };
    let body = simulation.add_body(RigidBody::free("body", mass).moving(twist)).unwrap();
    let x = simulation.state_numbers();
    let mut rates = vec![0.0; x.len()];
    simulation.try_states(0.0, &x, &mut rates).unwrap();
    // The mass centre is 0.1 m along x: it moves on with v + ω × c; q' = ½·(0, ω)·(1, 0, 0, 0).
    assert_eq!(x[..6], [0.1, 0.0, 0.0, 1.0, 0.2, 0.0]);
    assert_eq!(rates, [1.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    // A force at the group's origin rotates the body about its mass centre: −c × F.
    let push = Wrench { force: Vec3::new(0.0, 4.0, 0.0), moment: Vec3::zeros() };
    simulation.set_external_wrench(body, push).unwrap();
    simulation.try_states(0.0, &x, &mut rates).unwrap();
    assert_eq!(rates[3..6], [0.0, 2.0, 0.0]);
    assert!((rates[12] + 0.4).abs() < 1e-15);
}

#[test]
fn numbers_that_fit_nothing_are_refused() {
    let (mut simulation, _) = ball();
    let x = simulation.state_numbers();
    let told = simulation.try_states(0.0, &x[1..], &mut [0.0; 13]).unwrap_err().to_string();
    assert!(told.contains("12 states"), "{told}");
    for (place, value) in [(0, f64::NAN), (7, f64::INFINITY)] {
        let mut bad = x.clone();
        bad[place] = value;
        let told = simulation.accept_states(0.0, &bad, &mut [0.0; 13]).unwrap_err().to_string();
        assert!(told.contains("no longer finite"), "{told}");
    }
    let mut none = x;
    none[6..10].fill(0.0);
    assert!(simulation.try_states(0.0, &none, &mut [0.0; 13]).is_err());
}
