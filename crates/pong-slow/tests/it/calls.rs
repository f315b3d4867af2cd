//! Calls: bits, saved states, bad input.

use crate::rig::{Body, Rig, all_paired, settings};
use pong_engine::{Config, State, WorkerSettings};
use pong_geometry::Vec3;
use pong_slow::{Dynamics, Settings, SlowError, SlowHost};
use pong_testkit::ron::{model, surface};

fn models() -> [String; 2] {
    let surface = surface(2e6, "normal: Linear(damping: 50.0), friction: Bristle(mu: 0.5)");
    [
        model("ball", &surface, "Sphere(name: \"s\", center: (0,0,0), radius: 0.05)"),
        model("floor", &surface, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"),
    ]
}

fn rig(config: Config, delay_frames: u32) -> Rig {
    let [ball, floor] = models();
    let (world, interfaces) = all_paired(config, &[&ball, &ball, &floor]);
    let at = |x: f64, z: f64, vx: f64| {
        let mut body = Body::ball(2.0, 0.05, Vec3::new(x, 0.01 * z, z), Vec3::new(vx, 0.02, -0.1));
        body.gravity = Vec3::z() * -9.81;
        body
    };
    let bodies = vec![at(0.0, 0.051, 0.1), at(0.04, 0.14, -0.05), Body::fixed()];
    let settings = Settings { delay_frames, ..settings(1.0, 12.0) };
    Rig::of(&world, interfaces, bodies, settings, 0.02)
}

fn bits(rig: &Rig) -> Vec<u64> {
    let numbers = rig.bodies.iter().flat_map(|body| {
        body.position
            .iter()
            .chain(&body.velocity)
            .chain(&body.turning)
            .map(|x| x.to_bits())
            .collect::<Vec<_>>()
    });
    numbers.collect()
}

#[test]
fn workers_and_discarded_frames_change_no_bit() {
    let workers = WorkerSettings { workers: 2, ..WorkerSettings::default() };
    let mut plain = rig(Config::default(), 2);
    let mut shared = rig(Config { workers: Some(workers), ..Config::default() }, 2);
    for frame in 0..30 {
        plain.step();
        if frame % 3 == 0 {
            let mut inputs = shared.inputs();
            inputs[0].state.position[2] += 0.01;
            shared.slow.evaluate(0.013, &inputs).unwrap();
        }
        shared.step();
        assert_eq!(bits(&plain), bits(&shared), "frame {frame}");
    }
}

#[test]
fn a_saved_state_goes_on_with_the_same_bits() {
    for delay_frames in [0, 3] {
        let mut one = rig(Config::default(), delay_frames);
        (0..12).for_each(|_| drop(one.step()));
        let saved = one.slow.save_state();
        assert!(saved.len() <= one.slow.state_size());
        let mut other = rig(Config::default(), delay_frames);
        other.slow.restore_state(&saved).unwrap();
        other.bodies.clone_from(&one.bodies);
        other.waiting.clone_from(&one.waiting);
        assert_eq!(other.slow.save_state(), saved);
        for _ in 0..10 {
            let (report, again) = (one.step(), other.step());
            assert_eq!((report.inserted, report.evaluations), (again.inserted, again.evaluations));
            assert_eq!(bits(&one), bits(&other));
        }
        for place in [0, 9, 40, saved.len() / 2, saved.len() - 1] {
            let mut damaged = saved.clone();
            damaged[place] ^= 1;
            assert!(matches!(other.slow.restore_state(&damaged), Err(SlowError::BadState { .. })));
        }
        assert!(other.slow.restore_state(&saved[..saved.len() - 9]).is_err());
        assert!(other.slow.restore_state(&[]).is_err());
    }
}

#[test]
fn without_dynamics_a_frame_is_an_evaluation() {
    let [ball, floor] = models();
    let (mut world, interfaces) = all_paired(Config::default(), &[&ball, &floor]);
    let mut slow = SlowHost::new(&world, Settings::default()).unwrap();
    for frame in 0..20 {
        let x = 1e-4 * f64::from(frame);
        let state = State {
            position: [x, 0.0, 0.0499 - 0.1 * x],
            linear_velocity: [0.1, 0.0, -0.01],
            ..State::identity()
        };
        let states = [(interfaces[0], state), (interfaces[1], State::identity())];
        world.set_states(&states).unwrap();
        world.evaluate().unwrap();
        slow.evaluate_states(&states).unwrap();
        for interface in &interfaces {
            assert_eq!(world.wrench_common(*interface).unwrap(), slow.wrench_common(*interface).unwrap());
        }
        world.commit().unwrap();
        slow.commit().unwrap();
        let mut block = Vec::new();
        world.save_state_packed(&mut block);
        let saved = slow.save_state();
        assert_eq!(saved[saved.len() - 8 - block.len()..saved.len() - 8], block);
    }
}

#[test]
fn bad_input_is_refused_and_changes_nothing() {
    let mut rig = rig(Config::default(), 0);
    (0..3).for_each(|_| drop(rig.step()));
    let saved = rig.slow.save_state();
    let good = rig.inputs();
    let mut refused = |length: f64, inputs: &[pong_slow::GroupInput], text: &str| {
        let message = rig.slow.evaluate(length, inputs).unwrap_err().to_string();
        assert!(message.contains(text), "{message}");
        assert!(matches!(rig.slow.commit(), Err(SlowError::WrongPhase { .. })));
        assert_eq!(rig.slow.save_state(), saved);
    };
    for length in [0.0, -0.01, f64::NAN, f64::INFINITY] {
        refused(length, &good, "length of the frame");
    }
    refused(0.02, &good[1..], "mass of `o0/ball`: it is missing");
    refused(0.02, &[good[0], good[0], good[1], good[2]], "it is given twice");
    for mass in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut inputs = good.clone();
        if let Dynamics::Free { mass: given, .. } = &mut inputs[0].dynamics {
            *given = mass;
        }
        refused(0.02, &inputs, "mass of `o0/ball`");
    }
    let mut inputs = good.clone();
    let mut mobility = [[0.0; 6]; 6];
    mobility[0][0] = -1.0;
    inputs[1].dynamics = Dynamics::Jointed { mobility };
    refused(0.02, &inputs, "mobility of `o1/ball`");
    let mut inputs = good.clone();
    inputs[0].linear_acceleration[1] = f64::NAN;
    refused(0.02, &inputs, "acceleration of `o0/ball`");
    let other = self::rig(Config::default(), 0);
    let mut inputs = good.clone();
    inputs[0].interface = other.interfaces[0];
    assert!(matches!(rig.slow.evaluate(0.02, &inputs), Err(SlowError::Engine(_))));
    rig.step();
    let (world, _) = all_paired(Config::default(), &[&models()[0], &models()[1]]);
    for settings in [
        Settings { theta: 1.5, ..Settings::default() },
        Settings { theta: -0.1, ..Settings::default() },
        Settings { theta: f64::NAN, ..Settings::default() },
        Settings { substeps_max: 0, ..Settings::default() },
        Settings { substeps_per_radian: 0.0, ..Settings::default() },
        Settings { delay_frames: 100_000, ..Settings::default() },
    ] {
        assert!(matches!(SlowHost::new(&world, settings), Err(SlowError::BadSetting { .. })));
    }
}

#[test]
fn a_wrong_theta_a_limit_and_a_second_partner_are_seen() {
    // θ of the host ½, of the settings 1: seen in free fall.
    let mut one = rig(Config::default(), 0);
    one.theta = 0.5;
    for body in &mut one.bodies[..2] {
        body.position.z += 1.0;
    }
    one.step();
    let report = one.step();
    assert!(
        report.status.theta_mismatch && (report.theta_measured.unwrap() - 0.5).abs() < 1e-6,
        "{report:?}"
    );
    let mut right = rig(Config::default(), 0);
    for body in &mut right.bodies[..2] {
        body.position.z += 1.0;
    }
    right.step();
    assert!(!right.step().status.theta_mismatch);
    // Substeps at most 3.
    let [ball, floor] = models();
    let (world, interfaces) = all_paired(Config::default(), &[&ball, &floor]);
    let mut body = Body::ball(2.0, 0.05, Vec3::z() * 0.0501, Vec3::z() * -0.1);
    body.gravity = Vec3::z() * -9.81;
    let few = Settings { substeps_max: 3, ..settings(1.0, 12.0) };
    let mut rig = Rig::of(&world, interfaces, vec![body, Body::fixed()], few, 0.05);
    let start = rig.kinetic();
    let mut limited = false;
    for _ in 0..40 {
        let report = rig.step();
        assert!(report.substeps <= 3);
        limited |= report.status.substep_limit && report.status.unresolved;
        assert!(rig.kinetic() <= 1.1 * start + 1e-3);
    }
    assert!(limited && rig.bodies[0].velocity.norm() < 1e-6);
}

/// A ball with its mass centre away from the origin of the group gets the same force, and the moment about that origin.
#[test]
fn a_group_frame_away_from_the_mass_centre_changes_no_wrench() {
    let [ball, floor] = models();
    let center = Vec3::new(0.3, 0.1, -0.2);
    let moved = ball.replace("center: (0,0,0)", "center: (0.3,0.1,-0.2)");
    let (world, ids) = all_paired(Config::default(), &[&moved, &floor]);
    let mut other = SlowHost::new(&world, settings(1.0, 12.0)).unwrap();
    let mut body = Body::ball(2.0, 0.05, Vec3::z() * 0.0505, Vec3::new(0.2, 0.0, -0.1));
    (body.gravity, body.turning) = (Vec3::z() * -9.81, Vec3::new(1.0, 3.0, -2.0));
    let mut rig = Rig::new(&[&ball, &floor], vec![body, Body::fixed()], settings(1.0, 12.0), 0.02);
    for _ in 0..15 {
        let mut inputs = rig.inputs();
        let body = &rig.bodies[0];
        let arm = body.orientation * center;
        inputs[0].state.position = (body.position - arm).into();
        inputs[0].state.linear_velocity = (body.velocity - body.turning.cross(&arm)).into();
        if let Dynamics::Free { mass_center, .. } = &mut inputs[0].dynamics {
            *mass_center = center.into();
        }
        (inputs[0].interface, inputs[1].interface) = (ids[0], ids[1]);
        other.step(0.02, &inputs).unwrap();
        rig.step();
        let (one, two) =
            (rig.slow.wrench_common(rig.interfaces[0]).unwrap(), other.wrench_common(ids[0]).unwrap());
        let size = one.force.norm() + 1e-3;
        assert!((one.force - two.force).norm() <= 1e-6 * size, "{one:?} {two:?}");
        assert!((one.moment - (two.moment - arm.cross(&two.force))).norm() <= 1e-6 * size, "{one:?} {two:?}");
    }
}

#[test]
fn a_prescribed_group_gets_the_reaction() {
    let mut rig = rig(Config::default(), 0);
    // The second ball stays out of reach.
    rig.bodies[1].position.z = 5.0;
    rig.bodies[0].gravity = Vec3::zeros();
    let (mut ball, mut floor) = (Vec3::zeros(), Vec3::zeros());
    for _ in 0..20 {
        rig.step();
        ball += rig.slow.wrench_common(rig.interfaces[0]).unwrap().force;
        floor += rig.slow.wrench_common(rig.interfaces[2]).unwrap().force;
    }
    assert!(rig.bodies[0].velocity.z > 0.0 && ball.norm() > 1.0);
    assert!((ball + floor).norm() < 1e-9 * ball.norm(), "{ball} {floor}");
}
