//! The program, run in a folder of the test's own.

use std::path::{Path, PathBuf};
use std::process::Command;

const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground", surfaces: { "rigid": (stiffness: inf) },
    root: (name: "ground", surface: "rigid", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#;

/// A folder with these files and no others.
pub fn folder(test: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = pong_testkit::scratch(env!("CARGO_TARGET_TMPDIR"), test);
    for (name, text) in files {
        std::fs::write(folder.join(name), text).unwrap();
    }
    folder
}

/// `rest.ron`: a ball of 0.1 m and 1 kg rests on a rigid plane for `duration`, s. `ball` is its model.
pub fn resting_ball(test: &str, ball: &str, duration: f64) -> PathBuf {
    let rest = format!(
        r#"(format: "pong-scene", version: 1, name: "rest",
    models: {{ "ball": "ball.ron", "ground": "ground.ron" }},
    objects: [
        (name: "ball", model: "ball", bodies: [
            (motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, 0.0999))]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
    pairs: [("ball", "ground")], gravity: (0, 0, -9.81),
    integrator: RungeKutta4, step: 1e-3, duration: {duration:?})"#
    );
    folder(test, &[("ball.ron", ball), ("ground.ron", GROUND), ("rest.ron", &rest)])
}

/// Exit code, standard output and standard error.
pub fn pong(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_pong")).args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}
