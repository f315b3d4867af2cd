//! The examples, run as their heads say, against known answers.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// Names of all examples.
const EXAMPLES: [&str; 3] = ["minimal", "runge_kutta_host", "own_law"];

/// Output of a command that succeeds in the folder of the examples and their models.
fn succeed(command: &mut Command) -> Output {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let run = command.current_dir(folder).output().unwrap();
    assert!(run.status.success(), "{command:?}: {}", String::from_utf8_lossy(&run.stderr));
    run
}

/// Folder of the programs of all examples, which are built first.
///
/// With `--workspace` every dependency has the features that it has for `cargo test --workspace`, after which nothing is left
/// to build. With `--package pong` the engine would be built a second time.
fn programs() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let mut build = Command::new(env!("CARGO"));
        build.args(["build", "--quiet", "--workspace"]);
        succeed(EXAMPLES.iter().fold(&mut build, |build, name| build.args(["--example", name])));
        Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap().join("debug/examples")
    })
}

/// Output of an example.
fn output(example: &str) -> String {
    String::from_utf8(succeed(&mut Command::new(programs().join(example))).stdout).unwrap()
}

/// k·δ = 20 kN/m · 1 mm.
#[test]
fn minimal_prints_the_force_of_the_spring() {
    assert_eq!(output("minimal"), "force on the ball: 20.000 N up\n");
}

/// 0.1 m − m·g/k + 0.3 mm·exp(−15/s·t)·(cos ωt + 15/s/ω·sin ωt) with ω = 140.62 rad/s at t = 0.05 s.
#[test]
fn runge_kutta_host_follows_the_damped_oscillator() {
    let expected = "height after 0.050 s: 0.099624 m\nclosed form: 0.099624 m, difference below 1 nm: true\n";
    assert_eq!(output("runge_kutta_host"), expected);
}

/// k·δ·(1 + (δ/d)²) with k = 10 kN/m and d = 1 mm.
#[test]
fn own_law_prints_the_forces_of_the_stiffening_spring() {
    let expected = "0.5 mm deep: 6.250 N\n1.0 mm deep: 20.000 N\n2.0 mm deep: 100.000 N\n";
    assert_eq!(output("own_law"), expected);
}
