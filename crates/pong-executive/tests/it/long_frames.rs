//! Long frames: the integrator `LongFrame` beside short steps.

use crate::common;
use pong_executive::Simulation;

/// A ball that flies towards the ground at 0.3 m/s, without gravity, and one that lies on it with gravity.
fn ball(integrator: &str, step: f64, height: f64, gravity: f64, speed: f64) -> Simulation {
    let text = format!(
        r#"(format: "pong-scene", version: 1, name: "ball",
            models: {{ "ball": "ball.ron", "ground": "ground.ron" }},
            objects: [
                (name: "ball", model: "ball", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 5e-3, 6e-3),
                    position: (0.0, 0.0, {height:?}), linear_velocity: (0.0, 0.0, {speed:?}))]),
                (name: "ground", model: "ground", bodies: [(motion: Fixed)]),
            ],
            pairs: [("ball", "ground")],
            gravity: (0.0, 0.0, {gravity:?}), integrator: {integrator}, step: {step:?}, duration: 1.0)"#
    );
    common::simulation_of_balls(&text)
}

fn speed(simulation: &Simulation) -> f64 {
    simulation.twist(simulation.bodies().next().unwrap().0).linear.z
}

#[test]
fn a_ball_rebounds_in_long_frames_as_in_short_steps() {
    let mut short = ball("RungeKutta4", 1e-5, 0.13, 0.0, -0.3);
    short.run_for(0.5).unwrap();
    let exact = speed(&short);
    for (integrator, height) in
        [("LongFrame()", 0.13), ("LongFrame()", 0.137), ("LongFrame(delay_frames: 2)", 0.17)]
    {
        let mut long = ball(integrator, 0.05, height, 0.0, -0.3);
        let mut substeps = 0;
        for _ in 0..20 {
            long.step().unwrap();
            substeps = substeps.max(long.long_frame_report().unwrap().substeps);
        }
        assert!((speed(&long) / exact - 1.0).abs() < 0.02, "{integrator} {height}: {} {exact}", speed(&long));
        assert!((150..400).contains(&substeps), "{substeps}");
    }
    // Held without substeps, the contact gains energy.
    let mut held = ball("ZeroOrderHold()", 0.05, 0.13, 0.0, -0.3);
    let ended = (0..20).try_for_each(|_| held.step());
    assert!(ended.is_err() || speed(&held) > 1.0);
}

#[test]
fn a_ball_rests_in_long_frames_and_no_step_is_called_too_long() {
    let mut long = ball("LongFrame()", 0.05, 0.1, -9.81, 0.0);
    assert!(long.step_warnings().is_empty(), "{:?}", long.step_warnings());
    (0..200).for_each(|_| long.step().unwrap());
    assert!(speed(&long).abs() < 1e-9, "{}", speed(&long));
    let height = long.pose(long.bodies().next().unwrap().0).position.z;
    assert!((height - (0.1 - 9.81 / 1e5)).abs() < 1e-9, "{height}");
    assert!(!long.long_frame_report().unwrap().status.theta_mismatch);
}

#[test]
fn substeps_have_a_limit() {
    let mut long = ball("LongFrame(substeps_max: 4)", 0.05, 0.13, 0.0, -0.3);
    let mut limited = false;
    for _ in 0..20 {
        long.step().unwrap();
        let report = long.long_frame_report().unwrap();
        limited |= report.status.substep_limit && report.substeps <= 4;
        assert!(speed(&long).abs() < 0.31);
    }
    assert!(limited);
}

/// A caller that takes the world, but changes nothing, keeps the impulses that are on their way.
#[test]
fn a_late_host_keeps_its_queue_when_the_world_is_taken() {
    let run = |take: bool| {
        let mut long = ball("LongFrame(delay_frames: 2)", 0.05, 0.17, 0.0, -0.3);
        for _ in 0..20 {
            long.step().unwrap();
            if take {
                long.world_mut();
            }
        }
        speed(&long)
    };
    let (left_alone, taken) = (run(false), run(true));
    assert!(left_alone > 0.2, "{left_alone}");
    assert!((taken / left_alone - 1.0).abs() < 1e-9, "{taken} {left_alone}");
}
