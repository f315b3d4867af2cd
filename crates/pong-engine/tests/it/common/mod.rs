//! Small scenes for the tests, written as an author would write them.

pub mod drop;
pub mod mesh;
pub mod own_kinds;
pub mod scenes;
pub mod stage;

use pong_engine::{Config, InterfaceId, ModelId, ObjectId, PairId, State, World, WorldBuilder};
use pong_geometry::{Pose, Quat, Vec3, Wrench};
use pong_model::Extensions;
use pong_testkit::Random;
pub use pong_testkit::ron::{
    box_polyhedron, model, place_of, plate_mesh, shell_mesh, surface, triangle_mesh,
};
use std::sync::Arc;

/// Two Objects, paired and sealed.
pub struct Rig {
    pub world: World,
    pub models: [ModelId; 2],
    pub objects: [ObjectId; 2],
    pub interfaces: [InterfaceId; 2],
    pub pair: PairId,
}

pub fn load(builder: &mut WorldBuilder, text: &str) -> ModelId {
    let model = pong_model::parse(text, "test.ron", None, &Extensions::new());
    builder.add_model(Arc::new(model.unwrap_or_else(|errors| panic!("{errors}\n{text}"))))
}

/// A wrench beside the central difference of the energy.
pub struct Derivative {
    /// Size of the force, N.
    pub force: f64,
    /// Energy, J.
    pub stored: f64,
    /// True where another place begins to carry: the derivative has a kink.
    pub is_kink: bool,
    /// Power and derivative together over the force, which is nothing for −∂U/∂x.
    pub off: f64,
}

impl Rig {
    /// Places A at a pose, without history: the wrench on A, and the energy stored.
    pub fn set_at(&mut self, place: Vec3, orientation: Quat) -> (Wrench, f64) {
        let object = self.objects[0];
        self.world.clear_contact_history(object).unwrap();
        self.place_a(place, orientation);
        self.world.evaluate().unwrap();
        let stored = self.world.contacts().iter().map(|contact| contact.stored).sum();
        (self.wrench(0), stored)
    }

    /// Compares the wrench on A at a pose with the derivative of the energy along a twist.
    pub fn derivative(&mut self, (place, turn): (Vec3, Quat), [velocity, rate]: [Vec3; 2]) -> Derivative {
        const STEP: f64 = 1e-6;
        let mut at =
            |time: f64| self.set_at(place + velocity * time, Quat::from_scaled_axis(rate * time) * turn);
        let ((_, before), (_, after), (wrench, stored)) = (at(-STEP), at(STEP), at(0.0));
        let force = wrench.force.norm();
        let halves = [(after - stored) / STEP, (stored - before) / STEP];
        let power = wrench.force.dot(&velocity) + wrench.moment.dot(&rate);
        let off = (power + 0.5 * (halves[0] + halves[1])).abs() / force;
        Derivative { force, stored, is_kink: (halves[0] - halves[1]).abs() > 1e-3 * force, off }
    }

    pub fn new(a: &str, b: &str) -> Self {
        Self::with_config(Config { ledger: true, ..Config::default() }, a, b)
    }

    pub fn with_config(config: Config, a: &str, b: &str) -> Self {
        let mut builder = WorldBuilder::new(config);
        let models = [a, b].map(|text| load(&mut builder, text));
        let objects =
            [builder.create_object(models[0], "a").unwrap(), builder.create_object(models[1], "b").unwrap()];
        let pair = builder.pair(objects[0], objects[1]).unwrap();
        let interfaces = objects.map(|object| builder.scene().interface(object, "").unwrap());
        let (world, _) = builder.seal().unwrap();
        Self { world, models, objects, interfaces, pair }
    }

    /// Sets both states.
    pub fn place(&mut self, states: [State; 2]) {
        let [a, b] = states;
        self.world.set_states(&[(self.interfaces[0], a), (self.interfaces[1], b)]).unwrap();
    }

    /// Places A; B rests at the common origin.
    pub fn place_a(&mut self, position: Vec3, orientation: Quat) {
        self.place([at(position, orientation), State::identity()]);
    }

    pub fn wrench(&self, side: usize) -> Wrench {
        self.world.wrench_common(self.interfaces[side]).unwrap()
    }
}

/// Every contact as text, bit by bit.
pub fn told(world: &World) -> Vec<String> {
    let number = |x: &f64| format!("{:016x}", x.to_bits());
    let contact = |contact: &pong_engine::Contact| {
        let vectors = [&contact.force, &contact.normal, &contact.point];
        vectors.iter().flat_map(|v| v.iter()).map(number).collect::<Vec<_>>().join(" ")
    };
    world.contacts().iter().map(contact).collect()
}

/// A state at rest.
pub fn at(position: Vec3, q: Quat) -> State {
    State { position: position.into(), orientation: [q.w, q.i, q.j, q.k], ..State::identity() }
}

/// A moving state.
pub fn moving(position: Vec3, q: Quat, linear: Vec3, angular: Vec3) -> State {
    State { linear_velocity: linear.into(), angular_velocity: angular.into(), ..at(position, q) }
}

/// Transforms a state to another common frame, which is at `pose` and drifts at `velocity`.
pub fn seen_from(state: &State, pose: &Pose, velocity: &Vec3) -> State {
    let moved = pose.compose(&state.pose());
    let twist = state.twist();
    moving(
        moved.position,
        moved.orientation,
        pose.orientation * twist.linear + velocity,
        pose.orientation * twist.angular,
    )
}

/// A surface with damping and friction.
pub fn rough(stiffness: f64) -> String {
    surface(stiffness, "normal: Linear(damping: 20.0), friction: Bristle(mu: 0.4)")
}

/// Points in a layer of height `thickness`.
pub fn points(count: usize, thickness: f64, seed: u64) -> String {
    let mut random = Random(seed);
    let one = |index| {
        let p = random.vector(1.0);
        format!("Point(name: \"p{index}\", position: ({:?},{:?},{:?}))", p.x, p.y, 0.5 * thickness * p.z)
    };
    (0..count).map(one).collect::<Vec<_>>().join(",")
}
