//! Parts of meshes that are capsules, cylinders, cones and bores: recognised within a tolerance, left alone
//! beyond it.

use crate::common::*;
use nalgebra::{UnitQuaternion, Vector3};
use pong_import::{Imported, Options};
use pong_model::{Model, MovableGroup};
use pong_testkit::Random;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

const KINDS: [&str; 4] = ["Capsule", "Cylinder", "Cone", "Bore"];
const SIDES: [usize; 3] = [16, 32, 64];
const LENGTH: f64 = 0.4;
const RADIUS: f64 = 0.1;

/// Radii at both ends.
fn radii(kind: &str) -> [f64; 2] {
    if kind == "Cone" || kind == "Bore" { [RADIUS, 0.06] } else { [RADIUS; 2] }
}

/// Sagitta of a side of a regular polygon in a unit circle.
fn sag(sides: usize) -> f64 {
    1.0 - (PI / sides as f64).cos()
}

/// Rings with one corner per side around z: (height, radius) each.
fn rings(sides: usize, profile: &[[f64; 2]]) -> Vec<Vec<Vector3<f64>>> {
    let corner = |[z, r]: [f64; 2], i: usize| {
        let turn = TAU * i as f64 / sides as f64;
        Vector3::new(r * turn.cos(), r * turn.sin(), z)
    };
    profile.iter().map(|&at| (0..sides).map(|i| corner(at, i)).collect()).collect()
}

/// Outward triangles between rings, and over the first and last ring.
fn skin(rings: &[Vec<Vector3<f64>>], closed: bool) -> Vec<[Vector3<f64>; 3]> {
    let sides = rings[0].len();
    let mut triangles = Vec::new();
    for two in rings.windows(2) {
        for i in 0..sides {
            let j = (i + 1) % sides;
            let [a, b, c, d] = [two[0][i], two[0][j], two[1][j], two[1][i]];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    if closed {
        let (low, high) = (&rings[0], &rings[rings.len() - 1]);
        for i in 1..sides - 1 {
            triangles.extend([[low[0], low[i + 1], low[i]], [high[0], high[i], high[i + 1]]]);
        }
    }
    triangles
}

fn mesh(kind: &str, sides: usize) -> Vec<[Vector3<f64>; 3]> {
    let [r0, r1] = radii(kind);
    let half = 0.5 * LENGTH;
    match kind {
        "Capsule" => {
            let quarter = sides / 4;
            let arc = |i: usize| 0.5 * PI * i as f64 / quarter as f64;
            // The poles are rings of radius zero: triangles without area, which the importer drops.
            let low = (0..=quarter).map(|i| [-half - r0 * arc(i).cos(), r0 * arc(i).sin()]);
            let high = (0..=quarter).rev().map(|i| [half + r0 * arc(i).cos(), r0 * arc(i).sin()]);
            let mut profile: Vec<_> = low.chain(high).collect();
            let last = profile.len() - 1;
            (profile[0][1], profile[last][1]) = (0.0, 0.0);
            skin(&rings(sides, &profile), false)
        }
        "Bore" => {
            let outward = skin(&rings(sides, &[[-half, r0], [half, r1]]), false);
            outward.into_iter().map(|[a, b, c]| [a, c, b]).collect()
        }
        _ => skin(&rings(sides, &[[-half, r0], [half, r1]]), true),
    }
}

/// Every vertex moved by up to `size`; equal points stay equal.
fn noisy(triangles: &[[Vector3<f64>; 3]], size: f64, random: &mut Random) -> Vec<[Vector3<f64>; 3]> {
    let mut moved: Vec<(Vector3<f64>, Vector3<f64>)> = Vec::new();
    let mut place = |at: Vector3<f64>| match moved.iter().find(|(old, _)| (old - at).norm() < 1e-12) {
        Some((_, new)) => *new,
        None => {
            let new = at + random.direction() * size;
            moved.push((at, new));
            new
        }
    };
    triangles.iter().map(|triangle| triangle.map(&mut place)).collect()
}

struct Pose(UnitQuaternion<f64>, Vector3<f64>);

impl Pose {
    fn random(random: &mut Random) -> Self {
        Self(random.orientation(), random.vector(1.0))
    }

    fn place(&self, triangles: &[[Vector3<f64>; 3]]) -> Vec<[Place; 3]> {
        triangles.iter().map(|triangle| triangle.map(|at| (self.1 + self.0 * at).into())).collect()
    }
}

fn imported(test: &str, triangles: &[[Place; 3]], round_m: Option<f64>) -> (Imported, Model) {
    let path = folder(test).join("part.obj");
    std::fs::write(&path, obj(triangles)).unwrap();
    run(&path, &Options { round_m, faces_max: 10_000, ..options() }).unwrap()
}

/// Ends and radii of the only round primitive, the end nearer to `low` first.
fn round_of(body: &MovableGroup, kind: &str, low: &Vector3<f64>) -> ([Vector3<f64>; 2], [f64; 2]) {
    let (mut ends, mut radii) = match kind {
        "Capsule" => (body.capsules[0].ends, [body.capsules[0].radius; 2]),
        "Bore" => (body.bores[0].hole.ends, body.bores[0].hole.radii),
        _ => (body.frusta[0].ends, body.frusta[0].radii),
    };
    if (ends[1] - low).norm() < (ends[0] - low).norm() {
        ends.reverse();
        radii.reverse();
    }
    (ends, radii)
}

/// Largest distance given in the note, m.
fn told_m(imported: &Imported) -> f64 {
    let note = imported.findings.notes.iter().find(|note| note.rule == "round").expect("a note");
    let words: Vec<&str> = note.cause.split(' ').collect();
    let at = words.iter().position(|word| *word == "is").expect("a distance");
    words[at + 1].parse().expect("a number")
}

/// The middle of a polygon's side is nearer to the axis than its corners: this sagitta alone decides.
#[test]
fn turned_and_moved_meshes_are_recognised_within_the_sag_of_their_sides_and_left_below_it() {
    for (stream, kind) in KINDS.into_iter().enumerate() {
        for sides in SIDES {
            let mut random = Random::new(31, stream as u64, sides as u64);
            let pose = Pose::random(&mut random);
            let triangles = pose.place(&mesh(kind, sides));
            // For a capsule in both directions: the middle of a face of its spheres.
            let farthest = RADIUS * sag(sides) * if kind == "Capsule" { 2.0 } else { 1.0 };
            let test = format!("sag_{kind}_{sides}");
            let (told, model) = imported(&test, &triangles, Some(1.05 * farthest));
            assert_eq!(told.primitives, [(kind, 1)], "{sides} sides");
            // At the larger end of a cone a distance across is less than that around it.
            let expected = told_m(&told) / farthest;
            assert!((0.6..=1.01).contains(&expected), "{kind} of {sides} sides: {expected}");
            let body = &model.bodies[0];
            let [low, high] = [-0.5, 0.5].map(|z| pose.1 + pose.0 * Vector3::new(0.0, 0.0, z * LENGTH));
            let (ends, found) = round_of(body, kind, &low);
            let off = (ends[0] - low).norm().max((ends[1] - high).norm());
            assert!(off < 1e-9, "{kind} of {sides} sides: ends {off:e} m away");
            let wide = radii(kind);
            assert!((found[0] - wide[0]).abs().max((found[1] - wide[1]).abs()) < 1e-9, "{kind}: {found:?}");
            let (left, model) = imported(&test, &triangles, Some(0.5 * farthest));
            let expected = if kind == "Bore" { "TriangleMesh" } else { "Polyhedron" };
            assert_eq!(left.primitives, [(expected, 1)], "{sides} sides within half of their sag");
            assert!(
                model.bodies[0].capsules.is_empty() && note_rules(&left).iter().all(|rule| *rule != "round")
            );
        }
    }
}

/// A mesh with noise within the tolerance is recognised, with a part near the true one; with more noise it is
/// not.
#[test]
fn noise_below_the_tolerance_is_fitted_and_noise_above_it_is_not_taken() {
    let tolerance = 5e-3;
    for (stream, kind) in KINDS.into_iter().enumerate() {
        for sides in SIDES {
            let mut random = Random::new(32, stream as u64, sides as u64);
            let pose = Pose::random(&mut random);
            let test = format!("noise_{kind}_{sides}");
            let below = pose.place(&noisy(&mesh(kind, sides), 0.8e-3, &mut random));
            let (told, model) = imported(&test, &below, Some(tolerance));
            assert_eq!(told.primitives, [(kind, 1)], "{sides} sides");
            assert!(told_m(&told) <= tolerance);
            let low = pose.1 + pose.0 * Vector3::new(0.0, 0.0, -0.5 * LENGTH);
            let (ends, found) = round_of(&model.bodies[0], kind, &low);
            assert!((ends[0] - low).norm() < 1.5e-3, "{kind} of {sides}: {:e}", (ends[0] - low).norm());
            assert!((found[0] - radii(kind)[0]).abs() < 1e-3, "{kind} of {sides}: {found:?}");
            let above = pose.place(&noisy(&mesh(kind, sides), 2.0 * tolerance, &mut random));
            let (left, _) = imported(&test, &above, Some(tolerance));
            assert!(left.primitives.iter().all(|(found, _)| !KINDS.contains(found)), "{:?}", left.primitives);
        }
    }
}

#[test]
fn nothing_is_recognised_unless_it_is_asked_for() {
    let triangles = Pose(UnitQuaternion::identity(), Vector3::zeros()).place(&mesh("Cylinder", 32));
    assert_eq!(imported("unasked", &triangles, None).0.primitives, [("Polyhedron", 1)]);
}

/// A box and a hexagon are meant as they are, a tube without ends is no solid, and half a cylinder is
/// incomplete, at any tolerance.
#[test]
fn what_is_no_round_part_stays_what_it_is() {
    let still = Pose(UnitQuaternion::identity(), Vector3::zeros());
    let half = 0.5 * LENGTH;
    let prism = |sides: usize| still.place(&skin(&rings(sides, &[[-half, RADIUS], [half, RADIUS]]), true));
    for sides in [4, 6] {
        assert_eq!(imported("prism", &prism(sides), Some(0.05)).0.primitives, [("Polyhedron", 1)], "{sides}");
    }
    let tube = still.place(&skin(&rings(32, &[[-half, RADIUS], [half, RADIUS]]), false));
    assert_eq!(imported("tube", &tube, Some(0.005)).0.primitives, [("TriangleMesh", 1)]);
    let mut open = mesh("Bore", 32);
    open.truncate(32);
    assert_eq!(imported("half", &still.place(&open), Some(0.005)).0.primitives, [("TriangleMesh", 1)]);
    let mut inside_out = mesh("Cylinder", 32);
    inside_out.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    assert_eq!(
        imported("inside_out", &still.place(&inside_out), Some(0.005)).0.primitives,
        [("TriangleMesh", 1)]
    );
}

/// Parts of one object are reported separately: a pin, a box that stays a box, and a cone with a tip.
#[test]
fn each_part_of_an_object_is_judged_by_itself() {
    let at = |x: f64| Pose(UnitQuaternion::identity(), Vector3::new(x, 0.0, 0.0));
    let cone = skin(&rings(32, &[[0.0, RADIUS], [LENGTH, 0.0]]), false);
    let floor = &rings(32, &[[0.0, RADIUS]])[0];
    let base = (1..31).map(|i| [floor[0], floor[i + 1], floor[i]]);
    let cone: Vec<_> = cone.into_iter().chain(base).collect();
    let square = skin(&rings(4, &[[0.0, RADIUS], [LENGTH, RADIUS]]), true);
    let parts = [at(0.0).place(&mesh("Cylinder", 32)), at(1.0).place(&square), at(2.0).place(&cone)].concat();
    let (told, model) = imported("parts", &parts, Some(1e-3));
    assert_eq!(told.primitives, [("Polyhedron", 1), ("Cylinder", 1), ("Cone", 1)]);
    let body = &model.bodies[0];
    let (ends, radii) = round_of(
        &MovableGroup { frusta: vec![body.frusta[1]], ..body.clone() },
        "Cone",
        &Vector3::new(2.0, 0.0, 0.0),
    );
    assert!(
        (ends[1] - Vector3::new(2.0, 0.0, LENGTH)).norm() < 1e-9 && radii[1] == 0.0,
        "{ends:?} {radii:?}"
    );
}

fn marked(mark: Value) -> Value {
    json!({"pong": mark})
}

/// The axis of a mark is z of the model, and its middle the origin of its node; scale applies along and
/// around it.
#[test]
fn marks_of_round_kinds_make_them() {
    let mut gltf = Gltf::new();
    let s = 0.5f64.sqrt();
    let add = |gltf: &mut Gltf, name: &str, scale: [f64; 3], mark: Value| {
        let place = json!({"name": name, "translation": [1.0, 2.0, 3.0], "rotation": [0.0, 0.0, s, s], "scale": scale,
            "extras": marked(mark)});
        gltf.node(None, place)
    };
    // y up: the node's y is the model's z.
    add(&mut gltf, "cable", [2.0; 3], json!({"kind": "Capsule", "length": 1.0, "radius": 0.25}));
    add(&mut gltf, "pin", [2.0, 4.0, 2.0], json!({"kind": "Cylinder", "length": 1.0, "radius": 0.25}));
    add(&mut gltf, "nose", [1.0; 3], json!({"kind": "Cone", "length": 1.0, "radii": [0.25, 0.0]}));
    let mark = json!({"kind": "Bore", "length": 1.0, "radii": [0.5, 0.25], "thickness": 0.125, "mouths": [1, false]});
    add(&mut gltf, "socket", [1.0; 3], mark);
    let path = gltf.save(&folder("marked_round"), "round.glb");
    let (told, model) = run(&path, &options()).unwrap();
    assert_eq!(told.primitives, [("Capsule", 1), ("Cylinder", 1), ("Cone", 1), ("Bore", 1)]);
    let body = &model.bodies[0];
    // A quarter turn about the file's z, which is -y of the model, takes the model's z to -x.
    let center = Vector3::new(1.0, -3.0, 2.0);
    let near = |ends: [Vector3<f64>; 2], half: f64| {
        let expected = [center + Vector3::x() * half, center - Vector3::x() * half];
        assert!((ends[0] - expected[0]).norm() + (ends[1] - expected[1]).norm() < 1e-12, "{ends:?}");
    };
    near(body.capsules[0].ends, 1.0);
    assert!((body.capsules[0].radius - 0.5).abs() < 1e-12);
    let (pin, nose, bore) = (&body.frusta[1], &body.frusta[0], &body.bores[0]);
    near(pin.ends, 2.0);
    assert!((pin.radii[0] - 0.5).abs() < 1e-12);
    near(nose.ends, 0.5);
    assert_eq!(nose.radii, [0.25, 0.0]);
    near(bore.hole.ends, 0.5);
    assert_eq!((bore.hole.radii, bore.thickness, bore.mouths), ([0.5, 0.25], 0.125, [true, false]));
}

#[test]
fn marks_that_make_no_round_part_are_refused() {
    let faults = |scale: [f64; 3], mark: Value| {
        let mut gltf = Gltf::new();
        gltf.node(None, json!({"name": "part", "scale": scale, "extras": marked(mark)}));
        let path = gltf.save(&folder("refused_round"), "round.glb");
        // A node with an unreadable mark has none, so there is nothing to import.
        let rules = rules(&run(&path, &options()).unwrap_err());
        rules.into_iter().filter(|rule| *rule != "empty-mesh").collect::<Vec<_>>()
    };
    assert_eq!(faults([1.0; 3], json!({"kind": "Cylinder", "radius": 1.0})), ["not-positive"]);
    assert_eq!(
        faults([1.0; 3], json!({"kind": "Cone", "length": 1.0, "radii": [0.0, 0.0]})),
        ["not-positive"]
    );
    assert_eq!(faults([1.0; 3], json!({"kind": "Cone", "length": 1.0, "radii": [1.0]})), ["mark"]);
    let bore = json!({"kind": "Bore", "length": 1.0, "radii": [1.0, 1.0], "mouths": [true]});
    assert_eq!(faults([1.0; 3], bore), ["mark"]);
    let long = [1.0, 3.0, 1.0];
    assert_eq!(faults(long, json!({"kind": "Capsule", "length": 1.0, "radius": 1.0})), ["sheared-shape"]);
    assert_eq!(
        faults([1.0, 1.0, 3.0], json!({"kind": "Cylinder", "length": 1.0, "radius": 1.0})),
        ["sheared-shape"]
    );
}
