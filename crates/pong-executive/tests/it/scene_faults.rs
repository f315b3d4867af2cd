//! All faults of scene files are reported, each with thing, cause and cure.

use pong_executive::scene::Scene;
use std::path::{Path, PathBuf};

fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("faults_{test}"));
    std::fs::create_dir_all(&folder).unwrap();
    let ball = r#"(format: "pong-model", version: 1, name: "ball", surfaces: { "s": (stiffness: 1e5) },
        root: (name: "ball", surface: "s", groups: [
            (name: "core", primitives: [Sphere(name: "skin", center: (0, 0, 0), radius: 0.1)]),
            (name: "arm", movable: true, primitives: [Point(name: "tip", position: (1, 0, 0))])]))"#;
    std::fs::write(folder.join("ball.ron"), ball).unwrap();
    std::fs::write(folder.join("bad.ron"), ball.replace("radius: 0.1", "radius: -0.1")).unwrap();
    folder
}

/// A valid scene of one ball with an arm, with one part replaced.
fn scene(replace: &str, by: &str) -> String {
    let text = r#"(
    format: "pong-scene", version: 1, name: "test",
    models: { "ball": "ball.ron" },
    objects: [(name: "a", model: "ball", bodies: [
        (motion: Free, mass: 1.0, inertia: Diagonal(1.0, 1.0, 1.0)),
        (group: "arm", motion: Fixed),
    ])],
    loads: [(body: "a", force: (1.0, 0.0, 0.0))],
    springs: [(first: Ground(), second: On(body: "a/arm"), stiffness: (1, 1, 1, 1, 1, 1))],
    pairs: [],
    integrator: RungeKutta4, step: 1e-3, duration: 1.0,
)"#;
    assert!(text.contains(replace), "{replace}");
    text.replacen(replace, by, 1)
}

fn errors(text: &str, folder: &Path) -> Vec<String> {
    let scene = match Scene::parse(text, "test.ron", folder) {
        Ok(scene) => scene,
        Err(errors) => return errors.0.iter().map(ToString::to_string).collect(),
    };
    match scene.build() {
        Ok(_) => Vec::new(),
        Err(errors) => errors.0.iter().map(ToString::to_string).collect(),
    }
}

#[test]
fn each_fault_is_told_by_name() {
    let folder = folder("each");
    assert_eq!(errors(&scene("name", "name"), &folder), Vec::<String>::new());
    let cases = [
        ("pong-scene", "pong-model", "format: it is"),
        ("version: 1", "version: 2", "version: it is 2"),
        ("step: 1e-3", "step: 1e-300", "duration: 1.0 s are 1e300 steps of 1e-300 s; give at most"),
        (
            "pairs: [],",
            "pairs: [], contact_capacity: 18446744073709551615,",
            "contact capacity: room for 18446744073709551615 contacts takes",
        ),
        ("ball.ron", "none.ron", "models/ball: "),
        ("ball.ron", "bad.ron", "[not-positive]"),
        ("\"ball.ron\"", "\"ball.ron\", \"ball\": \"ball.ron\"", "models/ball: the name is given twice"),
        (
            "model: \"ball\"",
            "model: \"bell\"",
            "objects/a: there is no model `bell`; list it in `models`; known: ball",
        ),
        ("(group: \"arm\", motion: Fixed),", "", "the movable group `ball/arm` has no body"),
        ("group: \"arm\"", "group: \"leg\"", "objects/a/bodies[1]: movable group `a/leg`"),
        ("group: \"arm\", ", "", "objects/a/bodies[1]: this group already has a body"),
        ("mass: 1.0, ", "", "objects/a/bodies[0]: a free body needs `mass` and `inertia`"),
        ("Diagonal(1.0,", "Diagonal(3.0,", "belong to no body"),
        ("Diagonal(1.0,", "Diagonal(-1.0,", "must be above zero"),
        ("Fixed", "Fixed, orientation: (1, 1, 0, 0)", "`orientation` has norm 1.41"),
        ("Fixed", "Fixed, position: (inf, 0, 0)", "`position` holds inf"),
        ("Fixed", "Fixed, linear_velocity: (1, 0, 0)", "a velocity is given"),
        (
            "Fixed",
            "Prescribed(Table([(time: 0, position: (0, 0, 0))]))",
            "objects/a/bodies[1]: the table has 1 row",
        ),
        ("Fixed", "Prescribed(Sinusoid(axis: (0, 0, 0), frequency: 1))", "the axis is zero"),
        ("loads: [(body: \"a\"", "loads: [(body: \"b\"", "loads[0]: there is no object `b`"),
        ("force: (1.0, 0.0, 0.0)", "", "loads[0]: it is neither a constant nor a table"),
        ("force: (1.0, 0.0, 0.0)", "table: [(time: 1), (time: 0)]", "loads[0]: row 1 is not later"),
        ("On(body: \"a/arm\")", "Ground()", "springs[0]: both ends are on the same body"),
        ("stiffness: (1,", "stiffness: (-1,", "springs[0]: a stiffness is below zero"),
        ("pairs: []", "pairs: [(\"a\", \"b\")]", "pairs/(a, b): there is no object `b`"),
        ("pairs: []", "pairs: [(\"a\", \"a\"), (\"a\", \"a\")]", "already there"),
        (
            "pairs: []",
            "pairs: [], passes_through: [(\"a\", \"a\")]",
            "passes_through/(a, a): `pairs` has no such entry; name two objects as an entry of `pairs` does",
        ),
        ("1e-3", "0.0", "step: it is 0 s"),
        ("duration: 1.0", "duration: -1.0", "duration: it is -1 s"),
        ("duration: 1.0", "duration: 1.0, record_every: 0", "record_every: it is 0"),
        ("RungeKutta4", "ZeroOrderHold(substeps: 0)", "integrator: 0 substeps"),
        (
            "pairs: []",
            "pairs: [], alternatives: [(name: \"x\", models: { \"bell\": \"ball.ron\" })]",
            "alternatives/x: there is no model `bell`; name one from `models`: ball",
        ),
        (
            "pairs: []",
            "pairs: [], alternatives: [(name: \"x\", models: {})]",
            "alternatives/x: it replaces no model",
        ),
        (
            "pairs: []",
            "pairs: [], alternatives: [(name: \"x\", models: { \"ball\": \"a\" }), (name: \"x\", models: { \"ball\": \"b\" })]",
            "alternatives/x: the name is given twice",
        ),
        (
            "pairs: []",
            "pairs: [], alternatives: [(name: \"\", models: { \"ball\": \"a\" })]",
            "alternatives/: it has no name",
        ),
        (
            "pairs: []",
            "pairs: [], alternatives: [(name: \"x\", models: { \"ball\": \"a\", \"ball\": \"b\" })]",
            "alternatives/x: model `ball` is replaced twice",
        ),
    ];
    for (replace, by, expected) in cases {
        let told = errors(&scene(replace, by), &folder);
        assert_eq!(told.len(), 1, "`{replace}` → `{by}`: {told:#?}");
        assert!(told[0].starts_with("test.ron: ") && told[0].contains(expected), "`{by}`: {told:#?}");
    }
}

#[test]
fn faults_of_notation_are_told_with_their_place() {
    let folder = folder("notation");
    let told = errors(&scene("mass: 1.0", "masss: 1.0"), &folder);
    assert!(told[0].starts_with("test.ron:5:24: ") && told[0].contains("masss"), "{told:?}");
    let told = errors(&scene("Fixed", "Fxed"), &folder);
    assert!(told[0].starts_with("test.ron:6:") && told[0].contains("Fxed"), "{told:?}");
    let told = errors("(", &folder);
    assert!(told[0].starts_with("test.ron:1:"), "{told:?}");
    let missing = Scene::load(&folder.join("none.ron")).unwrap_err().to_string();
    assert!(missing.contains("none.ron: scene: ") && missing.contains("name a scene file"), "{missing}");
}

/// A field in the notation of other tools: the message names the field and shows its correct form.
#[test]
fn a_field_of_another_notation_is_named_with_its_own() {
    let folder = folder("fields");
    let cases = [
        (
            "Diagonal(1.0, 1.0, 1.0)",
            "(1.0, 1.0, 1.0)",
            "field `inertia`: ",
            "write inertia: Diagonal(xx, yy, zz), or Full(",
        ),
        ("Fixed)", "Fixed, orientation: (90, 0, 0))", "field `orientation`: ", "orientation: (w, x, y, z)"),
        ("Fixed)", "Fixed, position: 1.0)", "field `position`: ", "write position: (x, y, z), m"),
        ("Fixed)", "fixed)", "field `motion`: ", "Free, Fixed or Prescribed"),
        ("pairs: []", "pairs: [\"a\"]", "field `pairs`: ", "pairs: [(\"ball\", \"ground\"), …]"),
        ("RungeKutta4", "\"rk4\"", "field `integrator`: ", "RungeKutta4, SemiImplicitEuler, ZeroOrderHold"),
    ];
    for (replace, by, field, cure) in cases {
        let told = errors(&scene(replace, by), &folder);
        assert!(told.len() == 1 && told[0].contains(field) && told[0].contains(cure), "`{by}`: {told:#?}");
        assert!(told[0].starts_with("test.ron:"), "`{by}`: {told:#?}");
    }
}

#[test]
fn a_model_is_no_scene() {
    let folder = folder("model");
    let told = Scene::load(&folder.join("ball.ron")).unwrap_err().to_string();
    assert!(
        told.contains("ball.ron: scene: this is a model, not a scene; check it with `pong check`"),
        "{told}"
    );
}

/// Without `pairs` there is a warning; an empty list says that nothing may touch.
#[test]
fn left_out_pairs_are_a_warning() {
    let folder = folder("pairs");
    let warnings = |text: &str| {
        let scene = Scene::parse(text, "test.ron", &folder).unwrap_or_else(|errors| panic!("{errors}"));
        scene.build().unwrap_or_else(|errors| panic!("{errors}")).warnings
    };
    assert_eq!(warnings(&scene("pairs: [],", "pairs: [],")), Vec::<String>::new());
    let told = warnings(&scene("pairs: [],", ""));
    assert!(
        told.len() == 1 && told[0].starts_with("the scene has no `pairs`: nothing in it can touch"),
        "{told:?}"
    );
}

#[test]
fn all_faults_are_told_at_once() {
    let folder = folder("all");
    let text = scene("step: 1e-3", "step: -1.0")
        .replace("mass: 1.0", "mass: -1.0")
        .replace("body: \"a/arm\"", "body: \"z\"");
    let told = errors(&text, &folder);
    assert_eq!(told.len(), 3, "{told:#?}");
}

/// Filters of a scene are set in its world; unknown names are reported with the known ones.
#[test]
fn filters_are_taken_and_bad_names_told() {
    let folder = folder("filters");
    for (filter, expected) in [
        ("(\"a/arm\", \"z\")", "there is no object `z`"),
        ("(\"a/leg\", \"a/arm\")", "group `a/leg`"),
        ("(\"a/core\", \"a/arm\"), (\"a/arm\", \"a/core\")", "already there"),
    ] {
        let told = errors(&scene("pairs:", &format!("filters: [{filter}], pairs:")), &folder);
        assert!(told.len() == 1 && told[0].contains("filters/") && told[0].contains(expected), "{told:#?}");
    }
}
