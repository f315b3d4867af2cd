//! Incremental potential of a step: closed forms, its wrench and curvature, and a host that steps with it. Random scenes
//! are compared with differences by the claim `tangent` of the invariances.

use crate::common::*;
use nalgebra::SMatrix;
use pong_engine::{PairPotential, State};
use pong_geometry::{Quat, Vec3};

const K: f64 = 2e5;
const FLOOR: &str = "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)";

fn potential(rig: &mut Rig, state: State, step: f64) -> PairPotential {
    rig.place([state, State::identity()]);
    rig.world.evaluate().unwrap();
    rig.world.incremental_potentials(step).unwrap()[0]
}

/// A point that sinks from d₀ to d in T: F = k·d + (c/T)·(d − d₀), Φ = ½k·d² + (c/T)·(½d² − d₀·d) and the part that keeps
/// it zero where the force would pull.
#[test]
fn a_point_on_a_floor_has_the_closed_form() {
    let [stiffness, damping, step] = [0.5 * K, 300.0, 2e-3];
    let smooth = surface(K, "normal: Linear(damping: 600.0), friction: None");
    let point = "Point(name: \"p\", position: (0,0,0))";
    let mut rig = Rig::new(&model("tip", &smooth, point), &model("floor", &smooth, FLOOR));
    let depth = |d: f64| at(Vec3::new(0.1, 0.2, -d), Quat::identity());
    let start = 1e-3;
    rig.place([depth(start), State::identity()]);
    rig.world.step().unwrap();
    let over = damping / step;
    let free = over * start / (stiffness + over);
    let whole = |d: f64| 0.5 * stiffness * d * d + over * (0.5 * d - start) * d;
    for end in [2e-3, 1e-3, 0.9 * start, 0.5 * free] {
        let found = potential(&mut rig, depth(end), step);
        let (force, energy) = match end > free {
            true => (stiffness * end + over * (end - start), whole(end) - whole(free)),
            false => (0.0, 0.0),
        };
        assert!((found.wrenches[0].force.z - force).abs() < 1e-9 * K * start, "{end}: {found:?}");
        assert!((found.wrenches[1].force.z + force).abs() < 1e-9 * K * start);
        assert!(
            (found.energy - energy).abs() < 1e-12 * K * start * start + 1e-15,
            "{end}: {found:?} {energy}"
        );
    }
    // Without a committed pose the contact begins: d₀ = 0.
    rig.world.clear_contact_history(rig.objects[0]).unwrap();
    let found = potential(&mut rig, depth(start), step);
    assert!((found.wrenches[0].force.z - (stiffness + over) * start).abs() < 1e-9 * K * start, "{found:?}");
}

/// A step of the host: the end that minimises ½m·|x − x*|²/T² + Φ(x), by Newton's method on a translation. A step that
/// raises the energy is halved: the friction has a kink.
fn minimised(rig: &mut Rig, free: Vec3, (mass, step): (f64, f64)) -> Vec3 {
    let inertia = mass / (step * step);
    let mut at_end = |end: Vec3| {
        rig.place([at(end, Quat::identity()), State::identity()]);
        rig.world.evaluate().unwrap();
        let mut hessian = nalgebra::Matrix3::identity() * inertia;
        let mut slope = (end - free) * inertia;
        let mut energy = 0.5 * inertia * (end - free).norm_squared();
        for pair in rig.world.incremental_potentials(step).unwrap() {
            hessian += pair.stiffness[0][0].fixed_view::<3, 3>(0, 0);
            slope -= pair.wrenches[0].force;
            energy += pair.energy;
        }
        (energy, hessian.try_inverse().unwrap() * slope)
    };
    let mut end = free;
    for _ in 0..60 {
        let (energy, change) = at_end(end);
        let halved = (0..40).map(|halvings| change * 0.5_f64.powi(halvings));
        let Some(lower) = halved.map(|change| end - change).find(|end| at_end(*end).0 < energy) else {
            break;
        };
        end = lower;
    }
    end
}

/// A block on four feet, thrown along the floor, in steps of 20 ms on springs of 1e6 N/m: it loses μ·g·T a step, and then
/// stays.
#[test]
fn a_block_slides_and_stops() {
    let [mu, gravity, mass, step] = [0.3, 9.81, 2.0, 0.02];
    let rough = surface(1e6, "normal: Linear(damping: 0.0), friction: Bristle(mu: 0.3, damping: 0.0)");
    let feet: String = [(-1, -1), (-1, 1), (1, -1), (1, 1)]
        .map(|(x, y)| {
            format!("Point(name: \"p{x}{y}\", position: (0.{x}, 0.{y}, 0.0)),").replace("0.-", "-0.")
        })
        .concat();
    let mut rig = Rig::new(&model("block", &rough, &feet), &model("floor", &rough, FLOOR));
    let rest = mass * gravity / (4.0 * 0.5e6);
    let mut x = Vec3::new(0.0, 0.0, -rest);
    let mut speed = 1.0;
    rig.place([at(x, Quat::identity()), State::identity()]);
    rig.world.step().unwrap();
    for frame in 0..40 {
        let free = x + Vec3::new(speed, 0.0, -gravity * step) * step;
        let end = minimised(&mut rig, free, (mass, step));
        rig.place([at(end, Quat::identity()), State::identity()]);
        rig.world.step().unwrap();
        let now = (end.x - x.x) / step;
        let expected = (speed - mu * gravity * step).max(0.0);
        assert!((end.z + rest).abs() < 1e-9, "{frame}: {end}");
        if expected > 0.1 {
            assert!((now - expected).abs() < 1e-6, "{frame}: {now} for {expected}");
        }
        (x, speed) = (end, now);
    }
    assert!(speed.abs() < 0.01, "{speed}");
}

/// Curved bodies with history: the wrench is minus the slope of the energy, the curvature is symmetric and not negative.
#[test]
fn the_wrench_is_the_slope_of_the_energy() {
    let rough = surface(
        K,
        "normal: HuntCrossley(dissipation: 0.3, exponent: 1.5), friction: Bristle(mu: 0.4, damping: 40.0)",
    );
    let capsule = "Capsule(name: \"c\", ends: ((-0.3,0.02,0.0), (0.3,0.0,0.05)), radius: 0.1)";
    let hill = "Sphere(name: \"h\", center: (0,0,-2), radius: 2.0)";
    let step = 5e-3;
    for travel in [1e-6, 2e-3] {
        let mut rig = Rig::new(&model("capsule", &rough, capsule), &model("hill", &rough, hill));
        let place = |t: f64| {
            let turn = Quat::from_scaled_axis(Vec3::new(0.01, 0.02 - 0.1 * travel * t, 0.1 + travel * t));
            at(Vec3::new(0.02 + travel * t, 0.4 * travel * t, 0.055 - 0.1 * travel * t), turn)
        };
        for frame in 0..2 {
            rig.place([place(f64::from(frame)), State::identity()]);
            rig.world.step().unwrap();
        }
        let here = potential(&mut rig, place(2.0), step);
        let arm = 0.3;
        let mut scale = 0.0_f64;
        let mut off = 0.0_f64;
        for coordinate in 0..6 {
            let width = 1e-7;
            let mut vector = Vec3::zeros();
            vector[coordinate % 3] = width;
            let beside = |sign: f64| {
                let (mut pose, shift) = (place(2.0).pose(), vector * sign);
                match coordinate < 3 {
                    true => pose.position += shift,
                    false => pose.orientation = Quat::from_scaled_axis(shift / arm) * pose.orientation,
                }
                at(pose.position, pose.orientation)
            };
            let [ahead, behind] = [1.0, -1.0].map(|sign| potential(&mut rig, beside(sign), step).energy);
            let wrench = &here.wrenches[0];
            let part =
                if coordinate < 3 { wrench.force[coordinate] } else { wrench.moment[coordinate - 3] / arm };
            off = off.max((part + (ahead - behind) / (2.0 * width)).abs());
            scale = scale.max(part.abs());
        }
        assert!(off < 1e-6 * scale, "{travel}: {off} of {scale}");
        let stiffness = SMatrix::<f64, 12, 12>::from_fn(|row, column| {
            here.stiffness[row / 6][column / 6][(row % 6, column % 6)]
        });
        assert!((stiffness - stiffness.transpose()).amax() < 1e-12 * stiffness.amax());
        let least = stiffness.symmetric_eigenvalues().min();
        assert!(least > -1e-9 * stiffness.amax(), "{least}");
    }
}

#[test]
fn a_step_without_length_is_refused() {
    let smooth = surface(K, "friction: None");
    let mut rig = Rig::new(
        &model("tip", &smooth, "Point(name: \"p\", position: (0,0,0))"),
        &model("floor", &smooth, FLOOR),
    );
    rig.place_a(Vec3::new(0.0, 0.0, -1e-3), Quat::identity());
    assert!(rig.world.incremental_potentials(1e-3).is_err(), "before a frame");
    rig.world.evaluate().unwrap();
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = rig.world.incremental_potentials(step).unwrap_err().to_string();
        assert!(refused.contains("positive"), "{refused}");
    }
}
