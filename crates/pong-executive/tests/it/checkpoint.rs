//! A saved simulation goes on with the same bits, in itself and in another with the same set-up.

use crate::common;
use pong_executive::{Pose, Simulation, Twist, Vec3, Wrench};

/// Two rough balls, one of them off its mass centre, that fall onto a rough ground and against each other,
/// and roll on it.
fn balls(integrator: &str) -> Simulation {
    let text = format!(
        r#"(format: "pong-scene", version: 1, name: "balls",
            models: {{ "ball": "ball.ron", "ground": "ground.ron" }},
            objects: [
                (name: "one", model: "ball", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 5e-3, 6e-3),
                    mass_center: (0.01, 0.0, 0.02), position: (0.0, 0.0, 0.1001), angular_velocity: (3.0, 8.0, 1.0))]),
                (name: "two", model: "ball", bodies: [(motion: Free, mass: 2.0, inertia: Diagonal(8e-3, 8e-3, 8e-3),
                    position: (0.2001, 0.01, 0.12), linear_velocity: (-0.5, 0.0, -0.3))]),
                (name: "ground", model: "ground", bodies: [(motion: Fixed)]),
            ],
            pairs: [("one", "ground"), ("two", "ground"), ("one", "two")],
            gravity: (0.0, 0.0, -9.81), integrator: {integrator}, step: 1e-4, duration: 0.1, ledger: true)"#
    );
    common::simulation_of_balls(&text)
}

fn saved(simulation: &Simulation) -> Vec<u8> {
    let mut bytes = Vec::new();
    simulation.save(&mut bytes);
    bytes
}

const INTEGRATORS: [&str; 6] = [
    "RungeKutta4",
    "SemiImplicitEuler",
    "ZeroOrderHold()",
    "ZeroOrderHold(substeps: 2, delay_frames: 2)",
    "LongFrame()",
    "LongFrame(substeps_max: 500, delay_frames: 2)",
];

#[test]
fn a_restored_simulation_goes_on_with_the_same_bits() {
    for integrator in INTEGRATORS {
        let mut simulation = balls(integrator);
        let two = simulation.bodies().nth(1).unwrap().0;
        let push = Wrench { force: Vec3::new(1.0, 0.2, 0.0), moment: Vec3::new(0.0, 0.0, 0.01) };
        simulation.run_for(0.05).unwrap();
        simulation.set_external_wrench(two, push).unwrap();
        let touches = |simulation: &Simulation| simulation.world().contact_count() > 0;
        for _ in 0..2000 {
            simulation.step().unwrap();
            if touches(&simulation) {
                break;
            }
        }
        assert!(touches(&simulation), "{integrator}: saved out of contact");
        let middle = saved(&simulation);
        simulation.run_for(0.03).unwrap();
        let end = saved(&simulation);
        assert_ne!(middle, end);
        // Restored in itself, and in a new one that has never run.
        for mut other in [simulation, balls(integrator)] {
            other.restore(&middle).unwrap();
            assert_eq!(saved(&other), middle, "{integrator}: what is restored is what was saved");
            other.run_for(0.03).unwrap();
            assert_eq!(saved(&other), end, "{integrator}");
        }
    }
}

#[test]
fn a_body_that_is_led_is_saved_with_its_path() {
    let lead = |simulation: &mut Simulation, height| {
        let one = simulation.bodies().next().unwrap().0;
        let twist = Twist { linear: Vec3::new(0.1, 0.0, 0.0), angular: Vec3::new(0.0, 1.0, 0.0) };
        let pose = Pose::new(Vec3::new(0.0, 0.0, height), [0.8, 0.0, 0.6, 0.0]);
        simulation.lead(one, 0.0, pose, twist).unwrap();
    };
    let mut simulation = balls("RungeKutta4");
    lead(&mut simulation, 0.0999);
    simulation.run_for(0.02).unwrap();
    let middle = saved(&simulation);
    simulation.run_for(0.02).unwrap();
    let end = saved(&simulation);
    let mut other = balls("RungeKutta4");
    let told = other.restore(&middle).unwrap_err().to_string();
    assert!(told.contains("other bodies"), "nobody leads a body here: {told}");
    lead(&mut other, 0.5);
    other.restore(&middle).unwrap();
    other.run_for(0.02).unwrap();
    assert_eq!(saved(&other), end);
    let one = other.bodies().next().unwrap().0;
    assert!((other.pose(one).position.x - 0.004).abs() < 1e-15);
}

#[test]
fn what_is_refused_changes_nothing() {
    let mut simulation = balls("RungeKutta4");
    simulation.run_for(0.02).unwrap();
    let good = saved(&simulation);
    let mut damaged = good.clone();
    damaged[100] ^= 1;
    let mut newer = good.clone();
    newer[8] = 9;
    let checksum = pong_model::Fnv::of(&newer[..newer.len() - 8]).to_le_bytes();
    let at = newer.len() - 8;
    newer[at..].copy_from_slice(&checksum);
    simulation.run_for(0.01).unwrap();
    let now = saved(&simulation);
    for (bytes, cause) in [
        (&damaged[..], "damaged"),
        (&good[..good.len() - 1], "damaged"),
        (&good[..4], "no saved instant"),
        (&[][..], "no saved instant"),
        (&newer[..], "another version"),
    ] {
        let told = simulation.restore(bytes).unwrap_err().to_string();
        assert!(told.contains(cause), "{told}");
        assert_eq!(saved(&simulation), now);
    }
}
