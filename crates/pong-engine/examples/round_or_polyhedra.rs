//! Cost of round parts, and accuracy of polyhedra and meshes of N sides in their place.
//!
//!     cargo run --release -p pong-engine --example round_or_polyhedra
//!
//! A ball, a point and a bar move around a pin, and a ball around the wall of a hole, 3 mm deep in contact.
//! Printed are the time of a frame (states in, contacts, wrenches out; the least of the rounds), and the
//! largest error of the depth that follows from the force.

use pong_engine::{Config, InterfaceId, State, World, WorldBuilder};
use pong_model::Extensions;
use pong_testkit::ron::{model, surface};
use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Instant;

const STIFFNESS: f64 = 1e5;
const RADIUS_M: f64 = 0.1;
const HALF_LENGTH_M: f64 = 0.2;
const DEPTH_M: f64 = 3e-3;
const PLACES: usize = 719;
const ROUNDS: usize = 40;

/// A moving body, and the distance of its origin from the axis at this depth.
struct Body {
    name: &'static str,
    text: &'static str,
    away_m: f64,
}

const ON_PIN: [Body; 3] = [
    Body {
        name: "sphere on a pin",
        text: "Sphere(name: \"s\", center: (0,0,0), radius: 0.02)",
        away_m: RADIUS_M + 0.02 - DEPTH_M,
    },
    Body {
        name: "point on a pin",
        text: "Point(name: \"p\", position: (0,0,0))",
        away_m: RADIUS_M - DEPTH_M,
    },
    Body {
        name: "line segment along a pin",
        text: "LineSegment(name: \"l\", ends: ((0,0,-0.05),(0,0,0.05)))",
        away_m: RADIUS_M - DEPTH_M,
    },
];
const IN_HOLE: Body = Body {
    name: "sphere in a hole",
    text: "Sphere(name: \"s\", center: (0,0,0), radius: 0.02)",
    away_m: RADIUS_M - 0.02 + DEPTH_M,
};

fn main() {
    let ends = format!("ends: ((0,0,-{HALF_LENGTH_M}),(0,0,{HALF_LENGTH_M}))");
    let pin = format!("Cylinder(name: \"c\", {ends}, radius: {RADIUS_M})");
    let hole = format!("Bore(name: \"b\", {ends}, radii: ({RADIUS_M}, {RADIUS_M}))");
    println!("| {:24} | {:28} | ns a frame | off by at most, mm |", "touches", "is made of");
    println!("|{:-<26}|{:-<30}|------------|--------------------|", "", "");
    for body in &ON_PIN {
        row(body, "a Cylinder", &pin);
        for sides in [16, 32, 64] {
            row(body, &format!("a Polyhedron of {sides} sides"), &prism(sides));
        }
    }
    row(&IN_HOLE, "a Bore", &hole);
    for sides in [16, 32, 64] {
        row(&IN_HOLE, &format!("a TriangleMesh of {sides} sides"), &wall(sides));
    }
}

fn row(body: &Body, made_of: &str, part: &str) {
    let steel = surface(2.0 * STIFFNESS, "friction: None");
    let texts = [model("a", &steel, body.text), model("b", &steel, part)];
    let (mut world, moving) = paired(&texts);
    let states: Vec<State> = (0..PLACES)
        .map(|i| {
            let turn = TAU * (i as f64 + 0.37) / PLACES as f64;
            let position = [body.away_m * turn.cos(), body.away_m * turn.sin(), 0.013];
            State { position, ..State::identity() }
        })
        .collect();
    let off_m = states.iter().map(|state| {
        let [x, y, z] = force(&mut world, moving, state);
        ((x * x + y * y + z * z).sqrt() / STIFFNESS - DEPTH_M).abs()
    });
    let worst_m = off_m.fold(0.0, f64::max);
    let mut least_ns = f64::INFINITY;
    for _ in 0..ROUNDS {
        let started = Instant::now();
        states.iter().for_each(|state| _ = std::hint::black_box(force(&mut world, moving, state)));
        least_ns = least_ns.min(started.elapsed().as_nanos() as f64 / PLACES as f64);
    }
    println!("| {:24} | {made_of:28} | {least_ns:10.0} | {:18.3} |", body.name, 1e3 * worst_m);
}

/// A world of two Objects, with the root of the first.
fn paired(texts: &[String; 2]) -> (World, InterfaceId) {
    let mut builder = WorldBuilder::new(Config::default());
    let objects = ["a", "b"].map(|name| {
        let text = &texts[usize::from(name == "b")];
        let model = pong_model::parse(text, name, None, &Extensions::new()).expect("a model");
        let model = builder.add_model(Arc::new(model));
        builder.create_object(model, name).expect("a name of its own")
    });
    builder.pair(objects[0], objects[1]).expect("two Objects");
    let [moving, still] = objects.map(|object| builder.scene().interface(object, "").expect("a root"));
    let (mut world, _) = builder.seal().unwrap_or_else(|error| panic!("{error}"));
    world.set_states(&[(still, State::identity())]).expect("a state");
    (world, moving)
}

/// Force on the first body, N, in the common frame; nothing is committed.
fn force(world: &mut World, body: InterfaceId, state: &State) -> [f64; 3] {
    world.set_states(&[(body, *state)]).expect("a state");
    world.evaluate().expect("a sealed world");
    world.wrench_common(body).expect("a body").force.into()
}

/// Corners of two regular polygons, at the ends of the part.
fn corners(sides: usize) -> String {
    let corner = |i: usize| {
        let turn = TAU * (i % sides) as f64 / sides as f64;
        let z = if i < sides { -HALF_LENGTH_M } else { HALF_LENGTH_M };
        format!("({:?},{:?},{z:?})", RADIUS_M * turn.cos(), RADIUS_M * turn.sin())
    };
    (0..2 * sides).map(corner).collect::<Vec<_>>().join(",")
}

fn prism(sides: usize) -> String {
    let list = |indices: Vec<usize>| format!("{indices:?}");
    let mut faces = vec![list((0..sides).rev().collect()), list((sides..2 * sides).collect())];
    faces.extend((0..sides).map(|i| {
        let j = (i + 1) % sides;
        list(vec![i, j, sides + j, sides + i])
    }));
    format!("Polyhedron(name: \"p\", vertices: [{}], faces: [{}])", corners(sides), faces.join(","))
}

/// Faces that look towards the axis.
fn wall(sides: usize) -> String {
    let triangles = (0..sides).map(|i| {
        let j = (i + 1) % sides;
        format!("({i},{},{j}),({i},{},{})", sides + j, sides + i, sides + j)
    });
    let triangles = triangles.collect::<Vec<_>>().join(",");
    format!("TriangleMesh(name: \"m\", vertices: [{}], triangles: [{triangles}])", corners(sides))
}
