//! Logs on the command line: `pong run --log`, `pong log`, `pong replay`; a run that is killed; a full disk.

use crate::common;
use pong_record::TangentRow;
use pong_record::table::TableFile;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const BLOCK: &str = r#"(format: "pong-model", version: 1, name: "block",
    surfaces: { "steel": (stiffness: 1e5, normal: Linear(damping: 50.0), friction: Bristle(mu: 0.3, damping: 50.0)) },
    root: (name: "block", surface: "steel", primitives: [
        Point(name: "p1", position: (0.1, 0.1, -0.05)), Point(name: "p2", position: (-0.1, 0.1, -0.05)),
        Point(name: "p3", position: (-0.1, -0.1, -0.05)), Point(name: "p4", position: (0.1, -0.1, -0.05))]))"#;
const TABLE: &str = r#"(format: "pong-model", version: 1, name: "table",
    surfaces: { "stone": (stiffness: inf, friction: Bristle(mu: 0.3)) },
    root: (name: "table", surface: "stone", primitives: [
        Plane(name: "top", normal: (0.0, 0.0, 1.0), offset: 0.0)]))"#;
const SLIDE: &str = r#"(format: "pong-scene", version: 1, name: "slide",
    models: { "block": "block.ron", "table": "table.ron" },
    objects: [
        (name: "table", model: "table", bodies: [(motion: Fixed)]),
        (name: "block", model: "block", bodies: [(motion: Free, mass: 2.0, inertia: Diagonal(8e-3, 8e-3, 1e-2),
            position: (0, 0, 0.0499), linear_velocity: (0.4, 0, 0), angular_velocity: (0, 0, 2))])],
    pairs: [("block", "table")], gravity: (0, 0, -9.81),
    integrator: RungeKutta4, step: 2e-4, duration: 0.2, record_every: 10, ledger: true)"#;

fn folder(test: &str) -> PathBuf {
    let files = [("block.ron", BLOCK), ("table.ron", TABLE), ("slide.ron", SLIDE)];
    common::folder(&format!("replay/{test}"), &files)
}

fn pong(folder: &Path, arguments: &str) -> (i32, String, String) {
    common::pong(folder, &arguments.split(' ').collect::<Vec<_>>())
}

#[test]
fn a_run_with_every_step_in_the_log_replays_to_the_bit() {
    let folder = folder("exact");
    for (integrator, name) in [
        ("RungeKutta4", "rk4"),
        ("SemiImplicitEuler", "euler"),
        ("ZeroOrderHold(substeps: 2, delay_frames: 1)", "hold"),
    ] {
        std::fs::write(folder.join("slide.ron"), SLIDE.replace("RungeKutta4", integrator)).unwrap();
        let (code, _, err) = pong(&folder, &format!("run slide.ron -q --log {name} --every-step"));
        assert_eq!((code, err.as_str()), (0, ""));
        let (code, out, err) = pong(&folder, &format!("replay {name}"));
        assert_eq!((code, err.as_str()), (0, ""), "{integrator}");
        assert!(out.starts_with("1001 frames with ") && out.ends_with(": the same bits\n"), "{out}");
        let (code, with_worker, _) = pong(&folder, &format!("replay {name} --workers 2"));
        assert_eq!((code, with_worker), (0, out));
    }
    let (code, out, _) = pong(&folder, "log hold");
    assert_eq!(code, 0);
    for part in [
        "slide: 1001 frames, t = 0 … 0.2 s, ",
        "ZeroOrderHold(substeps: 2, delay_frames: 1), 1 commit per frame",
        "pair `block`, `table`",
    ] {
        assert!(out.contains(part), "no `{part}` in\n{out}");
    }
}

#[test]
fn a_change_of_one_bit_is_named() {
    let folder = folder("named");
    assert_eq!(pong(&folder, "run slide.ron -q --log log --every-step").0, 0);
    let path = folder.join("log/wrenches.npy");
    let mut bytes = std::fs::read(&path).unwrap();
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    // Frame 345, second body (the block), z of the force.
    bytes[start + (345 * 2 + 1) * 48 + 16] ^= 1;
    std::fs::write(&path, bytes).unwrap();
    let (code, out, err) = pong(&folder, "replay log");
    assert_eq!((code, out.as_str()), (1, "345 of 1001 frames replayed: the same bits\n"));
    assert!(err.starts_with("frame 345, t = 0.069 s, wrench on `block`: force is ["), "{err}");
    assert!(err.lines().count() == 1 && err.contains(" in the log and ["), "{err}");
    assert_eq!(pong(&folder, "replay log --tolerance 1e-12 -q").0, 0);
}

#[test]
fn a_log_of_some_steps_says_why_it_cannot_be_replayed() {
    let folder = folder("some");
    assert_eq!(pong(&folder, "run slide.ron -q --log log").0, 0);
    let (code, out, err) = pong(&folder, "replay log");
    assert_eq!((code, out.as_str()), (1, "1 of 101 frames replayed: the same bits\n"));
    assert!(
        err.starts_with("not exact from frame 1 on: 9 commits before frame 1 belong to no frame"),
        "{err}"
    );
    assert!(err.contains("--every-step"), "{err}");
}

#[test]
fn csv_of_a_log_is_csv_of_the_run() {
    let folder = folder("csv");
    let (code, _, err) = pong(&folder, "run slide.ron -q --log log -o direct");
    assert_eq!((code, err.as_str()), (0, ""));
    let (code, out, err) = pong(&folder, "log log -q --csv exported");
    assert_eq!((code, out.as_str(), err.as_str()), (0, "", ""));
    for name in ["states", "wrenches", "contacts", "energies"] {
        let read = |from: &str| std::fs::read_to_string(folder.join(format!("{from}/{name}.csv"))).unwrap();
        assert!(read("direct").lines().count() > 100, "{name}");
        assert_eq!(read("direct"), read("exported"), "{name}");
    }
}

#[test]
fn a_log_is_not_overwritten_by_accident() {
    let folder = folder("again");
    assert_eq!(pong(&folder, "run slide.ron -q --log log").0, 0);
    let (code, _, err) = pong(&folder, "run slide.ron -q --log log");
    assert!(
        code == 1 && err.contains("log: holds a log already (`contacts.npy`); name another folder"),
        "{err}"
    );
    assert_eq!(pong(&folder, "run slide.ron -q --log log --overwrite").0, 0);
    std::fs::write(folder.join("file"), "").unwrap();
    let (code, _, err) = pong(&folder, "run slide.ron -q --log file/log");
    assert!(code == 1 && err.contains("cannot be written") && err.contains("--log"), "{err}");
}

/// Reads the header of a table as NumPy does: number of rows, and their offset.
fn rows(path: &Path) -> Option<(usize, usize, usize)> {
    let bytes = std::fs::read(path).ok()?;
    let text = usize::from(u16::from_le_bytes([*bytes.get(8)?, *bytes.get(9)?]));
    let header = std::str::from_utf8(bytes.get(10..10 + text)?).ok()?;
    let shape = header.split("'shape': (").nth(1)?;
    let count = shape.split(',').next()?.trim().parse().ok()?;
    Some((count, 10 + text, bytes.len()))
}

#[test]
fn a_run_that_is_killed_keeps_every_row_that_was_flushed() {
    let folder = folder("killed");
    let long =
        SLIDE.replace("duration: 0.2", "duration: 100000.0").replace("record_every: 10", "record_every: 1");
    std::fs::write(folder.join("long.ron"), long).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_pong"))
        .args(["run", "long.ron", "-q", "--log", "log"])
        .current_dir(&folder)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let frames = folder.join("log/frames.npy");
    let begun = Instant::now();
    // Flushed twice, so that there is data beyond the rows flushed first.
    while rows(&frames).is_none_or(|(count, ..)| count == 0) && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(300));
    run.kill().unwrap();
    run.wait().unwrap();
    let (count, start, length) = rows(&frames).unwrap();
    assert!(count > 0 && start + count * 48 <= length, "{count} rows in {length} bytes");
    for (table, size) in [("states", 208), ("wrenches", 96), ("energies", 64)] {
        let (more, start, length) = rows(&folder.join(format!("log/{table}.npy"))).unwrap();
        assert!(more >= count && start + more * size <= length, "{table}: {more} rows in {length} bytes");
    }
    let (code, out, err) = pong(&folder, "replay log");
    assert!(err.starts_with("warning: the log was not closed"), "{err}");
    assert!(code == 0 && out.starts_with(&format!("{count} frames with ")), "{out}{err}");
}

/// With a limit of 1 MiB for files, a table cannot grow further, as on a full disk.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_and_the_run_goes_on() {
    let folder = folder("full");
    let long = SLIDE.replace("duration: 0.2", "duration: 4.0").replace("record_every: 10", "record_every: 1");
    std::fs::write(folder.join("long.ron"), long).unwrap();
    let limited =
        format!("trap '' XFSZ; ulimit -f 1024; exec {} run long.ron --log log", env!("CARGO_BIN_EXE_pong"));
    let output = Command::new("bash").args(["-c", &limited]).current_dir(&folder).output().unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(1), "{out}{err}");
    assert!(out.contains("slide: t = 4 s"), "the run did not go on: {out}{err}");
    assert!(
        err.contains(".npy: cannot be written: File too large") && err.contains("the log ends after "),
        "{err}"
    );
    let (_, out, _) = pong(&folder, "log log");
    assert!(out.contains("not closed"), "{out}");
    assert_eq!(pong(&folder, "replay log -q").0, 0, "what was flushed is whole");
}

/// A ball of 1e5 N/m on the ground: each frame has its stiffness up against up, on both bodies.
#[test]
fn the_tangents_of_a_log_are_those_of_its_frames() {
    let ball = r#"(format: "pong-model", version: 1, name: "ball",
        surfaces: { "soft": (stiffness: 1e5, normal: Linear(damping: 20.0), friction: Bristle(mu: 0.5, damping: 10.0)) },
        root: (name: "ball", surface: "soft", primitives: [Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)]))"#;
    let folder = common::resting_ball("replay/tangents", ball, 0.02);
    assert_eq!(common::pong(&folder, &["run", "rest.ron", "--quiet", "--every-step", "--log", "log"]).0, 0);
    let (code, out, err) = common::pong(&folder, &["log", "log", "--quiet", "--tangents", "tangents.npy"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert_eq!(out, "tangents.npy: 21 tangents\n");
    let mut table = TableFile::<TangentRow>::open(&folder.join("tangents.npy"), None).unwrap();
    let mut rows = Vec::new();
    table.read(0, table.rows(), &mut rows).unwrap();
    assert_eq!(rows.len(), 21);
    for (index, row) in rows.iter().enumerate() {
        assert_eq!((row.frame, row.body_a, row.body_b, row.by_differences), (index as u64, 0, 1, 0));
        for (i, j, sign) in [(2, 2, 1.0), (2, 8, -1.0), (8, 2, -1.0), (8, 8, 1.0)] {
            assert!((row.stiffness[i][j] - sign * 1e5).abs() < 1e-4, "{}", row.stiffness[i][j]);
            assert!((row.damping[i][j] - sign * 20.0).abs() < 1e-9, "{}", row.damping[i][j]);
        }
    }
    let refused = common::pong(&folder, &["log", "log", "--quiet", "--tangents", "none/tangents.npy"]);
    assert!(refused.0 == 1 && refused.2.contains("none/tangents.npy"), "{refused:?}");
}
