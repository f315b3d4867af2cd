//! Bodies without contact: closed forms of rigid-body mechanics.

use crate::common::empty_world;
use pong_executive::{Integrator, MassProperties, Mat3, Pose, Quat, RigidBody, Simulation, Twist, Vec3};

fn spinning(angular: Vec3) -> Twist {
    Twist { linear: Vec3::zeros(), angular }
}

fn tumbler(integrator: Integrator, step: f64, disturbance: f64) -> (Simulation, pong_executive::BodyId) {
    let mut simulation = Simulation::new(empty_world(), integrator, step).unwrap();
    let body = RigidBody::free("tumbler", MassProperties::principal(1.0, [1.0, 2.0, 3.0]));
    let body = simulation.add_body(body.moving(spinning(Vec3::new(disturbance, 1.0, 0.0)))).unwrap();
    (simulation, body)
}

/// Angular velocity along the body's axes; ω₁ grows as exp(λt) from a small disturbance along the growing
/// direction.
fn body_spin(simulation: &Simulation, body: pong_executive::BodyId) -> Vec3 {
    simulation.pose(body).orientation.inverse() * simulation.twist(body).angular
}

#[test]
fn v24_rotation_about_the_middle_axis_grows_at_its_rate() {
    // I₁ω̇₁ = (I₂ − I₃)ω₂ω₃, I₃ω̇₃ = (I₁ − I₂)ω₁ω₂: λ = √((I₃ − I₂)(I₂ − I₁)/(I₁I₃))·ω₂ = 1/√3.
    let rate = 1.0 / 3.0_f64.sqrt();
    let (mut simulation, body) = tumbler(Integrator::RungeKutta4, 1e-3, 1e-7);
    simulation.run_for(8.0).unwrap();
    let early = body_spin(&simulation, body).x;
    simulation.run_for(4.0).unwrap();
    let late = body_spin(&simulation, body).x;
    // cosh(λ·12)/cosh(λ·8), because the disturbance has both the growing and the decaying part.
    let expected = (12.0 * rate).cosh() / (8.0 * rate).cosh();
    assert!((late / early / expected - 1.0).abs() < 1e-8, "{} against {expected}", late / early);
    let measured = (late / early * (1.0 + (-16.0 * rate).exp()) / (1.0 + (-24.0 * rate).exp())).ln() / 4.0;
    assert!((measured - 0.577350).abs() < 1e-6, "growth rate {measured}");
}

#[test]
fn v24_energy_and_momentum_are_kept_through_many_flips() {
    let (mut simulation, body) = tumbler(Integrator::RungeKutta4, 1e-3, 1e-3);
    let before = (simulation.energy().kinetic, simulation.angular_momentum(body).unwrap());
    let mut least = 1.0_f64;
    for _ in 0..100_000 {
        simulation.step().unwrap();
        least = least.min(body_spin(&simulation, body).y);
    }
    assert!(least < -0.99, "it flips: {least}");
    let twist = simulation.twist(body);
    let orientation = simulation.pose(body).orientation;
    let inertia = Mat3::from_diagonal(&Vec3::new(1.0, 2.0, 3.0));
    let momentum = orientation * (inertia * (orientation.inverse() * twist.angular));
    assert!((simulation.energy().kinetic / before.0 - 1.0).abs() < 1e-9);
    assert!((momentum - before.1).norm() / before.1.norm() < 1e-9);
    assert!((orientation.norm() - 1.0).abs() < 1e-15);
}

#[test]
fn runge_kutta_turns_a_body_to_fourth_order() {
    let end = |step| {
        let (mut simulation, body) = tumbler(Integrator::RungeKutta4, step, 0.3);
        simulation.run_for(4.0).unwrap();
        simulation.pose(body).orientation
    };
    let exact: Quat = end(1.0 / 2048.0);
    let error = |step| exact.angle_to(&end(step));
    let order = (error(1.0 / 16.0) / error(1.0 / 32.0)).log2();
    assert!((order - 4.0).abs() < 0.2, "order {order}");
}

#[test]
fn semi_implicit_euler_turns_a_body_to_first_order() {
    let end = |integrator, step| {
        let (mut simulation, body) = tumbler(integrator, step, 0.3);
        simulation.run_for(4.0).unwrap();
        simulation.pose(body).orientation
    };
    let exact: Quat = end(Integrator::RungeKutta4, 1.0 / 2048.0);
    let error = |step| exact.angle_to(&end(Integrator::SemiImplicitEuler, step));
    let order = (error(1.0 / 256.0) / error(1.0 / 512.0)).log2();
    assert!((order - 1.0).abs() < 0.1, "order {order}");
}

#[test]
fn a_projectile_flies_its_parabola_wherever_its_group_frame_sits() {
    for integrator in [Integrator::RungeKutta4, Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 }] {
        let mut simulation = Simulation::new(empty_world(), integrator, 0.01).unwrap();
        let gravity = Vec3::new(0.0, 0.0, -9.81);
        simulation.set_gravity(gravity);
        let mass = MassProperties::cuboid(3.0, [0.2, 0.4, 0.6]).with_mass_center(Vec3::new(0.5, -0.2, 0.1));
        let twist = Twist { linear: Vec3::new(3.0, 0.0, 8.0), angular: Vec3::new(0.2, 1.0, -0.4) };
        let body = simulation.add_body(RigidBody::free("shot", mass).moving(twist)).unwrap();
        let (place, velocity) = simulation.mass_center(body).unwrap();
        assert!((velocity - twist.at(&mass.mass_center)).norm() < 1e-15);
        let energy = simulation.energy().balance();
        simulation.run_for(2.0).unwrap();
        let expected = place + velocity * 2.0 + gravity * 2.0;
        assert!((simulation.mass_center(body).unwrap().0 - expected).norm() < 1e-12);
        assert!((simulation.energy().balance() / energy - 1.0).abs() < 1e-9);
        let (pose, twist) = (simulation.pose(body), simulation.twist(body));
        let arm = pose.orientation * mass.mass_center;
        assert!((pose.position + arm - expected).norm() < 1e-12);
        assert!((twist.at(&arm) - (velocity + gravity * 2.0)).norm() < 1e-12);
    }
}

#[test]
fn semi_implicit_euler_falls_by_its_own_closed_form() {
    // v_n = −n·g·h, x_n = −g·h²·n(n+1)/2.
    let mut simulation = Simulation::new(empty_world(), Integrator::SemiImplicitEuler, 0.01).unwrap();
    simulation.set_gravity(Vec3::new(0.0, 0.0, -9.81));
    let body = simulation.add_body(RigidBody::free("ball", MassProperties::sphere(1.0, 0.1))).unwrap();
    simulation.run_for(1.0).unwrap();
    assert!((simulation.pose(body).position.z + 9.81 * 1e-4 * 5050.0).abs() < 1e-13);
    assert!((simulation.time() - 1.0).abs() < 1e-15);
}

#[test]
fn far_away_and_fast_a_body_falls_as_at_home() {
    let drop_from = |position: Vec3, linear: Vec3| {
        let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, 1e-3).unwrap();
        simulation.set_gravity(Vec3::new(0.0, 0.0, -1e-3));
        let pose = Pose { position, orientation: Quat::identity() };
        let mass = MassProperties::sphere(2.0, 1.0).with_mass_center(Vec3::new(0.3, 0.0, 0.0));
        let twist = Twist { linear, angular: Vec3::new(0.0, 0.01, 0.0) };
        let body = simulation.add_body(RigidBody::free("ship", mass).at(pose).moving(twist)).unwrap();
        simulation.run_for(10.0).unwrap();
        simulation.pose(body).position - position - linear * 10.0
    };
    let home = drop_from(Vec3::zeros(), Vec3::zeros());
    let far = drop_from(Vec3::new(0.0, 0.0, 6.8e6), Vec3::new(7.7e3, 0.0, 0.0));
    // After ten thousand steps, at most the rounding of the last position.
    assert!((far - home).norm() < 2e-9, "{}", (far - home).norm());
}
