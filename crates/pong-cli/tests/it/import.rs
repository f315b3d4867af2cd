//! `pong import` on the command line.

use crate::common;
use crate::common::pong;
use std::path::PathBuf;

const TETRAHEDRON: &str = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn folder(test: &str) -> PathBuf {
    common::folder(&format!("import/{test}"), &[("part.obj", TETRAHEDRON)])
}

#[test]
fn an_imported_model_passes_the_check() {
    let folder = folder("check");
    let arguments =
        ["import", "part.obj", "-o", "part.ron", "--unit", "mm", "--stiffness", "1e6", "--mu", "0.2"];
    let (code, out, err) = pong(&folder, &arguments);
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(out, "4 vertices and 4 triangles read: 1 Polyhedron\nwritten: ./part.ron\n");
    let (code, out, err) = pong(&folder, &["check", "part.ron"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let text = std::fs::read_to_string(folder.join("part.ron")).unwrap();
    let surface = r#""default": (stiffness: 1000000.0, friction: Bristle(mu: 0.2)),"#;
    assert!(text.contains(surface) && text.contains("(0.1, 0.0, 0.0)"), "{text}");
}

#[test]
fn faults_end_with_one_and_leave_what_was_there() {
    let folder = folder("fault");
    std::fs::write(folder.join("part.ron"), "earlier").unwrap();
    std::fs::write(folder.join("broken.stl"), "solid").unwrap();
    let (code, out, err) = pong(&folder, &["import", "broken.stl", "-o", "part.ron"]);
    assert_eq!((code, out.as_str()), (1, ""));
    assert!(
        err.starts_with("error: broken.stl: [") && err.ends_with("1 fault; nothing was written\n"),
        "{err}"
    );
    assert_eq!(std::fs::read_to_string(folder.join("part.ron")).unwrap(), "earlier");
    let names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names.len(), 3, "{names:?}");
}

/// A prism of 32 sides around z, R 10 mm, 100 mm long, from docs/importing.md.
#[test]
fn a_round_part_is_found_within_a_tolerance() {
    let sides = 32_usize;
    let corner = |i: usize| {
        let turn = std::f64::consts::TAU * i as f64 / sides as f64;
        let z = if i < sides { 0 } else { 100 };
        format!("v {} {} {z}\n", 10.0 * turn.cos(), 10.0 * turn.sin())
    };
    let list = |all: Vec<usize>| all.iter().map(|i| format!(" {}", i + 1)).collect::<String>();
    let side = |i: usize| list(vec![i, (i + 1) % sides, sides + (i + 1) % sides, sides + i]);
    let mut text: String = (0..2 * sides).map(corner).collect();
    (0..sides).for_each(|i| text += &format!("f{}\n", side(i)));
    text += &format!("f{}\nf{}\n", list((0..sides).rev().collect()), list((sides..2 * sides).collect()));
    let folder = folder("round");
    std::fs::write(folder.join("pin.obj"), text).unwrap();
    let run = |tolerance: &str| {
        let arguments = [
            "import",
            "pin.obj",
            "-o",
            "pin.ron",
            "--unit",
            "mm",
            "--stiffness",
            "1e6",
            "--round",
            tolerance,
        ];
        pong(&folder, &arguments)
    };
    let (code, out, err) = run("0.2mm");
    assert_eq!(
        (code, out.as_str()),
        (0, "64 vertices and 124 triangles read: 1 Cylinder\nwritten: ./pin.ron\n")
    );
    let told = "became the Cylinder `pin`, radius 0.010000 m, 0.100000 m from end to end: the mesh is 4.82e-5 m from it at most";
    assert!(err.contains(told), "{err}");
    assert_eq!(pong(&folder, &["check", "pin.ron"]).0, 0);
    let (_, out, err) = run("0.02mm");
    assert!(out.contains("1 Polyhedron") && err.is_empty(), "{out}{err}");
    assert_eq!(run("-1").0, 2);
}

#[test]
fn notes_go_to_standard_error_and_wrong_flags_end_with_two() {
    let folder = folder("notes");
    let (code, _, err) = pong(&folder, &["import", "part.obj", "-o", "part.ron"]);
    assert_eq!(code, 0);
    let notes: Vec<_> = err.lines().filter_map(|line| line.strip_prefix("note: part.obj: [")).collect();
    assert!(notes.iter().any(|note| note.starts_with("placeholder-surface]")), "{err}");
    for wrong in [["--unit", "0"], ["--up", "x"], ["--damping", "1"]] {
        let (code, _, err) = pong(&folder, &[&["import", "part.obj", "-o", "part.ron"][..], &wrong].concat());
        assert_eq!(code, 2, "{err}");
    }
}

/// A box of 40 × 20 × 10 mm with its corner at the origin: m/12·(b² + c²), …
#[test]
fn mass_and_inertia_are_printed_as_a_scene_has_them() {
    let places: String =
        (0..8).map(|k| format!("v {} {} {}\n", 40 * (k & 1), 20 * (k >> 1 & 1), 10 * (k >> 2))).collect();
    let sides = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "2 4 8 6", "1 5 7 3"];
    let faces: String = sides.iter().map(|side| format!("f {side}\n")).collect();
    let folder = folder("mass");
    std::fs::write(folder.join("box.obj"), places + &faces).unwrap();
    let (code, out, err) = pong(&folder, &["mass", "box.obj", "--unit", "mm", "--density", "2700"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines[0], "8 vertices and 12 triangles read: 1 solid");
    assert_eq!(lines[1], "volume: 8e-6 m³, 2700 kg/m³");
    let line = "mass: 0.0216, inertia: Diagonal(9e-07, 3.06e-06, 3.6e-06), mass_center: (0.02, 0.01, 0.005)";
    assert_eq!(lines[3], line);
    pong(&folder, &["import", "box.obj", "-o", "box.ron", "--unit", "mm", "--stiffness", "1e5"]);
    let scene = format!(
        r#"(format: "pong-scene", version: 1, name: "box", models: {{ "box": "box.ron" }},
        objects: [(name: "box", model: "box", bodies: [(motion: Free, {line})])],
        gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 1e-3, duration: 0.01)"#
    );
    std::fs::write(folder.join("scene.ron"), scene).unwrap();
    let (code, out, err) = pong(&folder, &["run", "scene.ron"]);
    assert_eq!(code, 0, "{out}{err}");
    let (_, out, _) = pong(&folder, &["mass", "part.obj", "--mass", "6"]);
    assert!(out.contains("inertia: Full(xx: 4500.0,") && out.contains("xy: 750.0"), "{out}");
    assert_eq!(pong(&folder, &["mass", "box.obj"]).0, 2, "neither a density nor a mass");
}
