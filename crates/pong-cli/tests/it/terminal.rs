//! Output to a terminal, and the exit code when output is lost.

#![cfg(target_os = "linux")]

use crate::common;
use std::fs::{File, OpenOptions};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Names with a clear-screen sequence, a line end, a C1 introducer and a bidirectional override.
const HOSTILE: &str = r#"(format: "pong-model", version: 1, name: "e\u{1b}[2Jvil",
    surfaces: { "so\u{9b}31mft": (stiffness: 1e5) },
    root: (name: "ro\u{1b}]0;title\u{7}ot", surface: "so\u{9b}31mft", primitives: [
        Sphere(name: "a\nerror: forged", center: (0, 0, 0), radius: RADIUS),
        Sphere(name: "\u{202e}nor", center: (0, 0, 1), radius: 1)]))"#;

const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground",
    surfaces: { "so\u{9b}31mft": (stiffness: inf) },
    root: (name: "ground", surface: "so\u{9b}31mft", primitives: [
        Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#;

const SCENE: &str = r#"(format: "pong-scene", version: 1, name: "sc\u{1b}[2Jene",
    models: { "ball": "good.ron", "ground": "ground.ron" },
    objects: [
        (name: "=cmd\u{1b}[2J", model: "ball", bodies: [
            (motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0, 0, 0.1))]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
    pairs: [("=cmd\u{1b}[2J", "ground")], gravity: (0, 0, -9.81),
    integrator: RungeKutta4, step: 1e-3, duration: 0.01, ledger: true)"#;

fn folder(test: &str) -> PathBuf {
    let (good, bad) = (HOSTILE.replace("RADIUS", "0.1"), HOSTILE.replace("RADIUS", "0"));
    let files = [("good.ron", &*good), ("bad.ron", &*bad), ("ground.ron", GROUND), ("scene.ron", SCENE)];
    common::folder(&format!("terminal/{test}"), &files)
}

fn full() -> File {
    OpenOptions::new().write(true).open("/dev/full").unwrap()
}

fn pong(folder: &Path, arguments: &[&str], out: Stdio, err: Stdio) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pong"));
    command.args(arguments).current_dir(folder).stdout(out).stderr(err).output().unwrap()
}

fn assert_plain(text: &str, what: &str) {
    let steers = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
    assert!(!text.contains(steers), "{what}: {text:?}");
    assert!(!text.contains("\nerror: forged"), "{what}: {text:?}");
}

#[test]
fn names_steer_no_terminal() {
    let folder = folder("names");
    let commands = [
        &["check", "good.ron", "ground.ron"][..],
        &["check", "bad.ron"],
        &["run", "scene.ron", "--csv", "--log", "log"],
        &["log", "log"],
        &["replay", "log"],
        &["advise", "scene.ron"],
        &["advise", "good.ron", "--mass", "1", "--rate", "1000"],
        &["run", "no\x1b[2Jne.ron"],
        &["fly\x1b[2J"],
    ];
    for arguments in commands {
        let (_, out, err) = common::pong(&folder, arguments);
        assert!(!out.is_empty() || !err.is_empty(), "{arguments:?} says nothing");
        assert_plain(&out, &format!("{arguments:?}, output"));
        assert_plain(&err, &format!("{arguments:?}, errors"));
    }
    for table in ["states", "wrenches", "contacts", "accounts"] {
        let text = std::fs::read_to_string(folder.join(format!("scene_out/{table}.csv"))).unwrap();
        assert_plain(&text, table);
        assert!(text.contains(r",'=cmd\u{1b}[2J"), "{table}: {text}");
        assert!(!text.contains(",=") && !text.contains(",\"="), "{table}: a cell is a formula: {text}");
    }
}

/// Standard error on a full disk, or with its other end closed: messages are lost, the exit code is not.
#[test]
fn a_lost_standard_error_changes_no_exit_code() {
    let folder = folder("errors");
    let commands = [
        (&["check", "good.ron"][..], 0),
        (&["check", "bad.ron"], 1),
        (&["run", "none.ron"], 1),
        (&["run", "scene.ron", "--log", "log", "--overwrite"], 0),
        (&["log", "none"], 1),
        (&["replay", "none"], 1),
        (&["view", "none"], 1),
        (&["import", "none.stl", "-o", "x.ron"], 1),
        (&["decompose", "none.stl", "-o", "x.ron"], 1),
        (&["tune", "none"], 1),
        (&["trade", "none"], 1),
        (&["modes", "none"], 1),
        (&["interface", "none", "--of", "a", "--on", "b"], 1),
        (&["advise", "none.ron", "--mass", "1"], 1),
        (&["verify", "--only", "V999"], 2),
        (&["fly"], 2),
    ];
    for (arguments, code) in commands {
        let lost = pong(&folder, arguments, Stdio::piped(), full().into());
        assert_eq!(lost.status.code(), Some(code), "{arguments:?} with a full disk");
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let cut = pong(&folder, arguments, Stdio::piped(), writer.into());
        assert_eq!(cut.status.code(), Some(code), "{arguments:?} with nobody listening");
    }
    let log = pong(&folder, &["log", "log"], Stdio::piped(), Stdio::piped());
    let told = String::from_utf8(log.stdout).unwrap();
    assert!(log.status.success() && !told.contains("not closed"), "the log is whole: {told}");
}

/// An answer that could not be written is no success; one whose reader closed the pipe is.
#[test]
fn a_lost_answer_ends_with_one() {
    let folder = folder("answers");
    for arguments in [&["check", "good.ron"][..], &["run", "scene.ron"], &["--help"], &["--version"]] {
        let lost = pong(&folder, arguments, full().into(), Stdio::piped());
        let told = String::from_utf8(lost.stderr).unwrap();
        assert_eq!(lost.status.code(), Some(1), "{arguments:?}: {told}");
        assert_eq!(told.matches("standard output: cannot be written").count(), 1, "{arguments:?}: {told}");
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let cut = pong(&folder, arguments, writer.into(), Stdio::piped());
        let told = String::from_utf8(cut.stderr).unwrap();
        assert!(cut.status.success() && !told.contains("standard output"), "{arguments:?}: {told}");
    }
    // An error keeps its own exit code.
    let usage = pong(&folder, &["verify", "--only", "V999"], full().into(), Stdio::piped());
    assert_eq!(usage.status.code(), Some(2));
}
