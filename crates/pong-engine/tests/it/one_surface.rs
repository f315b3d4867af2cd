//! Primitives that a group declares one surface act like one plane where they are flush (docs/theory.md, 2.2).

use crate::common::*;
use pong_engine::State;
use pong_geometry::{Quat, Vec3};

const K: f64 = 1e5;
const DEPTH: f64 = 1e-3;

fn steel() -> String {
    surface(K, "normal: Linear(damping: 50.0), friction: Bristle(mu: 0.5)")
}

/// Model of one declared surface.
fn joint(primitives: &str) -> String {
    model("joint", &steel(), primitives).replace("surface: \"s\"", "surface: \"s\", one_surface: true")
}

fn plane() -> String {
    model("plane", &steel(), PLANE)
}

const PLANE: &str = "Plane(name: \"plane\", normal: (0,0,1), offset: 0.0)";

/// Box with its top at `top`, from `low` to `high` in the plane.
fn block(name: &str, low: [f64; 2], high: [f64; 2], top: f64) -> String {
    let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    let half = [0, 1].map(|axis| 0.5 * (high[axis] - low[axis]));
    box_polyhedron(name, [middle[0], middle[1], top - 0.2], [half[0], half[1], 0.2], "")
}

/// Flat patch of two triangles at height 0.
fn patch(name: &str, low: [f64; 2], high: [f64; 2]) -> String {
    let corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
    let corners = corners.map(|[x, y]| Vec3::new(x, y, 0.0));
    triangle_mesh(name, &corners, &[[0, 1, 2], [0, 2, 3]], "")
}

const LOW: [f64; 2] = [-1.0, -1.0];
const HIGH: [f64; 2] = [1.0, 1.0];

/// Bodies of flush primitives with a seam along x = 0.
fn bodies() -> Vec<(&'static str, String)> {
    let left = block("left", LOW, [0.0, 1.0], 0.0);
    let right = block("right", [0.0, -1.0], HIGH, 0.0);
    let quarters = [[-1.0, -1.0], [0.0, -1.0], [-1.0, 0.0], [0.0, 0.0]].map(|low| {
        let name = format!("q{}{}", low[0], low[1]);
        block(&name, low, [low[0] + 1.0, low[1] + 1.0], 0.0)
    });
    let on = block("on", [-0.05, -0.9], [0.05, 0.9], 0.0);
    vec![
        ("two boxes", format!("{left}, {right}")),
        ("three boxes", [&*left, &quarters[1], &quarters[3]].join(",")),
        ("four boxes", quarters.join(",")),
        ("a box twice", format!("{left}, {right}, {}", right.replace("right", "again"))),
        ("a box across the seam of two", format!("{left}, {right}, {on}")),
        ("a gap of 1e-9", format!("{left}, {}", block("right", [1e-9, -1.0], HIGH, 0.0))),
        ("a plane and a box", format!("{PLANE}, {right}")),
        ("a plane twice", format!("{PLANE}, {}", PLANE.replace("\"plane\"", "\"again\""))),
        ("a wide box and a narrow one", format!("{left}, {}", block("narrow", [0.0, -0.7], [1.0, 0.6], 0.0))),
        (
            "a narrow box and a wide one",
            format!("{}, {right}", block("narrow", [-1.0, -0.7], [0.0, 0.6], 0.0)),
        ),
    ]
}

/// Bodies with triangles, which points and segments do not touch.
fn bodies_of_triangles() -> Vec<(&'static str, String)> {
    let left = patch("left", LOW, [0.0, 1.0]);
    let right = patch("right", [0.0, -1.5], [1.0, 1.2]);
    vec![
        ("two patches", format!("{left}, {right}")),
        ("a patch twice", format!("{left}, {right}, {}", right.replace("right", "again"))),
        ("a box beside a patch", format!("{left}, {}", block("right", [0.0, -1.0], HIGH, 0.0))),
        ("a patch on a box", format!("{}, {right}", block("whole", LOW, HIGH, 0.0))),
        ("a plane and a patch", format!("{PLANE}, {right}")),
        (
            "a patch beside one with a gap of 1e-9",
            format!("{left}, {}", patch("right", [1e-9, -1.5], [1.0, 1.2])),
        ),
    ]
}

const ROUND: [(&str, &str); 3] = [
    ("ball", "Sphere(name: \"m\", center: (0,0,0.1), radius: 0.1)"),
    (
        "egg",
        "Ellipsoid(name: \"m\", center: (0,0,0.06), semi_axes: (0.12,0.07,0.06), orientation: (0.8,0.0,0.0,0.6))",
    ),
    ("capsule", "Capsule(name: \"m\", ends: ((-0.1,0.02,0.05),(0.12,-0.01,0.05)), radius: 0.05)"),
];
const SHARP: [(&str, &str); 2] = [
    ("point", "Point(name: \"m\", position: (0,0,0))"),
    ("segment", "LineSegment(name: \"m\", ends: ((-0.13,0.02,0),(0.12,-0.01,0)))"),
];

/// Places of the ends of the segment, m.
const SEGMENT: [f64; 2] = [-0.13, 0.12];

/// Drags a mover over the seam of a body and over a plane; returns the worst difference of the wrenches at the places
/// (x, m) that count, relative to the normal force.
fn dragged(mover: &str, body: &str, counts: impl Fn(f64) -> bool) -> f64 {
    let mover = model("mover", &steel(), mover);
    let mut rigs = [Rig::new(&mover, &joint(body)), Rig::new(&mover, &plane())];
    let speed = 0.5;
    let mut worst = 0.0_f64;
    for step in -200..=200 {
        // At step 0 the mover is exactly over the seam, and over the corner of four boxes.
        let place = Vec3::new(f64::from(step) * 1e-3, f64::from(step) * 2e-4, -DEPTH);
        let state = moving(place, Quat::identity(), Vec3::new(speed, 0.2 * speed, 0.0), Vec3::zeros());
        let [got, expected] = rigs.each_mut().map(|rig| {
            rig.place([state, State::identity()]);
            rig.world.step().unwrap();
            rig.wrench(0)
        });
        assert!(expected.force.z > 0.4 * K * DEPTH, "{expected:?}");
        let off = (got.force - expected.force).norm() + (got.moment - expected.moment).norm();
        if counts(place.x) {
            worst = worst.max(off / expected.force.z);
        }
    }
    worst
}

/// Greatest difference from a plane, relative to the normal force: rounding, or the slope of a normal over a gap.
fn most(name: &str) -> f64 {
    if name.contains("gap") { 1e-7 } else { 1e-9 }
}

#[test]
fn movers_do_not_notice_a_seam() {
    let of_triangles = bodies_of_triangles();
    let round = ROUND
        .iter()
        .flat_map(|mover| bodies().into_iter().chain(of_triangles.clone()).map(move |body| (mover, body)));
    let sharp = SHARP.iter().flat_map(|mover| bodies().into_iter().map(move |body| (mover, body)));
    let mut failed = Vec::new();
    for ((what, mover), (name, body)) in round.chain(sharp) {
        let counts = |x: f64| {
            // Near a wall that is covered in part, an end of a segment is pushed out through it.
            let is_limit = *what == "segment" && name.contains("narrow");
            !is_limit || SEGMENT.iter().all(|end| (x + end).abs() > 0.02)
        };
        let worst = dragged(mover, &body, counts);
        println!("{what} over {name}: {worst:.1e}");
        if worst > most(name) {
            failed.push(format!("{what} over {name}: {worst:e}"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Distance of the top of the right box above that of the left one, m.
const STEPS: [f64; 4] = [1e-9, 1e-8, 1e-7, 1e-6];

/// A step counts as flush up to 1e-6 of the size; the force changes by its height and no more.
#[test]
fn a_small_step_changes_the_force_by_its_height() {
    for (what, mover) in ROUND.into_iter().chain(SHARP) {
        for step in STEPS {
            let body = format!(
                "{}, {}",
                block("left", LOW, [0.0, 1.0], 0.0),
                block("right", [0.0, -1.0], HIGH, step)
            );
            let worst = dragged(mover, &body, |_| true);
            println!("{what} over a step of {step:e}: {worst:.1e}");
            assert!(worst <= 1e-9 + 3.0 * step / DEPTH, "{what} over {step:e}: {worst:e}");
        }
    }
}

/// A ball on the seam that is moved to and fro by 1 µm sticks, and its bristle is that of a ball on a plane.
#[test]
fn a_ball_on_the_seam_sticks() {
    let ball = model("mover", &steel(), ROUND[0].1);
    let friction = |body: &str| -> Vec<f64> {
        let mut rig = Rig::new(&ball, body);
        let at_step = |step: i32| {
            let x = 1e-6 * libm::sin(f64::from(step) * std::f64::consts::PI / 20.0);
            rig.place_a(Vec3::new(x, 0.0, -DEPTH), Quat::identity());
            rig.world.step().unwrap();
            rig.wrench(0).force.x
        };
        (0..=40).map(at_step).collect()
    };
    let expected = friction(&plane());
    assert!(expected[10] < -0.01, "{expected:?}");
    for (name, body) in bodies().into_iter().chain(bodies_of_triangles()) {
        for (got, expected) in friction(&joint(&body)).iter().zip(&expected) {
            assert!((got - expected).abs() <= most(name), "{name}: {got:e} {expected:e}");
        }
    }
}

/// Two solids of a declared surface are one solid: a solid box that is dragged over their joint does not notice it.
#[test]
fn a_solid_box_does_not_notice_the_joint_of_two_solids() {
    let solid = |text: String| text.replace("surface: \"s\"", "surface: \"s\", contact: Solid");
    let mover =
        solid(model("mover", &steel(), &box_polyhedron("m", [0.0, 0.0, 0.05], [0.1, 0.08, 0.05], "")));
    let two = format!("{}, {}", block("left", LOW, [0.0, 1.0], 0.0), block("right", [0.0, -1.0], HIGH, 0.0));
    let whole = solid(model("whole", &steel(), &block("whole", LOW, HIGH, 0.0)));
    let mut rigs = [Rig::new(&mover, &solid(joint(&two))), Rig::new(&mover, &whole)];
    for step in -150..=150 {
        let place = Vec3::new(f64::from(step) * 1e-3, f64::from(step) * 2e-4, -DEPTH);
        let state = moving(place, Quat::identity(), Vec3::new(0.5, 0.1, 0.0), Vec3::zeros());
        let [got, expected] = rigs.each_mut().map(|rig| {
            rig.place([state, State::identity()]);
            rig.world.step().unwrap();
            rig.wrench(0)
        });
        assert!(expected.force.z > 1.0, "{expected:?}");
        let off = (got.force - expected.force).norm() + (got.moment - expected.moment).norm();
        assert!(off <= 1e-9 * expected.force.z, "step {step}: {got:?} {expected:?}");
    }
}
