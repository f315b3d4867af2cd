//! Bodies that are touched from two sides: stacks, and a peg in a slot.

use crate::rig::{Body, Rig, settings};
use pong_geometry::{Quat, Vec3};
use pong_testkit::ron::{model, surface};

const G: f64 = 9.81;
const DROP: f64 = 1e-3;

fn cube(mass: f64, height: f64) -> Body {
    Body {
        mass,
        moments: Vec3::repeat(mass * 0.02 / 12.0),
        position: Vec3::z() * height,
        orientation: Quat::identity(),
        velocity: Vec3::zeros(),
        turning: Vec3::zeros(),
        gravity: Vec3::z() * -G,
    }
}

/// Balls of radius 0.05 m one above the other: centres in one line, so that nothing turns.
fn stack(k: f64, zeta: f64, masses: [f64; 2], theta: f64, frame: f64) -> Rig {
    let c = 2.0 * zeta * (k * 2.0).sqrt();
    let rest = format!("normal: Linear(damping: {:?}), friction: None", 2.0 * c);
    let surface = surface(2.0 * k, &rest);
    let ball = model("ball", &surface, "Sphere(name: \"s\", center: (0,0,0), radius: 0.05)");
    let floor = model("floor", &surface, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let bodies = vec![cube(masses[0], 0.05 + DROP), cube(masses[1], 0.15 + 2.0 * DROP), Body::fixed()];
    Rig::new(&[&ball, &ball, &floor], bodies, settings(theta, 8.0), frame)
}

fn stack_energy(rig: &Rig, k: f64) -> f64 {
    let heights = [rig.leading(0).z, rig.leading(1).z];
    let depths = [0.05 - heights[0], 0.1 - (heights[1] - heights[0])];
    let stored: f64 = depths.iter().map(|depth| depth.max(0.0)).map(|depth| 0.5 * k * depth * depth).sum();
    let weight: f64 = (0..2).map(|i| rig.bodies[i].mass * G * heights[i]).sum();
    rig.kinetic() + weight + stored
}

#[test]
fn stacks_gain_nothing() {
    for zeta in [0.0, 0.1] {
        for masses in [[2.0, 2.0], [100.0, 2.0], [2.0, 100.0]] {
            for k in [1e5, 1e7] {
                for theta in [1.0, 0.5, 0.0] {
                    let mut rig = stack(k, zeta, masses, theta, 0.05);
                    let start = stack_energy(&rig, k);
                    let mut most: f64 = 0.0;
                    for _ in 0..40 {
                        rig.step();
                        most = most.max(stack_energy(&rig, k) - start);
                    }
                    let speed = rig.bodies[0].velocity.norm().max(rig.bodies[1].velocity.norm());
                    let gained = most / (masses[1] * G * DROP);
                    println!(
                        "zeta {zeta} masses {masses:?} k {k:.0e} theta {theta}: gained {gained:.1e} of m·g·drop, speed {speed:.1e}"
                    );
                    assert!(gained <= if zeta > 0.0 { 1e-9 } else { 0.055 });
                }
            }
        }
    }
}

#[test]
fn a_peg_in_a_slot_gains_nothing() {
    const K: f64 = 1e6;
    const CLEARANCE: f64 = 1e-3;
    let surface = surface(2.0 * K, "friction: None");
    let peg = model("peg", &surface, "Sphere(name: \"s\", center: (0,0,0), radius: 0.05)");
    let wall = |sign: f64| {
        let plane =
            format!("Plane(name: \"f\", normal: ({sign:?},0,0), offset: {:?})", -0.05 - 0.5 * CLEARANCE);
        model("wall", &surface, &plane)
    };
    let (left, right) = (wall(1.0), wall(-1.0));
    for speed in [0.01, 0.1, 0.5] {
        for theta in [1.0, 0.5, 0.0] {
            let mut body = cube(2.0, 0.0);
            (body.gravity, body.velocity) = (Vec3::zeros(), Vec3::x() * speed);
            // The leading pose is in the middle.
            body.position = -body.velocity * ((1.0 - theta) * 0.05);
            let bodies = vec![body, Body::fixed(), Body::fixed()];
            let mut rig = Rig::new(&[&peg, &left, &right], bodies, settings(theta, 40.0), 0.05);
            let start = rig.kinetic();
            let (mut most, mut deepest): (f64, f64) = (0.0, 0.0);
            let mut met_another = false;
            for _ in 0..40 {
                let report = rig.step();
                met_another |= report.status.met_another;
                assert!(!report.status.theta_mismatch, "{report:?}");
                let depth = (rig.leading(0).x.abs() - 0.5 * CLEARANCE).max(0.0);
                most = most.max((rig.kinetic() + 0.5 * K * depth * depth) / start - 1.0);
                deepest = deepest.max(depth / (speed * (2.0 / K).sqrt()));
            }
            println!("speed {speed} theta {theta}: gained {most:.1e}, depth over the true one {deepest:.4}");
            assert_eq!(met_another, speed > 0.05);
            assert!(most <= 3e-3 && deepest <= 1.003);
        }
    }
}
