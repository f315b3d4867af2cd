//! `pong fit` on the command line.

use crate::common::{self, pong};
use std::path::{Path, PathBuf};

const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground", surfaces: { "rigid": (stiffness: inf) },
    root: (name: "ground", surface: "rigid", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#;

const SCENE: &str = r#"(
    format: "pong-scene", version: 1, name: "drop",
    models: { "ball": "ball.ron", "ground": "ground.ron" },
    objects: [
        (name: "ball", model: "ball", bodies: [(motion: Free, mass: 1, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, 0.12))]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)]),
    ],
    pairs: [("ball", "ground")], gravity: (0, 0, -9.81),
    integrator: RungeKutta4, step: 5e-4, duration: 0.2, record_every: 4,
)"#;

fn write_ball(folder: &Path, stiffness: &str) {
    let text = format!(
        r#"(format: "pong-model", version: 1, name: "ball",
    surfaces: {{ "soft": (stiffness: {stiffness}, normal: Linear(damping: 20, ramp: 1e-3)) }},
    root: (name: "ball", surface: "soft", primitives: [Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)]))"#
    );
    std::fs::write(folder.join("ball.ron"), text).unwrap();
}

/// A scene with a log of a stiffer ball than its own.
fn folder(test: &str) -> PathBuf {
    let folder = common::folder(&format!("fit/{test}"), &[("ground.ron", GROUND), ("drop.ron", SCENE)]);
    write_ball(&folder, "2e4");
    assert_eq!(pong(&folder, &["run", "drop.ron", "-q", "--log", "log"]).0, 0);
    write_ball(&folder, "8e3");
    folder
}

const FREE: &str = "surface.ball.soft.stiffness=1e3..1e5";

#[test]
fn a_stiffness_is_found_from_a_log_and_its_files_are_written() {
    let folder = folder("found");
    let noise = ["--noise", "position=1e-4", "--noise", "rotation=1e-3", "--noise", "velocity=1e-3"];
    let more = ["--noise", "angular_velocity=1e-2", "--noise", "force=1", "--noise", "moment=1"];
    let mut line = vec!["fit", "drop.ron", "--data", "log", "--free", FREE, "--tries", "3", "-o", "out"];
    line.extend(noise.iter().chain(&more));
    let (code, page, error) = pong(&folder, &line);
    assert_eq!(code, 0, "{page}{error}");
    for part in [
        "stiffness: 20000,",
        "Values within one standard error",
        "## Correlations",
        "later part of each record",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
    for file in ["fit.md", "parameters.csv", "profiles.csv", "fit.svg"] {
        assert!(std::fs::metadata(folder.join("out").join(file)).unwrap().len() > 50, "{file}");
    }
}

#[test]
fn wrong_arguments_and_data_are_refused() {
    let folder = folder("refused");
    let cases = [
        (&["--data", "log", "--free", "surface.ball.soft.stiffness=1e3"][..], 2, "give NAME=LOW..HIGH"),
        (&["--data", "log", "--free", FREE, "--noise", "height=1"], 2, "give any of position"),
        (&["--data", "log", "--free", FREE, "--noise", "position=0"], 2, "give a number above zero, m"),
        (&["--data", "log", "--free", FREE, "--test", "much"], 2, "give a share such as 25%"),
        (&["--data", "log", "--free", FREE], 1, "the noise of its sensor is not known"),
        (&["--data", "none.csv", "--free", FREE], 1, "name a CSV file or the folder"),
        (&["--data", "drop.ron", "--free", FREE], 1, "name columns among"),
        (&["--data", "log"], 2, "--free <NAME[=LOW..HIGH]>"),
        (&["--data", "log", "--momentum", "--free", FREE], 2, "cannot be used with"),
        (&["--data", "log", "--free", FREE, "--body", "ball"], 2, "cannot be used with"),
        (&["--data", "log", "--momentum"], 1, "0 touches of one point between two flights"),
        (&["--data", "log", "--momentum", "--body", "ground"], 1, "name one of: ball"),
        (&["--data", "log", "--free", "surface.ball.hard.stiffness=1..2"], 1, "there is no such surface"),
    ];
    for (arguments, expected, part) in cases {
        let mut line = vec!["fit", "drop.ron", "-q"];
        line.extend(arguments);
        let (code, _, error) = pong(&folder, &line);
        assert!(code == expected && error.contains(part), "{arguments:?}: {code} {error}");
    }
}
