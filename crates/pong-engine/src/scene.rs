//! Everything that set-up decides, and the states that the host sets.

use crate::energy::account::WrenchCoupling;
use crate::law::registry::Laws;
use pong_geometry::extension::Extensions;
use pong_geometry::{Pose, Twist, Vec3};
use pong_model::{Model, MovableGroup};
pub use pong_threads::Settings as WorkerSettings;
use std::sync::Arc;

/// Settings of a world.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// Most contacts of a frame; `None` takes the worst case of the scene, at least 256 and at most
    /// 65,536. When a frame has more,
    /// the deepest are kept and a status bit is set.
    pub contact_capacity: Option<usize>,
    /// Whether energies are kept (docs/theory.md, 6).
    pub ledger: bool,
    /// Whether accounts of contacts and of pairs are kept too, and what the host does with wrenches, which decides what
    /// work they do. Keeps the ledger as well. See [`World::pair_accounts`](crate::World::pair_accounts).
    pub accounts: Option<WrenchCoupling>,
    /// Workers that share a frame's work with the calling thread; `None` for the calling thread alone. The results
    /// are the same bits.
    pub workers: Option<WorkerSettings>,
}

/// An instance of a model.
#[derive(Clone, Debug)]
pub(crate) struct Object {
    pub name: String,
    pub model: usize,
    /// Its movable groups are consecutive bodies from this one on.
    pub first_body: usize,
}

/// One movable group of one Object.
#[derive(Clone, Debug)]
pub(crate) struct GroupInstance {
    pub object: usize,
    /// Index into the model's bodies.
    pub body: usize,
}

/// Two Objects that are tested.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObjectPair {
    pub a: usize,
    pub b: usize,
}

/// What the host sets at any time.
#[derive(Clone, Debug, Default)]
pub(crate) struct States {
    /// One per movable group, if it was set.
    pub bodies: Vec<Option<State>>,
    /// One per pair of Objects: whether it is tested.
    pub enabled: Vec<bool>,
}

/// Everything that set-up decides and that nothing changes once the world is sealed.
pub(crate) struct Scene {
    pub config: Config,
    pub extensions: Extensions,
    pub laws: Laws,
    pub models: Vec<Arc<Model>>,
    pub objects: Vec<Object>,
    pub bodies: Vec<GroupInstance>,
    pub pairs: Vec<ObjectPair>,
    /// Memory that the host wants to find left after the seal, for each pair of movable groups, bytes.
    pub room_per_pair: usize,
}

impl Scene {
    /// The model's body behind a movable group.
    pub fn body(&self, instance: usize) -> &MovableGroup {
        let instance = &self.bodies[instance];
        &self.models[self.objects[instance.object].model].bodies[instance.body]
    }

    /// The model behind a movable group.
    pub fn model_of_body(&self, instance: usize) -> &Model {
        &self.models[self.objects[self.bodies[instance].object].model]
    }

    /// `object/path` of a movable group, for messages.
    pub fn body_name(&self, instance: usize) -> String {
        let object = &self.objects[self.bodies[instance].object];
        format!("{}/{}", object.name, self.body(instance).path)
    }
}

/// How far a quaternion's norm may be from 1.
const NORM_ERROR_MAX: f64 = 1e-3;

/// State of a movable group relative to and expressed in the common frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Position of the group's origin, m.
    pub position: [f64; 3],
    /// Quaternion (w, x, y, z), Hamilton, that rotates group components into common components; normalised here.
    pub orientation: [f64; 4],
    /// Velocity of the group's origin, m/s.
    pub linear_velocity: [f64; 3],
    /// Angular velocity, rad/s.
    pub angular_velocity: [f64; 3],
}

impl State {
    /// Largest component that is accepted: products of any two, with any stiffness, stay finite.
    pub const LARGEST: f64 = pong_model::LARGEST;

    /// At rest at the common origin.
    pub fn identity() -> Self {
        Self {
            position: [0.0; 3],
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
        }
    }

    /// From a pose and a twist.
    pub fn from_motion(pose: &Pose, twist: &Twist) -> Self {
        let q = &pose.orientation;
        Self {
            position: pose.position.into(),
            orientation: [q.w, q.i, q.j, q.k],
            linear_velocity: twist.linear.into(),
            angular_velocity: twist.angular.into(),
        }
    }

    /// The pose, its quaternion normalised.
    pub fn pose(&self) -> Pose {
        Pose::new(Vec3::from(self.position), self.orientation)
    }

    /// The velocities.
    pub fn twist(&self) -> Twist {
        Twist { linear: Vec3::from(self.linear_velocity), angular: Vec3::from(self.angular_velocity) }
    }
}

/// What is wrong with a state, if anything.
pub(crate) fn check_state(state: &State) -> Result<(), String> {
    let named: [(&str, &[f64]); 4] = [
        ("position", &state.position),
        ("orientation", &state.orientation),
        ("linear velocity", &state.linear_velocity),
        ("angular velocity", &state.angular_velocity),
    ];
    for (name, values) in named {
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(format!("{name} holds {value}; give finite numbers"));
        }
        if let Some(value) = values.iter().find(|value| value.abs() > State::LARGEST) {
            return Err(format!(
                "{name} holds {value:e}, beyond what a frame can square; give at most {:e}",
                State::LARGEST
            ));
        }
    }
    let norm = state.orientation.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (norm - 1.0).abs() > NORM_ERROR_MAX {
        return Err(format!("the quaternion has norm {norm}; give a unit quaternion (w, x, y, z)"));
    }
    Ok(())
}
