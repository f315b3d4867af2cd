//! A mesh outside its model's folder, behind a link: every command that reads models refuses it, and accepts
//! it where `--allow-files-below` names its folder.
#![cfg(unix)]

use crate::common;
use crate::common::pong;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

const BALL: &str = r#"(format: "pong-model", version: 1, name: "ball", surfaces: { "soft": (stiffness: 1e5) },
    root: (name: "ball", surface: "soft", groups: [(name: "inner", groups: [(name: "core", primitives: [
        Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)])])]))"#;
const SHEET: &str = r#"(format: "pong-model", version: 1, name: "sheet", surfaces: { "rigid": (stiffness: 1e6) },
    root: (name: "sheet", surface: "rigid", primitives: [TriangleMesh(name: "floor", file: "floor.obj")]))"#;
const FLOOR: &str = "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nf 1 2 3\n";
const REST: &str = r#"(format: "pong-scene", version: 1, name: "rest",
    models: { "ball": "own/ball.ron", "sheet": "own/sheet.ron" },
    objects: [
        (name: "ball", model: "ball", bodies: [
            (motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0.5, -0.5, 0.0999))]),
        (name: "sheet", model: "sheet", bodies: [(motion: Fixed)])],
    pairs: [("ball", "sheet")], gravity: (0, 0, -9.81),
    integrator: RungeKutta4, step: 1e-3, duration: 0.032)"#;

/// A scene whose sheet has its mesh in `other`, behind a link.
fn folder(test: &str) -> PathBuf {
    let folder = common::folder(&format!("allowed_folders/{test}"), &[("rest.ron", REST)]);
    for name in ["own", "other"] {
        std::fs::create_dir(folder.join(name)).unwrap();
    }
    std::fs::write(folder.join("own/ball.ron"), BALL).unwrap();
    std::fs::write(folder.join("own/sheet.ron"), SHEET).unwrap();
    std::fs::write(folder.join("other/floor.obj"), FLOOR).unwrap();
    symlink("../other/floor.obj", folder.join("own/floor.obj")).unwrap();
    folder
}

/// The command is refused only for the file outside, with a cure, and works where that is allowed.
fn needs_leave(folder: &Path, command: &[&str]) {
    let (code, out, err) = pong(folder, command);
    assert!(
        code == 1 && err.contains("floor.obj") && err.contains("outside"),
        "{command:?}: {code} {out}{err}"
    );
    let another = [command, &["--allow-files-below", "own"]].concat();
    assert_eq!(pong(folder, &another).0, 1, "{command:?}: another folder is allowed");
    let allowed = [command, &["--allow-files-below", "own", "--allow-files-below", "other"]].concat();
    let (code, out, err) = pong(folder, &allowed);
    assert_eq!(code, 0, "{command:?}: {out}{err}");
}

#[test]
fn models_and_scenes_read_outside_their_folder_with_leave() {
    let folder = folder("scenes");
    for command in [
        "check own/sheet.ron",
        "run rest.ron --quiet",
        "run rest.ron --quiet --log log --every-step --overwrite",
        "advise rest.ron",
        "modes rest.ron",
        "interface rest.ron --of ball --on sheet",
        "advise own/sheet.ron --mass 1 --step 1e-3",
        "trade rest.ron --quiet --halvings 1 --rounds 1 --levers step -o traded",
        "tune rest.ron --quiet --rounds 2 --frames 16",
        "tune rest.ron --quiet --rounds 2 --frames 16 -o tuned --force",
    ] {
        needs_leave(&folder, &command.split(' ').collect::<Vec<_>>());
    }
}

/// A log has copies of its meshes: it needs no permission, unless a link replaces one of them.
#[test]
fn logs_read_outside_their_folder_with_leave() {
    let folder = folder("logs");
    let run = "run rest.ron --quiet --log log --every-step --allow-files-below other";
    assert_eq!(pong(&folder, &run.split(' ').collect::<Vec<_>>()).0, 0);
    assert_eq!(pong(&folder, &["replay", "log", "--quiet"]).0, 0);
    let copy = folder.join("log/models/sheet/floor.obj");
    std::fs::remove_file(&copy).unwrap();
    symlink(folder.join("other/floor.obj"), &copy).unwrap();
    for command in [
        "replay log --quiet",
        "view log --quiet",
        "trade log --quiet --rounds 1 --levers step -o traded",
        "tune log --quiet --rounds 2 --frames 16 -o tuned --force",
    ] {
        needs_leave(&folder, &command.split(' ').collect::<Vec<_>>());
    }
    // Commands that read no model need no permission.
    assert_eq!(pong(&folder, &["log", "log"]).0, 0);
}
