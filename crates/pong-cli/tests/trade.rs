//! `pong trade` as a terminal user meets it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const BALL: &str = r#"(format: "pong-model", version: 1, name: "ball", surfaces: { "soft": (stiffness: 1e5) },
    root: (name: "ball", surface: "soft", primitives: [Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)]))"#;
const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground", surfaces: { "rigid": (stiffness: inf) },
    root: (name: "ground", surface: "rigid", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#;
const REST: &str = r#"(format: "pong-scene", version: 1, name: "rest",
    models: { "ball": "ball.ron", "ground": "ground.ron" },
    objects: [
        (name: "ball", model: "ball", bodies: [
            (motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, 0.0999))]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
    pairs: [("ball", "ground")], gravity: (0, 0, -9.81),
    integrator: RungeKutta4, step: 1e-3, duration: 0.064)"#;

fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("trade_{test}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    for (name, text) in [("ball", BALL), ("ground", GROUND), ("rest", REST)] {
        std::fs::write(folder.join(format!("{name}.ron")), text).unwrap();
    }
    folder
}

fn pong(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pong")).current_dir(folder).args(arguments).output().unwrap()
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// The page and the files, for a scene and for its log; what was stopped in between does not show in errors.csv.
#[test]
fn a_scene_and_its_log_are_studied() {
    let folder = folder("studied");
    let found = pong(&folder, &["trade", "rest.ron", "--rounds", "1", "--within", "5%"]);
    assert!(found.status.success(), "{}", told(&found));
    assert!(told(&found).contains("cheapest level within 5 %"), "{}", told(&found));
    let read = |name: &str| std::fs::read_to_string(folder.join("rest_trade").join(name)).unwrap();
    assert!(told(&found).starts_with(&read("trade.md")));
    assert!(read("trade.svg").starts_with("<svg") && read("trade.csv").lines().count() > 20);
    let errors = read("errors.csv");
    let again = pong(&folder, &["trade", "rest.ron", "--rounds", "1", "--within", "5%", "--fresh", "-q"]);
    assert!(again.status.success() && told(&again).is_empty(), "{}", told(&again));
    assert_eq!(read("errors.csv"), errors);

    assert!(pong(&folder, &["run", "rest.ron", "--log", "log", "--every-step", "-q"]).status.success());
    let found = pong(&folder, &["trade", "log", "--rounds", "1", "--alternative", "same:ball=ball.ron"]);
    assert!(found.status.success(), "{}", told(&found));
    assert!(told(&found).contains("the log's own wrenches bit for bit"), "{}", told(&found));
    assert!(told(&found).contains("every frame, `same`"), "{}", told(&found));
    let found = pong(&folder, &["trade", "log", "--of", "pose"]);
    assert!(
        !found.status.success() && told(&found).contains("any of wrench, impulse, peak"),
        "{}",
        told(&found)
    );
}

#[test]
fn what_cannot_be_studied_is_told() {
    let folder = folder("refused");
    let cases = [
        (&["trade", "rest.ron", "--within", "2"][..], 2, "above 0 and below 100 %"),
        (&["trade", "rest.ron", "--of", "weight"], 2, "give any of wrench, impulse"),
        (&["trade", "rest.ron", "--frame", "-1"], 2, "unexpected argument"),
        (&["trade", "rest.ron", "--frame=-1"], 1, "--frame: it is -1 s"),
        (&["trade", "rest.ron", "--frame", "1"], 1, "hold no frame of 1 s; give a shorter --frame"),
        (&["trade", "rest.ron", "--alternative", "a:b=c"], 1, "write `alternatives` into it"),
        (&["trade", "none.ron"], 1, "name a scene file that can be read"),
    ];
    for (arguments, code, cause) in cases {
        let found = pong(&folder, arguments);
        assert_eq!(found.status.code(), Some(code), "{arguments:?}: {}", told(&found));
        assert!(told(&found).contains(cause), "{arguments:?}: {}", told(&found));
    }
}
