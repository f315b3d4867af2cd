//! `pong modes` on the command line.

use crate::common;
use crate::common::pong;
use serde_json::Value;
use std::f64::consts::TAU;
use std::path::PathBuf;

const BALL: &str = r#"(format: "pong-model", version: 1, name: "ball",
    surfaces: { "soft": (stiffness: 1e5, normal: Linear(damping: 20.0), friction: Bristle(mu: 0.5, damping: 10.0)) },
    root: (name: "ball", surface: "soft", primitives: [Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)]))"#;

fn folder(test: &str) -> PathBuf {
    common::resting_ball(&format!("modes/{test}"), BALL, 2.0)
}

/// A ball of 1 kg on 1e5 N/m: √(1e5)/2π Hz along z, c/(2√(km)) of critical damping, and a rigid turn about z.
#[test]
fn a_resting_ball_has_its_vertical_mode() {
    let folder = folder("ball");
    let (code, table, err) = pong(&folder, &["modes", "rest.ron", "--settle"]);
    assert_eq!(code, 0, "{err}");
    assert!(table.starts_with("rest, at rest from t = "), "{table}");
    assert!(table.contains("50.3292  0.0316228  `ball` moves along z (100 %)"), "{table}");
    assert!(
        table.contains("ball/ball/skin · ground/ground/floor 100 %") && table.contains("rigid"),
        "{table}"
    );
    assert_eq!(err, "");
    let (_, text, _) = pong(&folder, &["modes", "rest.ron", "--settle", "--json"]);
    let json: Value = serde_json::from_str(&text).unwrap();
    let modes = json["modes"].as_array().unwrap();
    let wanted = 1e5_f64.sqrt() / TAU;
    let frequency = |mode: &Value| mode["frequency_hz"].as_f64().unwrap();
    let vertical = modes.iter().find(|mode| (frequency(mode) / wanted - 1.0).abs() < 1e-9).unwrap();
    assert!((vertical["damping_ratio"].as_f64().unwrap() - 20.0 / (2.0 * 1e5_f64.sqrt())).abs() < 1e-9);
    let (_, csv, _) = pong(&folder, &["modes", "rest.ron", "--csv"]);
    assert!(csv.starts_with("mode,kind,rate_1_s2,") && csv.lines().count() == 7, "{csv}");
}

#[test]
fn a_state_without_equilibrium_is_noted_and_bad_arguments_are_refused() {
    let folder = folder("states");
    let deep = std::fs::read_to_string(folder.join("rest.ron")).unwrap().replace("0.0999", "0.099");
    std::fs::write(folder.join("rest.ron"), deep).unwrap();
    let (code, table, err) = pong(&folder, &["modes", "rest.ron"]);
    assert_eq!(code, 0);
    assert!(table.starts_with("rest, at the start: 1 free body, 1 contact (0 slipping)"), "{table}");
    assert!(err.contains("note: `ball` is not in equilibrium: its acceleration is 90.19 m/s²"), "{err}");
    let cases = [
        (&["modes", "rest.ron", "--at=-1"][..], 1, "--at: it is -1 s"),
        (&["modes", "rest.ron", "--mode", "3"], 2, "--log"),
        (&["modes", "rest.ron", "--mode", "7", "--log", "log"], 1, "there are 6 modes"),
        (&["modes", "ball.ron"], 1, "this is a model, not a scene"),
    ];
    for (arguments, code, cause) in cases {
        let (ended, _, err) = pong(&folder, arguments);
        assert_eq!(ended, code, "{arguments:?}: {err}");
        assert!(err.contains(cause), "{arguments:?}: {err}");
    }
}

/// The log of a mode is played by `pong view`: its bodies swing about the state.
#[test]
fn a_shape_is_written_as_a_log() {
    let folder = folder("log");
    let (code, out, err) = pong(&folder, &["modes", "rest.ron", "--settle", "--mode", "6", "--log", "shape"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("shape: mode of ") && out.contains("pong view shape"), "{out}");
    let (code, _, err) = pong(&folder, &["view", "shape"]);
    assert_eq!(code, 0, "{err}");
    let (code, out, _) = pong(&folder, &["log", "shape", "--csv", "tables"]);
    assert!(code == 0 && out.contains("193 frames") && out.contains("0 contacts"), "{out}");
    assert_eq!(pong(&folder, &["modes", "rest.ron", "--mode", "6", "--log", "shape"]).0, 1);
    assert_eq!(pong(&folder, &["modes", "rest.ron", "--mode", "6", "--log", "shape", "--overwrite"]).0, 0);
}
