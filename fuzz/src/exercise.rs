//! Frames of an accepted model, which must be computable.

use crate::count;
use crate::input::Input;
use pong_engine::{Config, State, WorldBuilder};
use pong_model::Model;
use std::sync::Arc;

/// Models of more elements are skipped, as too slow.
const ELEMENTS_MAX: usize = 3000;
/// Contact capacity of the world, which some inputs should exceed.
const CAPACITY: usize = 64;
/// Marked primitives and a solid.
const PARTNER: &str = r#"(format: "pong-model", version: 1, name: "partner",
    surfaces: {"s": (stiffness: 1e5, normal: Linear(damping: 10.0), friction: Bristle(mu: 0.3))},
    root: (name: "partner", surface: "s", groups: [(name: "marked", primitives: [
        Sphere(name: "ball", center: (0, 0, 0), radius: 0.5),
        Polyhedron(name: "wedge", vertices: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
            faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
        Plane(name: "ground", normal: (0, 0, 1), offset: 0),
        Point(name: "tip", position: (0, 0, 0)),
        LineSegment(name: "bar", ends: ((0, 0, 0), (1, 0, 0))),
    ]), (name: "solid", contact: Solid, primitives: [
        Polyhedron(name: "block", vertices: [(-1, -1, -1.2), (1, -1, -1.2), (0, 1, -1.2), (0, 0, -0.1)],
            faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
    ])]))"#;

/// Seals a world of two Objects of the model and a partner, and runs some frames with states made of the bytes.
///
/// # Panics
/// If a valid frame is refused, or a result is not finite.
pub fn run(model: Model, input: &mut Input<'_>) {
    if elements(&model) > ELEMENTS_MAX {
        return;
    }
    let config = Config { contact_capacity: Some(CAPACITY), ledger: true, ..Config::default() };
    let mut builder = WorldBuilder::new(config);
    let partner =
        pong_model::parse(PARTNER, "partner", None, builder.scene().extensions()).expect("a good model");
    let model = builder.add_model(Arc::new(model));
    let partner = builder.add_model(Arc::new(partner));
    let objects = [("a", model), ("b", model), ("c", partner)]
        .map(|(name, model)| builder.create_object(model, name).expect("set-up"));
    builder.pair(objects[0], objects[1]).expect("set-up");
    builder.pair(objects[0], objects[2]).expect("set-up");
    // Refused for a model of one movable group.
    let _ = builder.pair(objects[0], objects[0]);
    let Ok((mut world, _)) = builder.seal() else { return };
    let interfaces: Vec<_> =
        objects.iter().flat_map(|object| world.scene().interfaces(*object).expect("sealed")).collect();
    for _ in 0..3 {
        for interface in &interfaces {
            world.set_state(*interface, &state(input)).expect("a good state");
        }
        world.step().expect("a frame of good states");
        count::frame();
        for interface in &interfaces {
            let wrench = world.wrench(*interface).expect("a frame was computed");
            let numbers = wrench.force.iter().chain(wrench.moment.iter());
            assert!(numbers.clone().all(|x| x.is_finite()), "wrench {wrench:?}");
        }
        for contact in world.contacts_iter() {
            let numbers = contact.force.iter().chain(contact.point.iter()).chain(contact.normal.iter());
            let alone = [contact.depth, contact.depth_rate, contact.stored, contact.weight];
            assert!(numbers.chain(&alone).all(|x| x.is_finite()), "{contact:?}");
        }
    }
    let mut block = vec![0; world.state_size()];
    world.save_state(&mut block).expect("a block of this size");
    world.restore_state(&block).expect("what was just saved");
}

fn elements(model: &Model) -> usize {
    let of_body = |body: &pong_model::MovableGroup| body.primitives.len() + body.triangles.triangles.len();
    model.bodies.iter().map(of_body).sum()
}

/// A state close to the origin, in any orientation, and slow.
fn state(input: &mut Input<'_>) -> State {
    let mut state = State::identity();
    state.position = [input.small(0.25), input.small(0.25), input.small(0.25)];
    let turn = [1.0, input.small(0.25), input.small(0.25), input.small(0.25)];
    let norm = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
    state.orientation = turn.map(|x| x / norm);
    state.linear_velocity = [input.small(0.1), input.small(0.1), input.small(1.0)];
    state.angular_velocity = [input.small(1.0), input.small(1.0), input.small(1.0)];
    state
}
