//! A ball on the ground, in a folder of its own.

use pong_study::sweep::{PlanSettings, Row, Settings, Study, study};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

pub const STIFFNESS: f64 = 1e5;
pub const RADIUS: f64 = 0.1;
pub const GRAVITY: f64 = 9.81;

const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground",
    surfaces: { "rigid": (stiffness: inf) },
    root: (name: "ground", surface: "rigid", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#;

/// A ball of 1 kg without damping, at a height and a speed; `more` adds fields.
pub fn ball_scene(
    test: &str,
    (height, speed): (f64, f64),
    (step, duration): (f64, f64),
    more: &str,
) -> PathBuf {
    let folder = pong_testkit::scratch(env!("CARGO_TARGET_TMPDIR"), test);
    let ball = |stiffness: f64| {
        format!(
            r#"(format: "pong-model", version: 1, name: "ball", surfaces: {{ "soft": (stiffness: {stiffness:?},
            friction: Bristle(mu: 0.5)) }}, root: (name: "ball", surface: "soft", primitives: [
                Sphere(name: "skin", center: (0, 0, 0), radius: {RADIUS:?})]))"#
        )
    };
    let scene = format!(
        r#"(format: "pong-scene", version: 1, name: "{test}", models: {{ "ball": "ball.ron", "ground": "ground.ron" }},
        objects: [
            (name: "ball", model: "ball", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3),
                position: (0.0, 0.0, {height:?}), linear_velocity: (0.0, 0.0, {speed:?}))]),
            (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
        pairs: [("ball", "ground")], gravity: (0.0, 0.0, {:?}), integrator: RungeKutta4,
        step: {step:?}, duration: {duration:?}, {more})"#,
        -GRAVITY
    );
    let files =
        [("ball.ron", ball(STIFFNESS)), ("soft_ball.ron", ball(0.5 * STIFFNESS)), ("scene.ron", scene)];
    files.iter().for_each(|(name, text)| std::fs::write(folder.join(name), text).unwrap());
    std::fs::write(folder.join("ground.ron"), GROUND).unwrap();
    folder.join("scene.ron")
}

/// One round of everything, with frames of the given length.
pub fn settings(frame_s: f64, halvings: u32) -> Settings {
    let plan = PlanSettings { frame_s: Some(frame_s), halvings: Some(halvings), ..PlanSettings::default() };
    Settings { plan, rounds: 1, ..Settings::default() }
}

pub fn run(scene: &Path, settings: &Settings) -> Study {
    let output = scene.parent().unwrap().join("out");
    study(scene, &output, settings, &mut |_| ControlFlow::Continue(())).unwrap()
}

pub fn row<'a>(study: &'a Study, name: &str) -> &'a Row {
    let names: Vec<&str> = study.rows.iter().map(|row| row.name.as_str()).collect();
    study.rows.iter().find(|row| row.name == name).unwrap_or_else(|| panic!("{name} is none of {names:?}"))
}
