//! Small scenes of two Objects, from model text.

use crate::case::Failure;
use crate::scene::moving;
use pong_engine::{Config, Contact, InterfaceId, State, World, WorldBuilder};
use pong_executive::{Pose, Quat, Vec3, Wrench};
use pong_model::Extensions;
use pong_testkit::ron;
use std::sync::Arc;

/// A world of two Objects.
pub struct Rig {
    pub world: World,
    pub sides: [InterfaceId; 2],
}

impl Rig {
    pub fn new(a: &str, b: &str) -> Result<Self, Failure> {
        Self::with(Config::default(), a, b)
    }

    pub fn with(config: Config, a: &str, b: &str) -> Result<Self, Failure> {
        let mut builder = WorldBuilder::new(config);
        let mut objects = Vec::new();
        for (name, text) in [("a", a), ("b", b)] {
            let model = pong_model::parse(text, "extreme.ron", None, &Extensions::new());
            let model = builder.add_model(Arc::new(model.map_err(|errors| errors.to_string())?));
            objects.push(builder.create_object(model, name)?);
        }
        builder.pair(objects[0], objects[1])?;
        let (mut world, _) = builder.seal()?;
        let sides = [world.scene().interface(objects[0], "")?, world.scene().interface(objects[1], "")?];
        world.set_states(&sides.map(|side| (side, State::identity())))?;
        Ok(Self { world, sides })
    }

    /// Sets the state of A; B is at rest, initially at the origin.
    pub fn put(&mut self, position: Vec3, turn: Quat, velocity: Vec3) -> Result<(), Failure> {
        let pose = Pose { position, orientation: turn };
        let twist = moving(velocity);
        Ok(self.world.set_state(self.sides[0], &State::from_motion(&pose, &twist))?)
    }

    /// Sets the state of A, evaluates and commits.
    pub fn step(&mut self, position: Vec3, turn: Quat, velocity: Vec3) -> Result<Wrench, Failure> {
        self.put(position, turn, velocity)?;
        self.world.step()?;
        self.wrench()
    }

    /// Wrench on A, along the common axes.
    pub fn wrench(&self) -> Result<Wrench, Failure> {
        Ok(self.world.wrench_common(self.sides[0])?)
    }

    pub fn contacts(&self) -> Vec<Contact> {
        self.world.contacts()
    }
}

/// A model of one movable group.
pub fn model(surface: &str, primitives: &str) -> String {
    ron::model("part", &format!("\"s\": ({surface})"), primitives)
}

/// A surface without damping and friction.
pub fn spring(stiffness: f64) -> String {
    format!("stiffness: {stiffness:?}, normal: Linear(damping: 0.0)")
}

/// A box about a centre, placed by `carry`.
pub fn block(name: &str, center: Vec3, half: Vec3, carry: impl Fn(Vec3) -> Vec3) -> String {
    ron::carried_box(name, [center, half], "", carry)
}

/// A square sheet of `n` by `n` cells of two triangles, 1 m wide, with its front on the side of `x × y` of
/// `place`.
pub fn sheet(name: &str, rest: &str, n: usize, place: impl Fn(f64, f64) -> Vec3) -> String {
    let coordinate = |i: usize| i as f64 / n as f64 - 0.5;
    let row = |j: usize| (0..=n).map(move |i| (coordinate(i), coordinate(j)));
    let vertices: Vec<Vec3> = (0..=n).flat_map(row).map(|(x, y)| place(x, y)).collect();
    let cell = |j: usize, i: usize| {
        let v = j * (n + 1) + i;
        [[v, v + 1, v + n + 2], [v, v + n + 2, v + n + 1]]
    };
    let triangles: Vec<[usize; 3]> = (0..n).flat_map(|j| (0..n).flat_map(move |i| cell(j, i))).collect();
    ron::triangle_mesh(name, &vertices, &triangles, rest)
}
