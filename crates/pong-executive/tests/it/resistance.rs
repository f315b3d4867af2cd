//! Rolling and spinning resistance of balls and wheels moved by the executive.

use pong_engine::Config;
use pong_executive::{BodyId, Integrator, MassProperties, Pose, RigidBody, Simulation, Twist, Vec3};
use pong_testkit::worlds::paired_with_first;

const G: f64 = 9.81;
const RADIUS: f64 = 0.1;
const MASS: f64 = 2.0;
/// Depth at rest, m: weight over stiffness.
const DEPTH: f64 = MASS * G / 1e6;

const BALL: &str = "Sphere(name: \"ball\", center: (0, 0, 0), radius: 0.1)";
const WHEEL: &str = "Cylinder(name: \"wheel\", ends: ((0, -0.05, 0), (0, 0.05, 0)), radius: 0.1)";

/// Body of a primitive that rests on the plane z = 0; `ground` is the friction of the rigid plane.
fn at_rest(primitive: &str, friction: &str, ground: &str, inertia: f64) -> (Simulation, BodyId) {
    let body = format!(
        r#"(format: "pong-model", version: 1, name: "body",
            surfaces: {{ "s": (stiffness: 1e6, normal: Linear(damping: 2000), friction: {friction}) }},
            root: (name: "body", surface: "s", primitives: [{primitive}]))"#
    );
    let plane = format!(
        r#"(format: "pong-model", version: 1, name: "plane", surfaces: {{ "s": (stiffness: inf{ground}) }},
            root: (name: "plane", surface: "s", primitives: [
                Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#
    );
    let integrator = Integrator::RungeKutta4;
    let config = Config { accounts: integrator.wrench_coupling(), ledger: true, ..Config::default() };
    let (world, _, interfaces) = paired_with_first(config, &[&body, &plane]);
    let mut simulation = Simulation::new(world, integrator, 2e-4).unwrap();
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    let mass = MassProperties::principal(MASS, [inertia; 3]);
    let pose = Pose::new(Vec3::new(0.0, 0.0, RADIUS - DEPTH), [1.0, 0.0, 0.0, 0.0]);
    let body = RigidBody::free("body", mass).at(pose).touching(interfaces[0]);
    let body = simulation.add_body(body).unwrap();
    simulation.add_body(RigidBody::fixed("plane").touching(interfaces[1])).unwrap();
    (simulation, body)
}

/// Sets a body rolling without slip along x.
fn roll(simulation: &mut Simulation, body: BodyId, speed: f64) {
    let angular = Vec3::new(0.0, speed / (RADIUS - DEPTH), 0.0);
    let pose = simulation.pose(body);
    let twist = Twist { linear: Vec3::new(speed, 0.0, 0.0), angular };
    simulation.set_motion(body, pose, twist).unwrap();
}

/// Turns gravity as on a slope of the given tangent that falls towards +x, with the same weight on the plane.
fn tilt(simulation: &mut Simulation, tangent: f64) {
    simulation.set_gravity(Vec3::new(tangent * G, 0.0, -G));
}

/// A rolling body slows by b·g/(r·(1 + I/(m·r²))), whichever of the two surfaces has the length.
#[test]
fn rolling_bodies_slow_by_the_length_over_the_radius() {
    let (length, inertia) = (2e-3, 0.4 * MASS * RADIUS * RADIUS);
    let plain = "Bristle(mu: 0.5)";
    let resisting = "Bristle(mu: 0.5, rolling: 2e-3)";
    for (primitive, friction, ground) in [
        (BALL, resisting, ""),
        (WHEEL, resisting, ""),
        (BALL, plain, ", friction: Bristle(mu: 0.5, rolling: 2e-3)"),
        (BALL, "Bristle(mu: 0.5, rolling: 1.5e-3)", ", friction: Bristle(mu: 0.5, rolling: 0.5e-3)"),
    ] {
        let (mut simulation, body) = at_rest(primitive, friction, ground, inertia);
        roll(&mut simulation, body, 1.0);
        simulation.run_for(0.3).unwrap();
        let before = simulation.twist(body).linear.x;
        simulation.run_for(1.0).unwrap();
        let slowed = before - simulation.twist(body).linear.x;
        let radius = RADIUS - DEPTH;
        let expected = length * G / radius / (1.0 + inertia / (MASS * radius * radius));
        assert!((slowed / expected - 1.0).abs() < 1e-6, "{primitive} {friction}{ground}: {slowed} m/s");
    }
}

/// A parked wheel stays on a slope below tan α = b/r, does not creep, and rolls with the rest of the weight on
/// a steeper one.
#[test]
fn parked_wheels_hold_below_the_length_over_the_radius() {
    let inertia = 0.5 * MASS * RADIUS * RADIUS;
    let radius = RADIUS - DEPTH;
    for primitive in [BALL, WHEEL] {
        let (mut simulation, body) = at_rest(primitive, "Bristle(mu: 0.5, rolling: 2e-3)", "", inertia);
        tilt(&mut simulation, 0.95 * 2e-3 / radius);
        simulation.run_for(1.0).unwrap();
        let parked = simulation.pose(body).position.x;
        simulation.run_for(2.0).unwrap();
        let crept = simulation.pose(body).position.x - parked;
        assert!(parked.abs() < 1e-5 && crept.abs() < 1e-12, "{primitive}: {parked} m, then {crept} m");
        assert!(simulation.twist(body).linear.norm() < 1e-12);

        let steeper = 1.5 * 2e-3 / radius;
        tilt(&mut simulation, steeper);
        simulation.run_for(0.3).unwrap();
        let before = simulation.twist(body).linear.x;
        simulation.run_for(1.0).unwrap();
        let gained = simulation.twist(body).linear.x - before;
        let expected = (steeper - 2e-3 / radius) * G / (1.0 + inertia / (MASS * radius * radius));
        assert!((gained / expected - 1.0).abs() < 1e-6, "{primitive}: {gained} m/s against {expected}");
    }
}

/// A ball that spins about the normal slows by b·m·g/I and then stands.
#[test]
fn spinning_balls_slow_by_the_length_times_the_weight() {
    let inertia = 0.4 * MASS * RADIUS * RADIUS;
    let (mut simulation, body) = at_rest(BALL, "Bristle(mu: 0.5, spinning: 1e-3)", "", inertia);
    let pose = simulation.pose(body);
    let twist = Twist { linear: Vec3::zeros(), angular: Vec3::new(0.0, 0.0, 5.0) };
    simulation.set_motion(body, pose, twist).unwrap();
    simulation.run_for(0.1).unwrap();
    let before = simulation.twist(body).angular.z;
    simulation.run_for(1.0).unwrap();
    let slowed = before - simulation.twist(body).angular.z;
    let expected = 1e-3 * MASS * G / inertia;
    assert!((slowed / expected - 1.0).abs() < 1e-6, "{slowed} rad/s against {expected}");
    simulation.run_for(2.0).unwrap();
    assert!(simulation.twist(body).angular.norm() < 1e-12);
    assert!(simulation.twist(body).linear.norm() < 1e-12);
}

/// Whatever a ball does, its contacts lose energy.
#[test]
fn rolling_and_spinning_lose_the_energy_that_the_accounts_book() {
    let inertia = 0.4 * MASS * RADIUS * RADIUS;
    let friction = "Bristle(mu: 0.5, rolling: 2e-3, spinning: 1e-3)";
    let (mut simulation, body) = at_rest(BALL, friction, "", inertia);
    let pose = simulation.pose(body);
    let twist = Twist { linear: Vec3::new(0.7, -0.2, 0.1), angular: Vec3::new(-3.0, 8.0, 6.0) };
    simulation.set_motion(body, pose, twist).unwrap();
    let mut before = simulation.energy().mechanical();
    let start = before;
    for step in 0..20_000 {
        simulation.step().unwrap();
        let now = simulation.energy().mechanical();
        assert!(now < before + 1e-9 * start, "step {step}: {before} J, then {now} J");
        before = now;
    }
    let energy = simulation.energy();
    assert!((energy.balance() / start - 1.0).abs() < 1e-4, "{} J of {start} J", energy.balance());
}
