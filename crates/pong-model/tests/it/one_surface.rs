//! Groups that are declared one surface: shells, internal faces, repeated triangles; models that are joined.

use crate::common::*;
use pong_geometry::{Pose, Vec3};
use pong_model::join::{Source, join};
use pong_model::{Model, authored, write};

/// Box from `low` to `high`.
fn cube(name: &str, low: [f64; 3], high: [f64; 3]) -> String {
    pong_testkit::ron::box_polyhedron(
        name,
        [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis])),
        [0, 1, 2].map(|axis| 0.5 * (high[axis] - low[axis])),
        "",
    )
}

fn declared(primitives: &str) -> Model {
    load(&model_of(primitives).replacen("root: (", "root: (one_surface: true, ", 1))
}

/// Number of internal faces of each polyhedron.
fn internal(model: &Model) -> Vec<usize> {
    let polyhedra = model.bodies[0].polyhedra.iter();
    polyhedra.map(|piece| piece.faces.iter().filter(|face| !face.active).count()).collect()
}

const PLANE: &str = "Plane(name: \"plane\", normal: (0, 0, 1), offset: 0)";
const PATCH: &str = "TriangleMesh(name: \"patch\", vertices: [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)],
    triangles: [(0, 1, 2), (0, 2, 3)])";

#[test]
fn faces_that_others_cover_are_internal() {
    let (left, right) = (cube("left", [0.0; 3], [1.0; 3]), cube("right", [1.0, 0.0, 0.0], [2.0, 1.0, 1.0]));
    let two = declared(&format!("{left}, {right}"));
    assert_eq!((internal(&two), two.bodies[0].shell_count, two.warnings.len()), (vec![1, 1], 1, 0));
    let apart = load(&model_of(&format!("{left}, {right}")));
    assert_eq!((internal(&apart), apart.bodies[0].shell_count), (vec![0, 0], 2));
    assert_ne!(two.hash, apart.hash);
    let halves =
        [[0.0, 0.5], [0.5, 1.0]].map(|y| cube(&format!("y{}", y[0]), [1.0, y[0], 0.0], [2.0, y[1], 1.0]));
    let three = declared(&format!("{left}, {}, {}", halves[0], halves[1]));
    assert_eq!((internal(&three), three.warnings.len()), (vec![1, 2, 2], 0));
    // Two copies of one half cover half of the wall.
    let twice = declared(&format!("{left}, {}, {}", halves[0], halves[0].replace("y0", "again")));
    assert_eq!(internal(&twice), [0, 1, 1]);
}

#[test]
fn a_face_that_is_covered_in_part_is_told() {
    let narrow = cube("narrow", [1.0, 0.2, 0.0], [2.0, 0.8, 1.0]);
    let model = declared(&format!("{}, {narrow}", cube("wide", [0.0; 3], [1.0; 3])));
    assert_eq!(internal(&model), [0, 1]);
    let [warning] = model.warnings.as_slice() else { panic!("{:?}", model.warnings) };
    assert!(warning.contains("/wide/faces[5]") && warning.contains("in part"), "{warning}");
    let [wide, narrow] = model.bodies[0].polyhedra.as_slice() else { panic!() };
    let wall = narrow.faces.iter().find(|face| !face.active).unwrap();
    assert!(wide.faces.iter().any(|face| (face.normal, face.offset) == (-wall.normal, -wall.offset)));
}

#[test]
fn planes_patches_and_boxes_have_one_shell_and_backs_their_own() {
    let body = |primitives: &str| declared(primitives).bodies.swap_remove(0);
    let all = format!("{PLANE}, {PATCH}, {}", cube("box", [0.0, 0.0, -1.0], [1.0, 1.0, 0.0]));
    let all = body(&format!("{all}, Sphere(name: \"s\", center: (0, 0, 0), radius: 0.1)"));
    assert_eq!((all.shell_count, all.joint_shells.as_slice()), (2, &[0][..]));
    let two_sided = body(&format!("{PLANE}, {}", PATCH.replace("(name", "(two_sided: true, name")));
    assert_eq!((two_sided.shell_count, two_sided.joint_shells.as_slice()), (2, &[0, 1][..]));
}

#[test]
fn a_triangle_that_is_there_twice_is_refused_unless_declared() {
    let twice = format!("{PATCH}, {}", PATCH.replace("patch", "again"));
    let faults = pong_model::parse(&model_of(&twice), "m.ron", None, &pong_model::Extensions::new());
    assert!(faults.unwrap_err().0.iter().all(|fault| fault.rule == "duplicate-triangle"));
    let model = declared(&twice);
    assert_eq!((model.bodies[0].shell_count, model.warnings.len()), (1, 0), "{:?}", model.warnings);
    let triangles = &model.bodies[0].triangles.triangles;
    assert_eq!(triangles[0].neighbors.iter().filter(|n| **n == 1).count(), 1);
    assert!((0..3).all(|k| !triangles[2].may_push.edge(k) && !triangles[2].may_push.vertex(k)));
}

#[test]
fn movable_groups_are_not_part_of_the_surface_above() {
    let text = r#"(format: "pong-model", version: 1, name: "m", surfaces: { "s": (stiffness: 1e5) },
        root: (name: "m", surface: "s", one_surface: true, groups: [
            (name: "a", primitives: [Plane(name: "p", normal: (0, 0, 1), offset: 0)]),
            (name: "b", one_surface: false, primitives: [Plane(name: "q", normal: (0, 0, 1), offset: 0)]),
            (name: "c", movable: true, primitives: [Plane(name: "r", normal: (0, 0, 1), offset: 0)])]))"#;
    let model = load(text);
    assert_eq!((model.bodies[0].shell_count, model.bodies[0].joint_shells.as_slice()), (2, &[0][..]));
    assert!(model.bodies[1].joint_shells.is_empty());
}

/// Text of a model with one box and a movable group.
fn part(stiffness: &str) -> String {
    format!(
        r#"(format: "pong-model", version: 1, name: "part", surfaces: {{ "s": (stiffness: {stiffness}), "t": (stiffness: 1e4) }},
        pairs: [(surfaces: ("s", "part/t"), friction: None)], filters: [("fixed", "lid")],
        root: (name: "part", surface: "s", groups: [
            (name: "fixed", primitives: [{}]),
            (name: "lid", movable: true, surface: "t", pose: (position: (0, 0, 1)), primitives: [
                Point(name: "tip", position: (0, 0, 0), surface: "s")])]))"#,
        cube("box", [0.0; 3], [1.0; 3])
    )
}

/// Model that joins two parts, the second 1 m along x.
fn joined(texts: [&str; 2]) -> Model {
    let nodes = texts.map(|text| authored::parse(text, "part.ron").unwrap());
    let models = texts.map(load);
    let at = |x: f64| Pose::new(Vec3::new(x, 0.0, 0.0), [1.0, 0.0, 0.0, 0.0]);
    let source = |index: usize| Source {
        name: ["one", "two"][index],
        document: &nodes[index],
        model: &models[index],
        pose: at(index as f64),
        meshes: None,
    };
    load(&write::text(&join("whole", &[source(0), source(1)], true).unwrap()))
}

#[test]
fn joined_models_are_one_surface_and_keep_their_movable_groups() {
    let model = joined([&part("1e5"), &part("1e5")]);
    let paths: Vec<&str> = model.bodies.iter().map(|body| &*body.path).collect();
    assert_eq!(paths, ["whole", "whole/one/lid", "whole/two/lid"]);
    assert_eq!((model.bodies[0].shell_count, internal(&model)), (1, vec![1, 1]));
    assert_eq!((model.surfaces.len(), model.pair_overrides.len()), (2, 1));
    assert_eq!(model.pair_overrides[0].surfaces, ["s", "whole/t"]);
    assert_eq!(model.filters[1], ["whole/two/fixed", "whole/two/lid"]);
    assert_eq!(model.bodies[2].initial_pose.unwrap().position, Vec3::new(1.0, 0.0, 1.0));
}

#[test]
fn surfaces_of_one_name_that_differ_get_the_name_of_their_part() {
    let model = joined([&part("1e5"), &part("2e5")]);
    let names: Vec<&str> = model.surfaces.iter().map(|surface| &*surface.name).collect();
    assert_eq!(names, ["s", "t", "two.s"]);
    let body = &model.bodies[0];
    let stiffness = |index: usize| model.surfaces[body.primitives[index].surface as usize].stiffness;
    assert_eq!([stiffness(0), stiffness(1)], [1e5, 2e5]);
    assert_eq!(model.surfaces[model.bodies[2].primitives[0].surface as usize].name, "two.s");
}
