//! Invariances: position of the common origin, rotation and drift of the common frame, order of the Objects,
//! and unit of length (docs/theory.md, 1, 2 and 6; docs/extremes.md).

use crate::common::*;
use pong_engine::{Config, State, WorldBuilder};
use pong_geometry::{Pose, Quat, Vec3};
use pong_testkit::Random;

const K: f64 = 2e5;

/// One body with every kind that can be A, one with every kind that can be B.
fn everything() -> (String, String) {
    everything_scaled(1.0)
}

fn everything_scaled(s: f64) -> (String, String) {
    // Stiffness scales with length, so that forces scale with its square.
    let steel = surface(
        K * s,
        "normal: Linear(damping: 300.0), friction: Bristle(mu: 0.3, static_excess: 0.2, damping: 40.0)",
    );
    let v = |x: f64, y: f64, z: f64| format!("({:?},{:?},{:?})", x * s, y * s, z * s);
    let movers = [
        format!("Point(name: \"p\", position: {})", v(0.02, 0.01, -0.205)),
        format!("LineSegment(name: \"l\", ends: ({}, {}))", v(-0.3, 0.1, -0.202), v(0.25, -0.1, -0.207)),
        format!(
            "Ray(name: \"r\", origin: {}, direction: (0.1,0.05,-1.0), length: {:?})",
            v(0.1, 0.1, 0.0),
            0.24 * s
        ),
        format!("Sphere(name: \"b\", center: {}, radius: {:?})", v(-0.15, 0.15, -0.05), 0.17 * s),
        format!("Sphere(name: \"b2\", center: {}, radius: {:?})", v(0.05, 0.05, -0.1), 0.12 * s),
        format!(
            "Ellipsoid(name: \"e\", center: {}, semi_axes: {}, orientation: (0.9,0.1,0.3,0.3))",
            v(0.15, -0.15, -0.08),
            v(0.2, 0.12, 0.15)
        ),
    ];
    let grounds = [
        box_polyhedron("box", [0.0, 0.0, -0.3 * s], [0.5 * s, 0.5 * s, 0.1 * s], ""),
        format!("Plane(name: \"floor\", normal: (0.05,-0.02,1.0), offset: {:?})", -0.199 * s),
        format!("Sphere(name: \"knob\", center: {}, radius: {:?})", v(0.05, 0.05, -0.3), 0.11 * s),
        format!("Ellipsoid(name: \"egg\", center: {}, semi_axes: {})", v(0.0, 0.0, -0.3), v(0.2, 0.25, 0.11)),
        plate_mesh("mesh", 6, s, |x, y| Vec3::new(x, y, -0.195 * s + 0.005 * s * (x / s * 9.0).sin())),
    ];
    (model("movers", &steel, &movers.join(",\n")), model("grounds", &steel, &grounds.join(",\n")))
}

fn some_motion(random: &mut Random, s: f64) -> [State; 2] {
    let a = moving(
        random.vector(0.01 * s),
        Quat::from_scaled_axis(random.vector(0.05)),
        random.vector(0.05 * s),
        random.vector(0.1),
    );
    let b = moving(
        random.vector(0.003 * s),
        Quat::from_scaled_axis(random.vector(0.02)),
        random.vector(0.05 * s),
        random.vector(0.1),
    );
    [a, b]
}

#[test]
fn every_pair_of_kinds_is_met() {
    let (a, b) = everything();
    let mut rig = Rig::new(&a, &b);
    rig.place_a(Vec3::zeros(), Quat::identity());
    rig.world.step().unwrap();
    let met: std::collections::BTreeSet<_> =
        rig.world.contacts().iter().map(|c| (c.a.primitive, c.b.primitive)).collect();
    // Point: box, floor, knob, egg. Segment: box, floor. Ray: the first of the three it could hit. Balls:
    // box, floor, mesh, and one of them knob and egg. Ellipsoid: box, floor, egg, mesh.
    let count = |a| met.iter().filter(|(first, _)| *first == a).count();
    assert_eq!([0, 1, 2, 3, 4, 5].map(count), [4, 2, 1, 3, 5, 4], "{met:?}");
}

/// One docking at rest, in a rotated frame, at 6.8e6 m, at 7.7 km/s: the wrench agrees within stiffness
/// times the rounding of positions plus damping times the rounding of velocities.
#[test]
fn the_common_frame_does_not_matter() {
    let (a, b) = everything();
    let cases = [
        ("turned", Vec3::new(1.0, -2.0, 0.5), Vec3::zeros()),
        ("drifting", Vec3::zeros(), Vec3::new(7700.0, -120.0, 33.0)),
        ("low orbit", Vec3::new(6.8e6, 1.1e5, -4.0e6), Vec3::new(-1200.0, 7600.0, 400.0)),
        ("far", Vec3::new(-1e8, 3e7, 5e7), Vec3::new(1000.0, 2000.0, -7000.0)),
    ];
    for (name, origin, drift) in cases {
        let mut random = Random(11);
        let pose = Pose { position: origin, orientation: Quat::from_scaled_axis(Vec3::new(0.3, -1.1, 0.7)) };
        let mut near = Rig::new(&a, &b);
        let mut far = Rig::new(&a, &b);
        for step in 0..40 {
            let states = some_motion(&mut random, 1.0);
            near.place(states);
            near.world.step().unwrap();
            let t = f64::from(step) * 1e-3;
            let moved = Pose { position: pose.position + drift * t, ..pose };
            far.place([seen_from(&states[0], &moved, &drift), seen_from(&states[1], &moved, &drift)]);
            far.world.step().unwrap();
            // Rounding: ε·|x| for a far position, ε·|v| for a velocity, ε·1 m for the near geometry; 30
            // contacts.
            let position = 4.0 * f64::EPSILON * (origin.norm() + 2.0);
            let velocity = 4.0 * f64::EPSILON * (drift.norm() + 1.0);
            let allowed = 30.0 * (K * position + 400.0 * velocity);
            for side in 0..2 {
                let expected = near.wrench(side);
                let got = far.wrench(side);
                let back = pose.orientation.inverse();
                let force = (back * got.force - expected.force).norm();
                let moment = (back * got.moment - expected.moment).norm();
                assert!(force <= allowed && moment <= allowed, "{name}: {force} {moment} > {allowed}");
                assert!(expected.force.norm() > 100.0, "the scene must press");
            }
        }
    }
}

/// A quaternion and its negative, in alternating frames, are the same orientation, bit for bit.
#[test]
fn a_quaternion_and_its_negative_are_one_orientation() {
    let (a, b) = everything();
    let (mut plain, mut flipping) = (Rig::new(&a, &b), Rig::new(&a, &b));
    let mut random = Random(23);
    for step in 0..40 {
        let [state_a, state_b] = some_motion(&mut random, 1.0);
        let flip = |state: State, flips: bool| match flips {
            true => State { orientation: state.orientation.map(|x| -x), ..state },
            false => state,
        };
        plain.place([state_a, state_b]);
        flipping.place([flip(state_a, step % 2 == 1), flip(state_b, step % 3 == 1)]);
        for rig in [&mut plain, &mut flipping] {
            rig.world.step().unwrap();
        }
        for side in 0..2 {
            assert_eq!(plain.wrench(side), flipping.wrench(side), "step {step}");
        }
        assert!(plain.wrench(0).force.norm() > 100.0, "the scene must press");
    }
}

#[test]
fn scaling_the_scene_scales_the_result() {
    for s in [1e-3, 1e3] {
        let (a, b) = everything();
        let (a_scaled, b_scaled) = everything_scaled(s);
        // Forces scale with s² if stiffness scales with s; damping in N·s/m must then scale with s as well.
        let damp = |text: &str| {
            text.replace("damping: 300.0", &format!("damping: {:?}", 300.0 * s))
                .replace("damping: 40.0", &format!("damping: {:?}", 40.0 * s))
        };
        let mut one = Rig::new(&a, &b);
        let mut other = Rig::new(&damp(&a_scaled), &damp(&b_scaled));
        let mut random = Random(5);
        for _ in 0..30 {
            let [state_a, state_b] = some_motion(&mut random, 1.0);
            let scale = |state: &State| State {
                position: state.position.map(|x| x * s),
                linear_velocity: state.linear_velocity.map(|x| x * s),
                ..*state
            };
            one.place([state_a, state_b]);
            other.place([scale(&state_a), scale(&state_b)]);
            one.world.step().unwrap();
            other.world.step().unwrap();
            assert_eq!(one.world.contact_count(), other.world.contact_count());
            for side in 0..2 {
                let (expected, got) = (one.wrench(side), other.wrench(side));
                let force = (got.force / (s * s) - expected.force).norm();
                let moment = (got.moment / (s * s * s) - expected.moment).norm();
                let size = expected.force.norm();
                assert!(
                    force <= 1e-10 * size && moment <= 1e-10 * size,
                    "scale {s}: {force} {moment} of {size}"
                );
            }
        }
    }
}

/// Listed contacts sum to the wrenches, and action and reaction cancel in force and moment, to 1e-12 of the
/// largest contribution.
#[test]
fn contacts_sum_to_the_wrenches_and_action_balances_reaction() {
    let (a, b) = everything();
    let mut rig = Rig::new(&a, &b);
    let mut random = Random(3);
    for _ in 0..200 {
        let states = some_motion(&mut random, 1.0);
        rig.place(states);
        rig.world.step().unwrap();
        let contacts = rig.world.contacts();
        assert!(contacts.len() > 5);
        let largest = contacts.iter().map(|c| c.force.norm()).fold(0.0, f64::max);
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            let mut force = Vec3::zeros();
            let mut moment = Vec3::zeros();
            for c in &contacts {
                // Object a is listed as A here: the grounds hold no mover.
                let arm = if sign > 0.0 { c.a.arm } else { c.b.arm };
                force += c.force * sign;
                moment += arm.cross(&c.force) * sign;
            }
            let wrench = rig.wrench(side);
            assert!((wrench.force - force).norm() <= 1e-12 * largest);
            assert!((wrench.moment - moment).norm() <= 1e-12 * largest);
        }
        let [wa, wb] = [rig.wrench(0), rig.wrench(1)];
        let [pa, pb] = states.map(|state| Vec3::from(state.position));
        let force = wa.force + wb.force;
        let moment = wa.moment + pa.cross(&wa.force) + wb.moment + pb.cross(&wb.force);
        assert!(force.norm() <= 1e-12 * largest && moment.norm() <= 1e-12 * largest);
    }
}

/// For different kinds, naming the Objects in the other order changes no number.
#[test]
fn the_order_of_pairing_does_not_matter() {
    let (a, b) = everything();
    // For equal kinds the order decides which of the two is A: no sphere meets a sphere, no ellipsoid an ellipsoid.
    let knob = b.lines().find(|line| line.contains("knob")).unwrap();
    let b = b.replace(knob, "");
    let egg = "\"egg\", center: (0.0,0.0,-0.3)";
    assert!(a.contains("(0.15,-0.15,-0.08)") && b.contains(egg));
    the_order_changes_nothing(&a, &b.replace(egg, "\"egg\", center: (0.0,0.0,-30.0)"));
    the_order_changes_nothing(&a.replace("(0.15,-0.15,-0.08)", "(0.15,-0.15,30.0)"), &b);
}

fn the_order_changes_nothing(a: &str, b: &str) {
    let mut worlds = [false, true].map(|swapped| {
        let mut builder = WorldBuilder::new(Config::default());
        let models = [load(&mut builder, a), load(&mut builder, b)];
        let objects =
            [builder.create_object(models[0], "a").unwrap(), builder.create_object(models[1], "b").unwrap()];
        if swapped {
            builder.pair(objects[1], objects[0]).unwrap();
        } else {
            builder.pair(objects[0], objects[1]).unwrap();
        }
        let (world, _) = builder.seal().unwrap();
        (world, objects)
    });
    let mut random = Random(17);
    for _ in 0..30 {
        let states = some_motion(&mut random, 1.0);
        let frames = worlds.each_mut().map(|(world, objects)| {
            let interfaces = objects.map(|object| world.scene().interface(object, "").unwrap());
            world.set_states(&[(interfaces[0], states[0]), (interfaces[1], states[1])]).unwrap();
            world.step().unwrap();
            let forces: Vec<_> =
                world.contacts().iter().map(|c| (c.a.primitive, c.b.primitive, c.force)).collect();
            (interfaces.map(|interface| world.wrench(interface).unwrap()), forces)
        });
        assert!(frames[0].1.len() > 5);
        assert_eq!(frames[0], frames[1]);
    }
}
