//! A scene in the engine: models loaded, frames evaluated and committed, answers kept.

use crate::scene::{Scene, Shape};
use crate::text;
use pong_engine::{
    Config, InterfaceId, ObjectId, State, StatusBits, SurfaceMotion, WorkerSettings, World, WorldBuilder,
};
use pong_geometry::{Vec3, Wrench};
use pong_model::{Extensions, Fnv};
use std::sync::Arc;

/// Answer of one frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Wrenches on both groups about their origins, along the axes of the common frame.
    pub wrenches: [Wrench; 2],
    /// Largest force of a contact, N.
    pub largest: f64,
    /// Contacts, deepest first; for messages, not for comparison.
    pub contacts: Vec<Touch>,
    /// Hash of every number of the frame, bit by bit.
    pub bits: u64,
}

/// Summary of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Depth, m.
    pub depth: f64,
    /// Weight.
    pub weight: f64,
    /// Normal force, N.
    pub normal_force: f64,
    /// Friction force on A, N, in the common frame.
    pub friction: Vec3,
    /// Unit normal from B to A, in the common frame.
    pub normal: Vec3,
    /// Point of action, m, in the common frame.
    pub point: Vec3,
    /// Indices of the primitives of A and B, and of the element of B.
    pub of: [u32; 3],
    /// Feature number of B.
    pub feature: u32,
    /// End of a segment.
    pub end: u32,
    /// True if friction sticks.
    pub sticks: bool,
}

/// A sealed world of a scene.
pub struct Stage {
    /// The world.
    pub world: World,
    objects: [ObjectId; 2],
    /// The movable groups of both bodies.
    pub groups: [InterfaceId; 2],
    /// Motions of the surfaces of both groups, frame by frame; empty if none moves.
    motions: Vec<[SurfaceMotion; 2]>,
}

/// Reason why a scene cannot be played, in the engine's words.
pub type Refusal = String;

impl Stage {
    /// Loads the models and seals the world.
    ///
    /// # Errors
    ///
    /// A model that the engine refuses; the text is the engine's message.
    pub fn set_up(scene: &Scene, workers: usize) -> Result<Self, Refusal> {
        let settings = WorkerSettings { workers, oversubscribe: true, ..WorkerSettings::default() };
        let workers = (workers > 0).then_some(settings);
        let contact_capacity = capacity(scene);
        let moving_surfaces = !scene.motions.is_empty();
        let config = Config { workers, contact_capacity, moving_surfaces, ..Config::default() };
        let mut builder = WorldBuilder::new(config);
        let mut add = |body: usize, name: &str| -> Result<ObjectId, Refusal> {
            let text = text::model(&scene.bodies[body], name, name);
            let model = pong_model::parse(&text, &format!("{name}.ron"), None, &Extensions::new());
            let model = model.map_err(|errors| errors.to_string())?;
            let model = builder.add_model(Arc::new(model));
            builder.create_object(model, name).map_err(|error| error.to_string())
        };
        let objects = [add(0, "a")?, add(1, "b")?];
        let [first, second] = if scene.swapped { [objects[1], objects[0]] } else { objects };
        let begin = || {
            builder.pair(first, second)?;
            let (world, _) = builder.seal()?;
            let groups = [world.scene().interface(objects[0], "")?, world.scene().interface(objects[1], "")?];
            Ok((world, groups))
        };
        let (world, groups) = begin().map_err(|error: pong_engine::EngineError| error.to_string())?;
        Ok(Self { world, objects, groups, motions: scene.motions.clone() })
    }

    /// Sets the motions of the surfaces of a frame, where surfaces move.
    ///
    /// # Errors
    ///
    /// Motions that the engine refuses; the text is the engine's message.
    pub fn move_surfaces(&mut self, frame: usize) -> Result<(), Refusal> {
        let Some([a, b]) = self.motions.get(frame) else { return Ok(()) };
        let motions = [(self.groups[0], *a), (self.groups[1], *b)];
        self.world.set_surface_motions(&motions).map_err(|error| error.to_string())
    }

    /// Sets the states of a frame and evaluates them.
    ///
    /// # Errors
    ///
    /// States that the engine refuses, or more contacts than there is room for.
    pub fn evaluate(&mut self, states: &[State; 2]) -> Result<Answer, Refusal> {
        let [a, b] = [(self.groups[0], states[0]), (self.groups[1], states[1])];
        let report = self.world.set_states(&[a, b]).and_then(|()| self.world.evaluate());
        let report = report.map_err(|error| error.to_string())?;
        if report.status.contains(StatusBits::CONTACT_LIMIT) {
            return Err("more contacts than the capacity".to_owned());
        }
        self.answer().map_err(|error| error.to_string())
    }

    /// Evaluates and commits a frame.
    ///
    /// # Errors
    ///
    /// Errors of [`evaluate`](Self::evaluate) and [`commit`](Self::commit).
    pub fn step(&mut self, states: &[State; 2]) -> Result<Answer, Refusal> {
        let answer = self.evaluate(states)?;
        self.commit()?;
        Ok(answer)
    }

    /// Commits the states set.
    ///
    /// # Errors
    ///
    /// No states are evaluated; the text is the engine's message.
    pub fn commit(&mut self) -> Result<(), Refusal> {
        self.world.commit().map_err(|error| error.to_string())
    }

    /// Plays a history from the beginning, without memory of an earlier one.
    ///
    /// # Errors
    ///
    /// The error of [`step`](Self::step) for the first refused frame.
    pub fn play(&mut self, frames: &[[State; 2]]) -> Result<Vec<Answer>, Refusal> {
        self.forget()?;
        let mut step = |(frame, states)| {
            self.move_surfaces(frame)?;
            self.step(states)
        };
        frames.iter().enumerate().map(&mut step).collect()
    }

    /// Clears all contact state.
    ///
    /// # Errors
    ///
    /// The world is not sealed; the text is the engine's message.
    pub fn forget(&mut self) -> Result<(), Refusal> {
        self.world.clear_contact_history(self.objects[0]).map_err(|error| error.to_string())
    }

    fn answer(&self) -> Result<Answer, pong_engine::EngineError> {
        let [a, b] = self.groups;
        let wrenches = [self.world.wrench_common(a)?, self.world.wrench_common(b)?];
        let mut bits = Fnv::default();
        for wrench in [self.world.wrench(a)?, self.world.wrench(b)?] {
            bits.numbers(wrench.force.iter().chain(&wrench.moment).copied());
        }
        let (mut largest, mut contacts) = (0.0_f64, Vec::new());
        for contact in self.world.contacts_iter() {
            largest = largest.max(contact.force.norm());
            for vector in [&contact.point, &contact.normal, &contact.force, &contact.slip_velocity] {
                bits.numbers(vector.iter().copied());
            }
            for number in [contact.depth, contact.depth_rate, contact.weight, contact.stored] {
                bits.number(number);
            }
            bits.word(u64::from(contact.end) << 1 | u64::from(contact.sticks));
            contacts.push(Touch {
                depth: contact.depth,
                weight: contact.weight,
                normal_force: contact.normal_force,
                friction: contact.friction_force,
                normal: contact.normal,
                point: contact.point,
                of: [contact.a.primitive, contact.b.primitive, contact.b.element],
                feature: contact.feature.0,
                end: contact.end,
                sticks: contact.sticks,
            });
        }
        contacts.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        Ok(Answer { wrenches, largest, contacts, bits: bits.value() })
    }
}

/// Contact capacity of a small scene, which is faster to set up; `None` for the engine's own estimate.
fn capacity(scene: &Scene) -> Option<usize> {
    if scene.is_of_solids() {
        return None;
    }
    let elements = |shape: &Shape| match shape {
        Shape::Mesh(mesh) => mesh.triangles.len() * (1 + usize::from(mesh.two_sided)),
        // Two spheres of a capsule and its edges on each triangle; four points of a cylinder's end circles.
        Shape::Round(_) => 16,
        _ => 2,
    };
    let [a, b] = [0, 1].map(|body| scene.bodies[body].shapes.iter().map(elements).sum::<usize>());
    let is_round =
        |body: usize| scene.bodies[body].shapes.iter().any(|shape| matches!(shape, Shape::Round(_)));
    // A large capsule on many small triangles touches more of them than the engine expects of one body.
    (a * b <= 256 || is_round(0)).then_some((a * b + 8).min(65_536))
}
