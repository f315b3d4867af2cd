//! Refused shapes and states, and shapes that must be accepted.

use super::extreme::{Answer, Extreme, Length};
use super::rig::{Rig, block, model, spring};
use crate::case::{Failure, Outcome};
use crate::measure::rotation;
use crate::row::Row;
use pong_engine::State;
use pong_executive::{Quat, Vec3, Wrench};
use pong_model::Extensions;
use pong_testkit::Random;

pub const SHAPES: Extreme = Extreme {
    id: "E4",
    asked: "Slivers, zero lengths, areas and radii, bad polyhedra: refused at load, each with its path and the reason.",
    set_up: "One model per fault; the refusal must name the primitive's path and the rule.",
    answer: Answer::Refused,
    limit: "triangles lower than 1e-9 of their longest edge, polyhedra thinner than 1e-6 of their diameter, vertices \
            more than 1e-6 of the diameter in front of a face",
    also: "`crates/pong-model/tests/it/rejects.rs`",
    rows: shapes,
};

pub const ROUNDED: Extreme = Extreme {
    id: "E5",
    asked: "A good shape that was rounded to single precision is accepted.",
    set_up: "200 boxes of all proportions up to 1 : 1000, from 1e-4 m to 1e4 m, turned and moved by their own size, \
             with their vertices rounded to single precision.",
    answer: Answer::Safe,
    limit: "far from its origin a shape is lost to rounding: from about ten times its size on, single precision is \
            refused, by name",
    also: "`crates/pong-model/tests/it/topology.rs`",
    rows: rounded,
};

pub const RUN_TIME: Extreme = Extreme {
    id: "E8",
    asked: "At run time, NaN, infinity, or a state that was not set: refused by name; the next good frame is as if the \
            bad state had not been set.",
    set_up: "A rolling sphere, 1000 frames. Before every frame a state is set that contains NaN, infinity, a number \
             that cannot be squared, or a quaternion that is not a unit quaternion.",
    answer: Answer::Refused,
    limit: "numbers above 1e100 and quaternions whose norm is off by more than 1e-3 are refused",
    also: "`crates/pong-engine/tests/it/scene.rs`, the fuzz targets",
    rows: run_time,
};

/// Name of the fault, its rule, and the primitive.
fn faults() -> Vec<(&'static str, &'static str, String)> {
    let triangle = |a: &str, b: &str, c: &str| format!("Triangle(name: \"x\", vertices: ({a},{b},{c}))");
    let hull = |vertices: &str, faces: &str| {
        format!("Polyhedron(name: \"x\", vertices: [{vertices}], faces: [{faces}])")
    };
    let corners = "(0,0,0),(1,0,0),(0,1,0),(0,0,1)";
    let cube = "(0,0,0),(1,0,0),(1,1,0),(0,1,0),(0,0,1),(1,0,1),(1,1,1),(0,1,1)";
    vec![
        ("sliver", "sliver-triangle", triangle("(0,0,0)", "(1,0,0)", "(0.5,1e-10,0)")),
        ("corners in a line", "sliver-triangle", triangle("(0,0,0)", "(1,0,0)", "(0.5,0,0)")),
        (
            "line segment of no length",
            "zero-length",
            "LineSegment(name: \"x\", ends: ((1,2,3),(1,2,3)))".to_owned(),
        ),
        ("sphere of no radius", "", "Sphere(name: \"x\", center: (0,0,0), radius: 0.0)".to_owned()),
        ("sphere of a negative radius", "", "Sphere(name: \"x\", center: (0,0,0), radius: -1.0)".to_owned()),
        (
            "ellipsoid with an axis of zero",
            "",
            "Ellipsoid(name: \"x\", center: (0,0,0), semi_axes: (1,0,1))".to_owned(),
        ),
        (
            "ray of no direction",
            "zero-direction",
            "Ray(name: \"x\", origin: (0,0,0), direction: (0,0,0), length: 1.0)".to_owned(),
        ),
        (
            "plane of no normal",
            "zero-direction",
            "Plane(name: \"x\", normal: (0,0,0), offset: 0.0)".to_owned(),
        ),
        ("NaN as a number", "", "Point(name: \"x\", position: (NaN,0,0))".to_owned()),
        (
            "open polyhedron",
            "open-polyhedron",
            hull(cube, "[0,3,2,1],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6]"),
        ),
        ("inside-out polyhedron", "inside-out", hull(corners, "[0,1,2],[0,3,1],[0,2,3],[1,3,2]")),
        (
            "flat polyhedron",
            "zero-volume",
            hull("(0,0,0),(1,0,0),(0,1,0),(0.3,0.3,1e-9)", "[0,2,1],[0,1,3],[0,3,2],[1,2,3]"),
        ),
        (
            "face that is not flat",
            "",
            hull(
                &cube.replace("(1,1,1)", "(1,1,0.99)"),
                "[0,3,2,1],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]",
            ),
        ),
        (
            "dent of 1e-5 of the size",
            "not-convex",
            hull(
                "(0,0,0),(1,0,0),(1,1,0),(0,1,0),(0,0,1),(1,0,1),(1,1,1),(0,1,1),(0.5,0.5,0.99998)",
                "[0,3,2,1],[4,5,8],[5,6,8],[6,7,8],[7,4,8],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]",
            ),
        ),
    ]
}

fn shapes(_: Length) -> Outcome {
    let rows = faults().into_iter().map(|(name, rule, primitive)| {
        let text = model(&spring(1e5), &primitive);
        let told = match pong_model::parse(&text, "extreme.ron", None, &Extensions::new()) {
            Ok(_) => false,
            Err(errors) => {
                let errors = errors.to_string();
                errors.contains("part/x") && errors.contains(rule)
            }
        };
        Row::count(format!("{name}: refused by name"), 1, usize::from(told))
    });
    Ok(rows.collect())
}

fn rounded(_: Length) -> Outcome {
    let mut random = Random(5);
    let count = 200;
    let mut accepted = 0;
    for _ in 0..count {
        let size = libm::pow(10.0, random.between(-4.0, 4.0));
        let half = Vec3::from_fn(|_, _| size * libm::pow(10.0, random.between(-3.0, 0.0)));
        let (turn, shift) = (rotation(random.vector(3.0)), random.vector(half.norm()));
        let narrow = |p: Vec3| (turn * p + shift).map(|x| f64::from(x as f32));
        let text = model(&spring(1e5), &block("x", Vec3::zeros(), half, narrow));
        accepted += usize::from(pong_model::parse(&text, "extreme.ron", None, &Extensions::new()).is_ok());
    }
    Ok(vec![Row::count("boxes accepted of 200", count, accepted)])
}

/// States from which no frame can be computed.
fn bad_states() -> Vec<State> {
    let mut all = Vec::new();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e200] {
        for place in 0..3 {
            let mut states = [State::identity(); 4];
            states[0].position[place] = bad;
            states[1].linear_velocity[place] = bad;
            states[2].angular_velocity[place] = bad;
            states[3].orientation[place + 1] = bad;
            all.extend(states);
        }
    }
    all.push(State { orientation: [0.0; 4], ..State::identity() });
    all.push(State { orientation: [1.01, 0.0, 0.0, 0.0], ..State::identity() });
    all
}

fn ball_on_floor() -> Result<Rig, Failure> {
    let surface = "stiffness: 1e5, normal: Linear(damping: 10.0), friction: Bristle(mu: 0.5)";
    let ball = model(surface, "Sphere(name: \"x\", center: (0,0,0), radius: 0.1)");
    Rig::new(&ball, &model(surface, "Plane(name: \"floor\", normal: (0,0,1), offset: 0.0)"))
}

fn roll(rig: &mut Rig, frame: usize) -> Result<Wrench, Failure> {
    let way = 1e-4 * frame as f64;
    let turn = Quat::from_scaled_axis(Vec3::y() * (12.0 * way));
    rig.step(Vec3::new(way, 0.0, 0.099), turn, Vec3::x() * 0.1)
}

fn run_time(_: Length) -> Outcome {
    let (mut clean, mut tried) = (ball_on_floor()?, ball_on_floor()?);
    let bad = bad_states();
    let (mut refused, mut different) = (0, 0);
    for frame in 0..1000 {
        let before = tried.world.report();
        let answer = tried.world.set_state(tried.sides[0], &bad[frame % bad.len()]);
        let named = answer.is_err_and(|error| error.to_string().contains("a/part"));
        refused += usize::from(named && tried.world.report() == before);
        different += usize::from(roll(&mut clean, frame)? != roll(&mut tried, frame)?);
    }
    let mut fresh = pong_engine::WorldBuilder::new(pong_engine::Config::default());
    let text = model(&spring(1e5), "Point(name: \"x\", position: (0,0,0))");
    let parsed = pong_model::parse(&text, "extreme.ron", None, &Extensions::new());
    let id = fresh.add_model(std::sync::Arc::new(parsed.map_err(|errors| errors.to_string())?));
    let (a, b) = (fresh.create_object(id, "left")?, fresh.create_object(id, "right")?);
    fresh.pair(a, b)?;
    let (mut fresh, _) = fresh.seal()?;
    let unset = fresh.evaluate().is_err_and(|error| error.to_string().contains("left/part"));
    Ok(vec![
        Row::count("bad states refused by name of 1000", 1000, refused),
        Row::count("good frames that differ", 0, different),
        Row::count("a state that was never set is refused by name", 1, usize::from(unset)),
    ])
}
