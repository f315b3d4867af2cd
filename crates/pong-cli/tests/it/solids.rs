//! `pong check` and `pong advise` with solids.

use crate::common;
use crate::common::pong;
use pong_testkit::meshes::{l_shape, obj};

/// Two boxes of 1 m and 2 m, and a mesh of a box of 2 m with a hole through it along z.
const MODEL: &str = r#"(format: "pong-model", version: 1, name: "parts",
    surfaces: { "steel": (stiffness: 1e6), "foam": (stiffness: 1e4, area: 0.01), "oak": (stiffness: 1e5, foundation: 1e8) },
    root: (name: "parts", surface: "steel", contact: Solid, primitives: [
        Polyhedron(name: "small", vertices: [(0,0,0), (1,0,0), (1,1,0), (0,1,0), (0,0,1), (1,0,1), (1,1,1), (0,1,1)],
            faces: [[0,3,2,1], [4,5,6,7], [0,1,5,4], [1,2,6,5], [2,3,7,6], [3,0,4,7]]),
        Polyhedron(name: "large", vertices: [(2,0,0), (4,0,0), (4,2,0), (2,2,0), (2,0,2), (4,0,2), (4,2,2), (2,2,2)],
            faces: [[0,3,2,1], [4,5,6,7], [0,1,5,4], [1,2,6,5], [2,3,7,6], [3,0,4,7]]),
        TriangleMesh(name: "frame", surface: "foam", vertices: [
                (6,0,0), (8,0,0), (8,2,0), (6,2,0), (6.5,0.5,0), (7.5,0.5,0), (7.5,1.5,0), (6.5,1.5,0),
                (6,0,2), (8,0,2), (8,2,2), (6,2,2), (6.5,0.5,2), (7.5,0.5,2), (7.5,1.5,2), (6.5,1.5,2)],
            triangles: [
                (0,4,1), (1,4,5), (1,5,2), (2,5,6), (2,6,3), (3,6,7), (3,7,0), (0,7,4),
                (8,9,12), (9,13,12), (9,10,13), (10,14,13), (10,11,14), (11,15,14), (11,8,15), (8,12,15),
                (0,1,9), (0,9,8), (1,2,10), (1,10,9), (2,3,11), (2,11,10), (3,0,8), (3,8,11),
                (5,4,12), (5,12,13), (6,5,13), (6,13,14), (7,6,14), (7,14,15), (4,7,15), (4,15,12)])]))"#;

#[test]
fn check_lists_solids_and_their_foundations() {
    let folder = common::folder("solids/check", &[("parts.ron", MODEL)]);
    let (code, out, err) = pong(&folder, &["check", "parts.ron"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    for line in [
        "  solids of parts: 3, 2 of them convex, ",
        "  surface `steel` gives no `foundation` and no `area`: area 1 … 4 m², K 250000 … 1000000 N/m³ at its solids\n",
        "`foam`: k 10000 N/m, K 1000000 N/m³ from the area, linear",
        "`oak`: k 100000 N/m, K 1e8 N/m³, linear",
        "  note: parts/frame is a solid that is not convex: against others like it, its facets push down to 0.25 m at the shallowest",
    ] {
        assert!(out.contains(line), "no `{line}` in:\n{out}");
    }
    assert_eq!(out.matches("gives no `foundation`").count(), 1, "{out}");
}

const SCENE: &str = r#"(format: "pong-scene", version: 1, name: "scene", models: { "parts": "parts.ron", "ground": "ground.ron" },
    objects: [
        (name: "parts", model: "parts", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(1.0, 1.0, 1.0))]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)]),
    ],
    pairs: [("parts", "ground")], integrator: SemiImplicitEuler, step: 1e-4, duration: 0.1)"#;

const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground", surfaces: { "stone": (stiffness: inf) },
    root: (name: "ground", surface: "stone", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: -1)]))"#;

#[test]
fn advise_judges_solids_flat_on_their_largest_faces() {
    let marked = MODEL.replace("contact: Solid, ", "");
    let files = [("parts.ron", MODEL), ("marked.ron", &marked), ("ground.ron", GROUND), ("scene.ron", SCENE)];
    let folder = common::folder("solids/advise", &files);
    let (code, out, err) = pong(&folder, &["advise", "scene.ron"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("note: solids are judged flat on each other"), "{out}");
    assert!(out.contains("parts/parts · ground/ground") && out.contains("stable to s"), "{out}");
    for (file, is_told) in [("parts.ron", true), ("marked.ron", false)] {
        let (code, out, err) = pong(&folder, &["advise", file, "--mass", "1", "--rate", "1000"]);
        assert_eq!((code, err.as_str()), (0, ""), "{out}");
        assert_eq!(
            out.contains("note: at solids, these are the limits of a contact with the area"),
            is_told,
            "{out}"
        );
    }
}

/// A cube of 1 kg that falls by 1 m is too fast for Hunt and Crossley's damping at a step of 1 ms, which holds up to
/// 0.64 m/s; beside the floor it has no height to fall.
#[test]
fn a_fall_is_judged_before_it_ends() {
    let cube = MODEL_OF_A_CUBE;
    let scene = |height: f64| {
        format!(
            r#"(format: "pong-scene", version: 1, name: "fall", models: {{ "cube": "cube.ron", "ground": "floor.ron" }},
            objects: [(name: "cube", model: "cube", bodies: [(motion: Free, mass: 1.0, position: (0, 0, {height:?}),
                inertia: Diagonal(0.0017, 0.0017, 0.0017))]),
                (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
            pairs: [("cube", "ground")], gravity: (0, 0, -9.81), integrator: SemiImplicitEuler, step: 1e-3, duration: 2e-3)"#
        )
    };
    let (high, low) = (scene(1.0), scene(0.01));
    let floor = GROUND.replace("offset: -1", "offset: -0.06");
    let files = [("cube.ron", cube), ("floor.ron", &floor), ("high.ron", &high), ("low.ron", &low)];
    let folder = common::folder("solids/fall", &files);
    let (code, _, err) = pong(&folder, &["run", "high.ron"]);
    assert_eq!(code, 0, "{err}");
    assert!(
        err.contains("at 4.429e0 m/s, which a fall in the scene can reach, `cube/cube` and `ground/ground`"),
        "{err}"
    );
    assert!(err.contains("by its damping, gains energy at a step of 1.000e-3 s"), "{err}");
    let (code, _, err) = pong(&folder, &["run", "low.ron"]);
    assert_eq!((code, err.as_str()), (0, ""));
}

const MODEL_OF_A_CUBE: &str = r#"(format: "pong-model", version: 1, name: "cube",
    surfaces: { "s": (stiffness: 1e6, foundation: 1.2e8, normal: HuntCrossley(dissipation: 2.0, exponent: 1.0)) },
    root: (name: "cube", surface: "s", contact: Solid, primitives: [Polyhedron(name: "box",
        vertices: [(-0.05, -0.05, -0.05), (0.05, -0.05, -0.05), (-0.05, 0.05, -0.05), (0.05, 0.05, -0.05),
            (-0.05, -0.05, 0.05), (0.05, -0.05, 0.05), (-0.05, 0.05, 0.05), (0.05, 0.05, 0.05)],
        faces: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]])]))"#;

/// An L on the upper end of another one: 1 mm deep the run has no warning, 40 mm deep it names the two.
#[test]
fn a_mesh_too_deep_in_another_is_named() {
    let mesh = obj(&l_shape());
    let model = r#"(format: "pong-model", version: 1, name: "l", surfaces: { "s": (stiffness: 1e5) },
    root: (name: "l", surface: "s", contact: Solid, primitives: [TriangleMesh(name: "mesh", file: "l.obj")]))"#;
    let warning = |height: f64| {
        let scene = format!(
            r#"(format: "pong-scene", version: 1, name: "deep", models: {{ "l": "l.ron" }},
    objects: [
        (name: "lower", model: "l", bodies: [(motion: Fixed)]),
        (name: "upper", model: "l", bodies: [(motion: Fixed, position: (0, 0, {height}))])],
    pairs: [("lower", "upper")], integrator: SemiImplicitEuler, step: 1e-3, duration: 1e-3)"#
        );
        let files = [("l.obj", mesh.as_str()), ("l.ron", model), ("deep.ron", &scene)];
        let folder = common::folder(&format!("deep_in_mesh/{height}"), &files);
        let (code, _, told) = pong(&folder, &["run", "deep.ron", "--quiet"]);
        assert_eq!(code, 0, "{told}");
        told
    };
    assert!(!warning(0.119).contains("deeper"), "{}", warning(0.119));
    let told = warning(0.08);
    assert!(told.contains("a solid was deeper in a mesh than its facets push"), "{told}");
    assert!(
        told.contains("; first `upper") && told.contains("` in `lower") && told.contains("at 0 s"),
        "{told}"
    );
}
