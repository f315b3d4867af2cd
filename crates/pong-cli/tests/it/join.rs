//! `pong join` on the command line.

use crate::common;
use crate::common::pong;
use std::path::PathBuf;

const BALL: &str = r#"(format: "pong-model", version: 1, name: "ball",
    surfaces: { "b": (stiffness: 1e5, normal: Linear(damping: 100.0), friction: Bristle(mu: 0.9, damping: 50.0)) },
    root: (name: "ball", surface: "b", primitives: [Sphere(name: "s", center: (0, 0, 0), radius: 0.1)]))"#;
const SLAB: &str = r#"(format: "pong-model", version: 1, name: "slab",
    surfaces: { "rough": (stiffness: inf, friction: Bristle(mu: 0.9)) },
    root: (name: "slab", surface: "rough", primitives: [
        Polyhedron(name: "solid", vertices: [(-0.5, -0.5, -0.05), (0.5, -0.5, -0.05), (-0.5, 0.5, -0.05),
                (0.5, 0.5, -0.05), (-0.5, -0.5, 0.05), (0.5, -0.5, 0.05), (-0.5, 0.5, 0.05), (0.5, 0.5, 0.05)],
            faces: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]])]))"#;
const MESH: &str = r#"(format: "pong-model", version: 1, name: "mesh",
    surfaces: { "rough": (stiffness: inf, friction: Bristle(mu: 0.9)) },
    root: (name: "mesh", surface: "rough", primitives: [TriangleMesh(name: "m", file: "m.obj")]))"#;
const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";

/// Scene in which a ball of 5 kg rolls over the seam of two slabs at 1 m/s.
fn scene(models: &str, floor: &str, pairs: &str) -> String {
    format!(
        r#"(format: "pong-scene", version: 1, name: "roll", models: {{ "ball": "ball.ron", {models} }},
        objects: [(name: "ball", model: "ball", bodies: [(motion: Free, mass: 5.0, inertia: Diagonal(0.02, 0.02, 0.02),
                position: (-0.4, 0.03, 0.0995095), linear_velocity: (1, 0, 0), angular_velocity: (0, 10, 0))]), {floor}],
        pairs: [{pairs}], gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 1e-4, duration: 0.8)"#
    )
}

fn folder(test: &str) -> PathBuf {
    let apart = scene(
        "\"slab\": \"slab.ron\"",
        "(name: \"f1\", model: \"slab\", bodies: [(motion: Fixed, position: (-0.5, 0, -0.05))]), \
         (name: \"f2\", model: \"slab\", bodies: [(motion: Fixed, position: (0.5, 0, -0.05))])",
        "(\"ball\", \"f1\"), (\"ball\", \"f2\")",
    );
    let joined = scene(
        "\"floor\": \"floor.ron\"",
        "(name: \"floor\", model: \"floor\", bodies: [(motion: Fixed)])",
        "(\"ball\", \"floor\")",
    );
    common::folder(
        &format!("join/{test}"),
        &[
            ("ball.ron", BALL),
            ("slab.ron", SLAB),
            ("mesh.ron", MESH),
            ("m.obj", OBJ),
            ("apart.ron", &apart),
            ("joined.ron", &joined),
        ],
    )
}

#[test]
fn the_seam_of_two_objects_is_told_and_joined() {
    let folder = folder("seam");
    let (code, _, err) = pong(&folder, &["run", "apart.ron"]);
    assert!(code == 0 && err.contains("make them one model with `pong join`"), "{err}");
    let arguments = ["join", "floor.ron", "slab.ron@-0.5,0,-0.05", "slab.ron@0.5,0,-0.05"];
    let (code, out, err) = pong(&folder, &arguments);
    assert_eq!((code, out.as_str(), err.as_str()), (0, "written: floor.ron\n", ""));
    let (code, out, err) = pong(&folder, &["check", "floor.ron"]);
    assert!(code == 0 && err.is_empty() && !out.contains("warning"), "{out}{err}");
    let (code, _, err) = pong(&folder, &["run", "joined.ron"]);
    assert!(code == 0 && !err.contains("flush"), "{err}");
    let (code, _, err) = pong(&folder, &arguments);
    assert!(code == 1 && err.contains("--force"), "{err}");
}

/// Two slabs in one place overlap, side by side they are flush, a step apart they are neither.
#[test]
fn flush_models_are_told_where_they_are_placed() {
    let folder = folder("check_placed");
    let check = |other: &str| {
        let (code, out, err) = pong(&folder, &["check", "slab.ron", other]);
        assert_eq!((code, err.as_str()), (0, ""), "{other}");
        out
    };
    let (twice, beside, apart) = (check("slab.ron"), check("slab.ron@1,0,0"), check("slab.ron@1.001,0,0.01"));
    let cure = "if they never move relative to each other, make them one model with `pong join`";
    assert!(
        twice.contains("lie in one plane and overlap (and")
            || twice.contains("lie in one plane and overlap:")
    );
    assert!(twice.contains("what touches both there is pushed twice") && twice.contains(cure), "{twice}");
    assert!(beside.contains("`slab/solid` and `slab/solid` are flush: what rolls") && beside.contains(cure));
    assert!(!apart.contains("pong join"), "{apart}");
    let alone = pong(&folder, &["check", "--alone", "slab.ron", "slab.ron"]).1;
    assert!(!alone.contains("pong join"), "{alone}");
}

/// A turned and moved model has its ball where the other one has it.
#[test]
fn balls_of_two_models_in_one_place_are_told() {
    let folder = folder("check_balls");
    let there =
        pong(&folder, &["check", "ball.ron@1,2,3", "ball.ron@1,2,3.00000001,0.7071068,0,0.7071068,0"]).1;
    assert!(
        there.contains("`ball/s` and `ball/s` are the same Sphere in one place: their springs add"),
        "{there}"
    );
    let beside = pong(&folder, &["check", "ball.ron@1,2,3", "ball.ron@1,2,3.01"]).1;
    assert!(!beside.contains("in one place"), "{beside}");
}

#[test]
fn separate_models_are_told_by_the_check_with_the_cure() {
    let folder = folder("separate");
    let arguments = ["join", "floor.ron", "slab.ron@-0.5,0,0", "slab.ron@0.5,0,0", "--separate"];
    assert_eq!(pong(&folder, &arguments).0, 0);
    let (_, out, _) = pong(&folder, &["check", "floor.ron"]);
    assert!(out.contains("`floor/slab/solid` and `floor/slab_2/solid` are flush"), "{out}");
    assert!(out.contains("one_surface: true"), "{out}");
}

#[test]
fn meshes_are_found_from_a_folder_above_and_refused_from_elsewhere() {
    let folder = folder("meshes");
    std::fs::create_dir_all(folder.join("parts")).unwrap();
    std::fs::create_dir_all(folder.join("out")).unwrap();
    ["mesh.ron", "m.obj"].iter().for_each(|file| {
        std::fs::rename(folder.join(file), folder.join("parts").join(file)).unwrap();
    });
    let (code, _, err) = pong(&folder, &["join", "whole.ron", "parts/mesh.ron", "slab.ron@0,0,-1"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(std::fs::read_to_string(folder.join("whole.ron")).unwrap().contains("parts/m.obj"));
    let (code, _, err) = pong(&folder, &["join", "out/whole.ron", "parts/mesh.ron"]);
    assert!(code == 1 && err.contains("not below") && !folder.join("out/whole.ron").exists(), "{err}");
}

#[test]
fn wrong_places_are_refused() {
    let folder = folder("places");
    for place in ["0,0", "0,0,x", "0,0,0,1,1,0,0"] {
        let (code, _, err) = pong(&folder, &["join", "whole.ron", &format!("slab.ron@{place}")]);
        assert!(code == 2 && err.contains("quaternion"), "{place}: {code} {err}");
    }
}
