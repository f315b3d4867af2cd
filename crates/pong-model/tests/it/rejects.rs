//! One bad snippet per rule: the rule, the path, and the line, which the comment `/*!*/` marks.

use crate::common;
use crate::common::{CUBE_FACES, cube_vertices, faults, model_of};
use pong_model::Extensions;
use std::collections::BTreeSet;

const TRIANGLE: &str = "vertices: ((0,0,0),(1,0,0),(0,1,0))";

/// Checks that the text is refused for exactly this reason, at this position.
fn refused(rule: &str, path: &str, text: &str) {
    let errors = faults(text);
    let marked = text.find("/*!*/").expect("a mark");
    let line = 1 + text[..marked].matches('\n').count() as u32;
    assert_eq!(errors.0.len(), 1, "{rule}: {errors}\n{text}");
    let error = &errors.0[0];
    assert_eq!((error.rule, error.path.as_str(), error.line), (rule, path, line), "{error}\n{text}");
    assert!(!error.cause.is_empty() && !error.cure.is_empty());
    let shown = error.to_string();
    assert!(shown.starts_with(&format!("test.ron:{line}:{}: {path}: [{rule}] ", error.column)), "{shown}");
}

fn primitive(rule: &str, path: &str, text: &str) {
    refused(rule, path, &model_of(&format!("\n{text}\n")));
}

fn accepts(text: &str) -> bool {
    pong_model::parse(&model_of(text), "m.ron", None, &Extensions::new()).is_ok()
}

fn surface(rule: &str, path: &str, surfaces: &str) {
    refused(
        rule,
        path,
        &format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1), \n{surfaces}\n }}, \
             root: (name: \"root\", surface: \"s\", primitives: [Point(name: \"p\", position: (0,0,0))]))"
        ),
    );
}

fn pair(rule: &str, pairs: &str) {
    refused(
        rule,
        "pairs[0]",
        &format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1) }}, pairs: [\n{pairs}],\
             root: (name: \"root\", surface: \"s\", primitives: [Point(name: \"p\", position: (0,0,0))]))"
        ),
    );
}

fn root(rule: &str, path: &str, group: &str) {
    refused(
        rule,
        path,
        &format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1) }}, \n root: {group})"
        ),
    );
}

#[test]
fn faults_of_notation() {
    refused("syntax", "model", "(format: \"pong-model\",\n\n /*!*/ ] )");
    refused("too-deep", "model", &format!("/*!*/(a: {}", "[".repeat(1000)));
    refused("byte-string", "model", "(\nformat: /*!*/ b\"x\")");
}

#[test]
fn faults_of_the_top_level() {
    let rest = "surfaces: {\"s\": (stiffness: 1)}, root: (name: \"root\", surface: \"s\", primitives: [Point(name: \"p\", position: (0,0,0))])";
    refused("format", "model", &format!("(\n/*!*/format: \"pong\", version: 1, name: \"m\", {rest})"));
    refused("version", "model", &format!("(format: \"pong-model\",\n/*!*/version: 2, name: \"m\", {rest})"));
    refused(
        "empty-name",
        "model",
        &format!("(format: \"pong-model\", version: 1,\n/*!*/name: \"\", {rest})"),
    );
    refused("missing-field", "model", &format!("\n/*!*/(version: 1, name: \"m\", {rest})"));
    refused("wrong-type", "model", "\n/*!*/[1, 2]");
    refused(
        "unknown-field",
        "model",
        &format!("(format: \"pong-model\", version: 1, name: \"m\",\n/*!*/nmae: 1, {rest})"),
    );
    refused(
        "repeated-field",
        "model",
        &format!("(format: \"pong-model\", version: 1, name: \"m\",\n/*!*/name: \"n\", {rest})"),
    );
}

#[test]
fn faults_of_surfaces() {
    surface("not-positive", "surfaces/t", "\"t\": (/*!*/stiffness: 0)");
    surface("not-finite", "surfaces/t", "\"t\": (/*!*/stiffness: NaN)");
    for stiffness in ["1.1e100", "1.7e308", "0.9e-100", "5e-324"] {
        surface("stiffness-range", "surfaces/t", &format!("\"t\": (/*!*/stiffness: {stiffness})"));
        let bristle = format!("\"t\": (stiffness: 1, friction: Bristle(mu: 1, /*!*/stiffness: {stiffness}))");
        surface("stiffness-range", "surfaces/t", &bristle);
    }
    surface(
        "restitution-range",
        "surfaces/t",
        "\"t\": (stiffness: 1e100, normal: Linear(/*!*/restitution: (e: 0.01, mass: 1e100)))",
    );
    surface(
        "restitution-range",
        "surfaces/t",
        "\"t\": (stiffness: 1, normal: HuntCrossley(exponent: 1, /*!*/restitution: (e: 0.01, speed: 1e-99)))",
    );
    surface("too-large", "surfaces/t", "\"t\": (stiffness: 1, normal: Linear(/*!*/damping: 1.1e100))");
    surface(
        "too-large",
        "surfaces/t",
        "\"t\": (stiffness: 1, normal: Linear(restitution: (e: 1, /*!*/mass: 1e300)))",
    );
    surface("repeated-surface", "surfaces/s", "/*!*/\"s\": (stiffness: 1)");
    surface("empty-name", "surfaces/", "/*!*/\"\": (stiffness: 1)");
    surface("negative", "surfaces/t", "\"t\": (stiffness: 1, normal: Linear(/*!*/damping: -1))");
    surface("negative", "surfaces/t", "\"t\": (stiffness: 1, normal: Linear(/*!*/ramp: -1))");
    surface("unknown-kind", "surfaces/t", "\"t\": (stiffness: 1, normal:/*!*/ Linaer(damping: 1))");
    surface("wrong-type", "surfaces/t", "\"t\": (stiffness: 1, normal:/*!*/ 3)");
    surface(
        "exponent",
        "surfaces/t",
        "\"t\": (stiffness: 1, normal: HuntCrossley(dissipation: 1, /*!*/exponent: 2))",
    );
    surface(
        "missing-field",
        "surfaces/t",
        "\"t\": (stiffness: 1, normal: /*!*/HuntCrossley(dissipation: 1))",
    );
    let power_law = |rule: &str, rest: &str| {
        surface(rule, "surfaces/t", &format!("\"t\": (stiffness: 1e5, normal: PowerLaw({rest}))"));
    };
    for q in ["-0.1", "1.6"] {
        power_law("damping-exponent", &format!("exponent: 1.5, /*!*/damping_exponent: {q}"));
    }
    power_law("damping-exponent", "exponent: 1.0, /*!*/damping_exponent: 1.1");
    power_law("not-finite", "exponent: 1.0, /*!*/damping_exponent: NaN");
    power_law("exponent", "/*!*/exponent: 2.0, damping_exponent: 1.0");
    power_law("negative", "exponent: 1.0, damping_exponent: 1.0, /*!*/damping: -1");
    power_law(
        "either-or",
        "exponent: 1.0, damping_exponent: 0.5, damping: 1, /*!*/restitution: (e: 0.5, speed: 1, mass: 1)",
    );
    for left in ["speed: 1, mass: 1", "e: 0.5, mass: 1", "e: 0.5, speed: 1"] {
        power_law(
            "missing-field",
            &format!("exponent: 1.0, damping_exponent: 0.5, /*!*/restitution: ({left})"),
        );
    }
    power_law(
        "not-positive",
        "exponent: 1.0, damping_exponent: 0.5, restitution: (e: 0.5, /*!*/speed: 0, mass: 1)",
    );
    power_law(
        "restitution-range",
        "exponent: 1.0, damping_exponent: 1.0, /*!*/restitution: (e: 0.01, speed: 1e-99, mass: 1)",
    );
    surface("missing-field", "surfaces/t", "\"t\": (stiffness: 1, normal: /*!*/PowerLaw(exponent: 1.0))");
    surface(
        "restitution-of-rigid",
        "surfaces/t",
        "\"t\": (stiffness: inf, normal: PowerLaw(exponent: 1.0, damping_exponent: 0.5, \
         /*!*/restitution: (e: 0.5, speed: 1, mass: 1)))",
    );
    for e in ["0", "-0.1", "1.1"] {
        let text = format!("\"t\": (stiffness: 1, normal: Linear(restitution: (/*!*/e: {e}, mass: 1)))");
        surface("restitution-range", "surfaces/t", &text);
    }
    surface(
        "restitution-of-rigid",
        "surfaces/t",
        "\"t\": (stiffness: inf, normal: Linear(restitution:\n/*!*/ (e: 0.5, mass: 1)))",
    );
    surface(
        "either-or",
        "surfaces/t",
        "\"t\": (stiffness: 1, normal: Linear(damping: 1,\n/*!*/ restitution: (e: 0.5, mass: 1)))",
    );
    surface("negative", "surfaces/t", "\"t\": (stiffness: 1, friction: Bristle(/*!*/mu: -0.1))");
    surface(
        "negative",
        "surfaces/t",
        "\"t\": (stiffness: 1, friction: Bristle(mu: 1, /*!*/static_excess: -0.1))",
    );
    surface(
        "not-positive",
        "surfaces/t",
        "\"t\": (stiffness: 1, friction: Bristle(mu: 1, /*!*/stiffness: 0))",
    );
    for mass in ["0", "-1"] {
        surface(
            "not-positive",
            "surfaces/t",
            &format!("\"t\": (stiffness: 1, friction: Bristle(mu: 1, /*!*/mass: {mass}))"),
        );
    }
    surface(
        "either-or",
        "surfaces/t",
        "\"t\": (stiffness: 1, friction: Bristle(mu: 1, damping: 0,\n/*!*/ mass: 1))",
    );
    surface(
        "mass-of-rigid",
        "surfaces/t",
        "\"t\": (stiffness: inf, friction: Bristle(mu: 1,\n/*!*/ mass: 1))",
    );
    // 2·√(⅔·1e100·1e100), once of each mass, and 1e100·√(1e100/1e-100).
    surface(
        "damping-range",
        "surfaces/t",
        "\"t\": (stiffness: 1e100, friction: Bristle(mu: 1, /*!*/mass: 1e100))",
    );
    surface(
        "damping-range",
        "surfaces/t",
        "\"t\": (stiffness: 1e100, normal: Linear(restitution: (e: 0.9, mass: 1e100)), friction: /*!*/Bristle(mu: 1))",
    );
    surface(
        "damping-range",
        "surfaces/t",
        "\"t\": (stiffness: 1e-100, normal: Linear(damping: 1e100), friction: /*!*/Bristle(mu: 1, stiffness: 1e100))",
    );
    surface(
        "not-positive",
        "surfaces/t",
        "\"t\": (stiffness: 1, friction: Coulomb(mu: 1, /*!*/slip_speed: 0))",
    );
}

/// Many unknown names among many: each fault has its position, and no message lists them all.
#[test]
fn many_faults_in_one_line_are_placed_and_short() {
    let surfaces: String = (0..2000).map(|k| format!("\"surface {k}\": (stiffness: 1e6), ")).collect();
    let points: String = (0..2000)
        .map(|k| format!("Point(name: \"µ{k}\", position: (0,0,0), surface: \"zzzzzzzzzzzz\"), "))
        .collect();
    let text = format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ {surfaces} }},\n root: (name: \"r\", primitives: [{points}]))"
    );
    let errors = faults(&text);
    assert_eq!(errors.0.len(), 2000);
    let second = text.lines().nth(1).unwrap();
    let columns: Vec<u32> =
        second.match_indices("\"zzz").map(|(at, _)| second[..at].chars().count() as u32 + 1).collect();
    for (error, column) in errors.0.iter().zip(columns) {
        assert_eq!((error.line, error.column, error.rule), (2, column, "unknown-surface"));
        assert!(error.cure.ends_with("and 1980 more"), "{}", error.cure);
    }
}

#[test]
fn faults_of_pairs() {
    pair("unknown-surface", "(/*!*/surfaces: (\"a\", \"b\"))");
    pair("wrong-type", "(/*!*/surfaces: (\"a\",))");
    pair("not-positive", "(surfaces: (\"s\", \"b\"), /*!*/stiffness: 0)");
    pair("not-finite", "(surfaces: (\"s\", \"b\"), /*!*/stiffness: inf)");
    pair("stiffness-range", "(surfaces: (\"s\", \"b\"), /*!*/stiffness: 1e101)");
    pair("stiffness-range", "(surfaces: (\"s\", \"b\"), /*!*/stiffness: 1e-101)");
    pair(
        "restitution-without-stiffness",
        "(surfaces: (\"s\", \"b\"),\n/*!*/ normal: Linear(restitution: (e: 0.5, mass: 1)))",
    );
    pair(
        "restitution-without-stiffness",
        "(surfaces: (\"s\", \"b\"),\n/*!*/ normal: PowerLaw(exponent: 1, damping_exponent: 1, \
         restitution: (e: 0.5, speed: 1, mass: 1)))",
    );
    pair("mass-without-stiffness", "(surfaces: (\"s\", \"b\"), friction: Bristle(mu: 1,\n/*!*/ mass: 1))");
    let twice = "(format: \"pong-model\", version: 1, name: \"m\", surfaces: { \"s\": (stiffness: 1) }, pairs: [\n\
        (surfaces: (\"s\", \"b\")),\n/*!*/(surfaces: (\"b\", \"s\")) ],\
        root: (name: \"root\", surface: \"s\", primitives: [Point(name: \"p\", position: (0,0,0))]))";
    refused("repeated-pair", "pairs[1]", twice);
}

#[test]
fn faults_of_filters() {
    let model = |filters: &str| {
        format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1) }}, filters: [{filters}],\n\
             root: (name: \"root\", surface: \"s\", groups: [\n\
             (name: \"lugs\", primitives: [Point(name: \"p\", position: (0,0,0))]),\n\
             (name: \"arm\", movable: true, primitives: [Point(name: \"q\", position: (0,0,0))])]))"
        )
    };
    refused("unknown-group", "filters[0]", &model("(\n/*!*/\"lugz\", \"arm\")"));
    refused("wrong-type", "filters[0]", &model("\n/*!*/\"lugs\""));
    refused("idle-filter", "filters[0]", &model("\n/*!*/(\"lugs\", \"root/lugs\")"));
    refused("repeated-filter", "filters[1]", &model("(\"lugs\", \"arm\"),\n/*!*/(\"arm\", \"lugs\")"));
}

#[test]
fn faults_of_groups() {
    let p = "Point(name: \"p\", position: (0,0,0))";
    root("missing-field", "root", &format!("/*!*/(surface: \"s\", primitives: [{p}])"));
    root("empty-name", "root", &format!("(/*!*/name: \"\", surface: \"s\", primitives: [{p}])"));
    root("slash-in-name", "a/b", &format!("(/*!*/name: \"a/b\", surface: \"s\", primitives: [{p}])"));
    root(
        "root-not-movable",
        "r",
        &format!("(name: \"r\", /*!*/movable: false, surface: \"s\", primitives: [{p}])"),
    );
    root("root-pose", "r", &format!("(name: \"r\", /*!*/pose: (), surface: \"s\", primitives: [{p}])"));
    root(
        "bound-above",
        "r",
        &format!("(name: \"r\",\n bound: /*!*/Above, surface: \"s\", primitives: [{p}])"),
    );
    root(
        "bound-above",
        "r/g",
        &format!(
            "(name: \"r\", surface: \"s\", groups: [(name: \"g\", movable: true,\n bound: /*!*/Above, primitives: [{p}])])"
        ),
    );
    for size in ["0", "-3", "2.5"] {
        root(
            "leaf-size",
            "r",
            &format!("(name: \"r\",\n leaf_size: /*!*/{size}, surface: \"s\", primitives: [{p}])"),
        );
    }
    root("empty-group", "r", "/*!*/(name: \"r\", surface: \"s\")");
    root("empty-group", "r", "/*!*/(name: \"r\", surface: \"s\", primitives: [])");
    root("empty-group", "r/g", "(name: \"r\", surface: \"s\", groups: [\n/*!*/(name: \"g\", groups: [])])");
    root(
        "groups-and-primitives",
        "r",
        &format!(
            "(name: \"r\", surface: \"s\", groups: [(name: \"g\", primitives: [{p}])],\n/*!*/ primitives: [{p}])"
        ),
    );
    root("unknown-surface", "r", &format!("(name: \"r\", /*!*/surface: \"x\", primitives: [{p}])"));
    root("no-surface", "r/p", &format!("(name: \"r\", primitives: [\n/*!*/{p}])"));
    root("repeated-name", "r/p", &format!("(name: \"r\", surface: \"s\", primitives: [{p},\n/*!*/{p}])"));
    let g = format!("(name: \"g\", primitives: [{p}])");
    root("repeated-name", "r/g", &format!("(name: \"r\", surface: \"s\", groups: [{g},\n/*!*/{g}])"));
    let posed = |pose: &str| {
        format!("(name: \"r\", surface: \"s\", groups: [(name: \"g\", pose: \n({pose}), primitives: [{p}])])")
    };
    root("quaternion-norm", "r/g", &posed("/*!*/orientation: (1, 0, 0, 0.1)"));
    root("not-finite", "r/g", &posed("/*!*/position: (1, 0, inf)"));
    root("wrong-type", "r/g", &posed("/*!*/position: (1, 0)"));
    root("wrong-type", "r", &format!("(name: \"r\", /*!*/movable: 1, surface: \"s\", primitives: [{p}])"));
    root(
        "unknown-volume",
        "r",
        &format!("(name: \"r\", /*!*/bound: Custom(\"k\"), surface: \"s\", primitives: [{p}])"),
    );
    root("unknown-kind", "r", &format!("(name: \"r\", /*!*/bound: Box, surface: \"s\", primitives: [{p}])"));
    root("unknown-kind", "r/c", "(name: \"r\", surface: \"s\", primitives: [\n/*!*/Cube(name: \"c\")])");
}

#[test]
fn faults_of_simple_primitives() {
    primitive("missing-field", "root/p", "/*!*/Point(name: \"p\")");
    primitive("not-finite", "root/p", "Point(name: \"p\", /*!*/position: (0, NaN, 0))");
    primitive("too-large", "root/p", "Point(name: \"p\", /*!*/position: (0, -1.1e100, 0))");
    primitive("zero-direction", "root/p", "Plane(name: \"p\", /*!*/normal: (0, 0, 0), offset: 0)");
    primitive("zero-length", "root/p", "LineSegment(name: \"p\", /*!*/ends: ((1, 0, 0), (1, 0, 0)))");
    primitive(
        "zero-direction",
        "root/p",
        "Ray(name: \"p\", origin: (0,0,0), /*!*/direction: (0, 0, 0), length: 1)",
    );
    primitive(
        "not-positive",
        "root/p",
        "Ray(name: \"p\", origin: (0,0,0), direction: (0,0,1), /*!*/length: 0)",
    );
    primitive(
        "not-finite",
        "root/p",
        "Ray(name: \"p\", origin: (0,0,0), direction: (0,0,1), /*!*/length: inf)",
    );
    primitive(
        "negative",
        "root/p",
        "Ray(name: \"p\", origin: (0,0,0), direction: (0,0,1), length: 1, /*!*/reach: -1)",
    );
    primitive("not-positive", "root/p", "Sphere(name: \"p\", center: (0,0,0), /*!*/radius: -1)");
    primitive("not-positive", "root/p", "Ellipsoid(name: \"p\", center: (0,0,0), /*!*/semi_axes: (1, 0, 1))");
    primitive("unknown-primitive", "root/p", "/*!*/Custom(name: \"p\", kind: \"torus\")");
    primitive("unknown-field", "root/p", "Sphere(name: \"p\", center: (0,0,0), radius: 1,\n/*!*/ radios: 2)");
}

#[test]
fn sizes_beyond_what_can_be_computed_with() {
    for size in ["1.1e-30", "0.7e30"] {
        for shape in shapes(size) {
            assert!(accepts(&shape), "{shape}");
        }
    }
    for size in ["0.5e-30", "1e-81", "1.1e30", "1e77"] {
        for shape in shapes(size) {
            primitive("size-range", "root/p", &format!("/*!*/{shape}"));
        }
    }
    primitive("size-range", "root/p", &format!("/*!*/{}", shapes("1e-171")[0]));
    // A large coordinate is not a large size, and a ray needs no reach.
    assert!(accepts("Sphere(name: \"p\", center: (1e50, 0, 0), radius: 1)"));
    assert!(accepts("Ray(name: \"p\", origin: (0,0,0), direction: (0,0,1), length: 1, reach: 0)"));
}

/// Shapes of every kind that has a size.
fn shapes(size: &str) -> Vec<String> {
    let s = size;
    vec![
        format!("LineSegment(name: \"p\", ends: ((0,0,0), (0,{s},0)))"),
        format!("Ray(name: \"p\", origin: (0,0,0), direction: (0,0,1), length: {s})"),
        format!("Ray(name: \"p\", origin: (0,0,0), direction: (0,0,1), length: 1, reach: {s})"),
        format!("Sphere(name: \"p\", center: (0,0,0), radius: {s})"),
        format!("Ellipsoid(name: \"p\", center: (0,0,0), semi_axes: ({s}, {s}, {s}))"),
        format!("Capsule(name: \"p\", ends: ((0,0,0), (0,{s},0)), radius: 1)"),
        format!("Capsule(name: \"p\", ends: ((0,0,0), (0,1,0)), radius: {s})"),
        format!("Cylinder(name: \"p\", ends: ((0,0,0), (0,{s},0)), radius: 1)"),
        format!("Cylinder(name: \"p\", ends: ((0,0,0), (0,1,0)), radius: {s})"),
        format!("Cone(name: \"p\", ends: ((0,0,0), (0,1,0)), radii: (0, {s}))"),
        format!("Cone(name: \"p\", ends: ((0,0,0), (0,1,0)), radii: ({s}, 1))"),
        format!("Bore(name: \"p\", ends: ((0,0,0), (0,1,0)), radii: (1, 1), thickness: {s})"),
        format!("Bore(name: \"p\", ends: ((0,0,0), (0,1,0)), radii: ({s}, 1), thickness: 1)"),
        format!("Triangle(name: \"p\", vertices: ((0,0,0), ({s},0,0), (0,{s},0)))"),
        format!("Triangle(name: \"p\", {TRIANGLE}, thickness: {s})"),
        format!(
            "Polyhedron(name: \"p\", vertices: [(0,0,0), ({s},0,0), (0,{s},0), (0,0,{s})], \
             faces: [[0,2,1], [0,1,3], [1,2,3], [2,0,3]])"
        ),
    ]
}

#[test]
fn faults_of_triangles_and_meshes() {
    primitive(
        "sliver-triangle",
        "root/t",
        "/*!*/Triangle(name: \"t\", vertices: ((0,0,0),(1,0,0),(0.5,1e-10,0)))",
    );
    primitive("sliver-triangle", "root/t", "/*!*/Triangle(name: \"t\", vertices: ((0,0,0),(1,0,0),(1,0,0)))");
    primitive("not-positive", "root/t", &format!("Triangle(name: \"t\", {TRIANGLE}, /*!*/thickness: 0)"));
    let mesh = |vertices: &str, triangles: &str| {
        format!("TriangleMesh(name: \"m\", vertices: [{vertices}],\n triangles: [{triangles}])")
    };
    let flat = "(0,0,0),(1,0,0),(0,1,0),(0,0,1)";
    primitive("index-out-of-range", "root/m/triangles[1]", &mesh(flat, "(0,1,2),\n/*!*/(0,1,4)"));
    primitive("repeated-index", "root/m/triangles[0]", &mesh(flat, "/*!*/(0,1,1)"));
    primitive("not-an-index", "root/m/triangles[0]", &mesh(flat, "/*!*/(0,1,1.5)"));
    primitive("not-an-index", "root/m/triangles[0]", &mesh(flat, "/*!*/(0,1,-1)"));
    primitive("not-a-triangle", "root/m/triangles[0]", &mesh(flat, "/*!*/(0,1,2,3)"));
    primitive("not-finite", "root/m/vertices[1]", &mesh("(0,0,0),\n/*!*/(1,0,inf),(0,1,0)", "(0,1,2)"));
    primitive("too-large", "root/m/vertices[1]", &mesh("(0,0,0),\n/*!*/(1,0,1e154),(0,1,0)", "(0,1,2)"));
    primitive("wrong-type", "root/m/vertices[1]", &mesh("(0,0,0),\n/*!*/(1,0),(0,1,0)", "(0,1,2)"));
    primitive("wrong-type", "root/m/vertices", &mesh("(0,0,0),\n/*!*/(1,0,\"a\"),(0,1,0)", "(0,1,2)"));
    primitive(
        "sliver-triangle",
        "root/m/triangles[1]",
        &mesh("(0,0,0),(1,0,0),(0,1,0),(2,0,0)", "(0,1,2),\n/*!*/(0,1,3)"),
    );
    primitive(
        "duplicate-triangle",
        "root/m/triangles[1]",
        &format!("/*!*/{}", mesh(flat, "(0,1,2),(1,2,0)")),
    );
    primitive("empty-mesh", "root/m", &format!("/*!*/{}", mesh(flat, "")));
    primitive("missing-field", "root/m", "/*!*/TriangleMesh(name: \"m\")");
    primitive("missing-field", "root/m", "/*!*/TriangleMesh(name: \"m\", vertices: [(0,0,0)])");
    primitive("mesh-file-no-folder", "root/m", "TriangleMesh(name: \"m\", /*!*/file: \"a.stl\")");
    for outside in ["../a.stl", "/a.stl", "b/../../a.stl", "C:/a.stl", "b\\\\a.stl"] {
        let text = format!("TriangleMesh(name: \"m\", /*!*/file: \"{outside}\")");
        primitive("mesh-file-outside", "root/m", &text);
    }
    primitive(
        "either-or",
        "root/m",
        "TriangleMesh(name: \"m\", vertices: [], triangles: [],\n/*!*/ file: \"a.txt\")",
    );
}

#[test]
fn a_duplicate_across_primitives_names_both() {
    let text = model_of(&format!("Triangle(name: \"a\", {TRIANGLE}),\nTriangle(name: \"b\", {TRIANGLE})"));
    let errors = faults(&text);
    assert_eq!((errors.0[0].rule, errors.0[0].path.as_str()), ("duplicate-triangle", "root/b"));
    assert!(errors.0[0].cause.contains("root/a"));
}

#[test]
fn a_polyhedron_that_is_none_is_refused() {
    let poly = |vertices: &str, faces: &str| {
        format!("/*!*/Polyhedron(name: \"h\", vertices: {vertices}, faces: {faces})")
    };
    let tet = "[(0,0,0),(1,0,0),(0,1,0),(0,0,1)]";
    primitive("too-few-faces", "root/h", &poly(tet, "[[0,2,1],[0,1,3],[1,2,3]]"));
    primitive("too-few-vertices", "root/h/faces[3]", &poly(tet, "[[0,2,1],[0,1,3],[1,2,3],[2,0]]"));
    primitive("index-out-of-range", "root/h/faces[3]", &poly(tet, "[[0,2,1],[0,1,3],[1,2,3],[2,0,4]]"));
    primitive("repeated-index", "root/h/faces[3]", &poly(tet, "[[0,2,1],[0,1,3],[1,2,3],[2,0,2]]"));
    primitive("inside-out", "root/h", &poly(tet, "[[0,1,2],[0,3,1],[1,3,2],[2,3,0]]"));
    primitive(
        "zero-volume",
        "root/h",
        &poly("[(0,0,0),(1,0,0),(0,1,0),(1,1,0)]", "[[0,2,1],[0,1,3],[1,2,3],[2,0,3]]"),
    );
    let foil = cube_vertices([0.0; 3], [1.0, 1.0, 1e-7]);
    primitive("zero-volume", "root/h", &poly(&foil, CUBE_FACES));
}

/// Rules and paths of all faults, for several faulty faces.
fn all(text: &str) -> Vec<(&'static str, String)> {
    faults(&model_of(text)).0.into_iter().map(|error| (error.rule, error.path)).collect()
}

#[test]
fn an_open_or_dented_polyhedron_names_its_faces() {
    let cube = cube_vertices([0.0; 3], [1.0; 3]);
    let poly = |vertices: &str, faces: &str| {
        all(&format!("Polyhedron(name: \"h\", vertices: {vertices}, faces: {faces})"))
    };
    let open = poly(&cube, &CUBE_FACES.replace(", [3,0,4,7]", ""));
    assert_eq!(open.len(), 4);
    assert!(open.iter().all(|(rule, path)| *rule == "open-polyhedron" && path.starts_with("root/h/faces[")));
    let turned = poly(&cube, &CUBE_FACES.replace("[3,0,4,7]", "[7,4,0,3]"));
    assert!(turned.len() == 5 && turned.iter().all(|(rule, _)| *rule == "open-polyhedron"));
    // One corner pushed in: its three faces bend.
    let bent = poly(&cube.replace("(1.0,1.0,1.0)", "(0.9,1.0,1.0)"), CUBE_FACES);
    assert_eq!(bent, [("face-not-planar", "root/h/faces[3]".to_owned())]);
    let dented = "[[0,3,2,1], [4,5,8],[5,6,8],[6,7,8],[7,4,8], [0,1,5,4], [1,2,6,5], [2,3,7,6], [3,0,4,7]]";
    let dent = poly(&cube.replace(']', ",(0.5,0.5,0.9)]"), dented);
    assert!(dent.len() == 4 && dent.iter().all(|(rule, _)| *rule == "not-convex"), "{dent:?}");
    // An L seen from above.
    let l =
        "[(0,0,0),(2,0,0),(2,1,0),(1,1,0),(1,2,0),(0,2,0),(0,0,1),(2,0,1),(2,1,1),(1,1,1),(1,2,1),(0,2,1)]";
    let l_faces =
        "[[5,4,3,2,1,0],[6,7,8,9,10,11],[0,1,7,6],[1,2,8,7],[2,3,9,8],[3,4,10,9],[4,5,11,10],[5,0,6,11]]";
    let rules: Vec<_> = poly(l, l_faces).into_iter().map(|(rule, _)| rule).collect();
    assert_eq!(rules, ["face-not-convex", "face-not-convex", "not-convex", "not-convex"]);
    let same = poly(&cube.replace("(1.0,0.0,0.0)", "(0.0,0.0,0.0)"), CUBE_FACES);
    assert!(same.contains(&("zero-length-edge", "root/h/faces[0]".to_owned())), "{same:?}");
    let thin = "[(0,0,0),(1,0,0),(0.5,1e-10,0),(0,0,1)]";
    let sliver = poly(thin, "[[0,2,1],[0,1,3],[1,2,3],[2,0,3]]");
    assert_eq!(sliver, [("sliver-face", "root/h/faces[0]".to_owned())]);
    assert_eq!(poly(&cube.replace("(1.0,1.0,1.0)", "(1,1,inf)"), CUBE_FACES).len(), 1);
    let inactive = all(&common::cube("h", [0.0; 3], [1.0; 3], "[6]"));
    assert_eq!(inactive, [("index-out-of-range", "root/h".to_owned())]);
}

#[test]
fn a_file_full_of_faults_has_them_all_reported_in_order() {
    let errors = faults(include_str!("../models/faulty.ron"));
    let found: Vec<_> = errors.0.iter().map(|e| (e.line, e.rule, e.path.as_str())).collect();
    assert_eq!(
        found,
        [
            (3, "version", "model"),
            (5, "unknown-field", "model"),
            (7, "not-positive", "surfaces/steel"),
            (8, "missing-field", "surfaces/rubber"),
            (8, "unknown-field", "surfaces/rubber"),
            (12, "repeated-name", "rig/arm"),
            (14, "quaternion-norm", "rig/arm"),
            (16, "not-positive", "rig/arm/a"),
            (17, "unknown-surface", "rig/arm/b"),
            (18, "wrong-type", "rig/arm/c"),
            (19, "missing-field", "rig/arm/primitives[3]"),
        ]
    );
    assert!(errors.0[1].cure.contains("did you mean `name`?"), "{}", errors.0[1]);
    assert!(errors.0[8].cure.contains("did you mean `steel`?"), "{}", errors.0[8]);
    assert_eq!(errors.to_string().lines().count(), found.len());
}

#[test]
fn a_mesh_full_of_faults_lists_a_handful() {
    let triangles = "(0,1,1),".repeat(100);
    let text = format!("TriangleMesh(name: \"m\", vertices: [(0,0,0),(1,0,0)], triangles: [{triangles}])");
    let found = all(&text);
    assert_eq!(found.len(), 21);
    assert_eq!(found.iter().filter(|(rule, _)| *rule == "more-faults").count(), 1);
}

#[test]
fn a_file_that_cannot_be_read_is_an_error_too() {
    let path = std::path::Path::new("no/such/model.ron");
    let errors = pong_model::load(path, &Extensions::new()).expect_err("there is none");
    assert_eq!(errors.0[0].rule, "unreadable");
}

/// Rules without a test, because they need files of gigabytes.
const UNTESTED: [&str; 2] = ["text-too-long", "too-many-triangles"];

/// Every rule that the source can report, found by reading it, is described.
#[test]
fn every_rule_of_the_source_is_described_in_the_format() {
    let described = include_str!("../../../../docs/model_format.md");
    for rule in rules_of_the_source() {
        assert!(described.contains(&format!("| `{rule}` |")), "docs/model_format.md lacks the rule `{rule}`");
    }
}

/// Every rule is tested here or in the tests of meshes, extensions, authored files and solids.
#[test]
fn every_rule_of_the_source_has_a_test() {
    let tests = [
        include_str!("rejects.rs"),
        include_str!("meshes.rs"),
        include_str!("extensions.rs"),
        include_str!("authored.rs"),
        include_str!("solids.rs"),
    ]
    .concat();
    for rule in rules_of_the_source().into_iter().filter(|rule| !UNTESTED.contains(&rule.as_str())) {
        assert!(tests.contains(&format!("\"{rule}\"")), "no test for the rule `{rule}`");
    }
}

fn rules_of_the_source() -> BTreeSet<String> {
    let mut rules = BTreeSet::new();
    let mut folders = vec![std::path::PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("src")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("the source") {
            let path = entry.expect("an entry").path();
            if path.is_dir() && path.ends_with("mesh_formats") {
                // A model reports these as `mesh-file-damaged`; docs/importing.md lists them.
            } else if path.is_dir() {
                folders.push(path);
            } else if path.file_name().is_some_and(|name| name != "tests.rs") {
                rules.extend(rules_of(&std::fs::read_to_string(path).expect("text")));
            }
        }
    }
    assert!(rules.len() > 40, "{rules:?}");
    rules
}

/// Quoted texts that look like a rule: lower-case letters and hyphens, or a known single word.
fn rules_of(source: &str) -> Vec<String> {
    let single = ["syntax", "format", "version", "negative", "exponent", "bound", "unreadable"];
    let source = source.split("#[cfg(test)]").next().unwrap_or_default();
    let quoted = source.lines().filter(|line| !line.trim_start().starts_with("//"));
    let quoted = quoted.flat_map(|line| line.split('"').skip(1).step_by(2));
    let is_rule = |text: &&str| {
        let hyphened = text.contains('-') && !text.starts_with('-') && !text.ends_with('-');
        (hyphened && text.chars().all(|c| c.is_ascii_lowercase() || c == '-')) || single.contains(text)
    };
    quoted
        .filter(is_rule)
        .filter(|text| !["pong-model", "pong-scene"].contains(text))
        .map(str::to_owned)
        .collect()
}

/// One fault of a primitive does not hide the next.
#[test]
fn every_fault_of_a_primitive_is_told() {
    let ray =
        "Ray(name: \"r\", origin: (0, 0, 0), direction: (0, 0, 0), length: -1, reach: -3, response: Both)";
    let wedge = "Polyhedron(name: \"w\", vertices: [(0,0,0),(1,0,0),(0,1,0),(0,0,1)], \
                 faces: [[0,2,1],[0,1,3],[1,2,3],[2,0,3]], inactive_faces: [9, -1])";
    let rules = |primitive: &str| {
        let text = format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{\"s\": (stiffness: 1)}}, \
             root: (name: \"root\", surface: \"s\", primitives: [{primitive}]))"
        );
        let errors = pong_model::parse(&text, "m.ron", None, &Default::default()).expect_err("faults");
        errors.0.iter().map(|error| error.rule).collect::<Vec<_>>()
    };
    assert_eq!(rules(ray), ["zero-direction", "not-positive", "negative", "unknown-kind"]);
    assert_eq!(rules(wedge), ["index-out-of-range", "index-out-of-range"]);
}
