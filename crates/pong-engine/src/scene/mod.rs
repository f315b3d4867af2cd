//! Scene: everything that set-up defines. States and surface values may change between frames.

mod names;
mod shared;
mod states;
mod surface_field;
mod surface_motion;
mod surfaces;

use crate::energy::account::WrenchCoupling;
use crate::ids::WorldStamp;
use crate::law::registry::Laws;
use pong_model::{Extensions, Model, MovableGroup};
pub use pong_threads::Settings as WorkerSettings;
pub(crate) use shared::{Shared, refused};
pub use states::State;
pub(crate) use states::States;
use std::sync::Arc;
pub(crate) use surface_field::SurfaceField;
pub use surface_motion::SurfaceMotion;
pub(crate) use surfaces::Surfaces;

/// Settings of a world.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// Maximum number of contacts of a frame. `None` takes an estimate from the scene, at least 256 and at
    /// most 65,536: the contacts of all pairs of movable groups, or, if that is less, those of the 16 pairs of
    /// each group that have the most. If a frame has more contacts, the deepest are kept and a status bit is set.
    pub contact_capacity: Option<usize>,
    /// True to keep the energy ledger (docs/theory.md, 6).
    pub ledger: bool,
    /// Use of wrenches by the host, on which the work in the energy accounts of contacts and pairs depends;
    /// `None` for no accounts. Accounts include the ledger. See
    /// [`World::pair_accounts`](crate::World::pair_accounts).
    pub accounts: Option<WrenchCoupling>,
    /// True for a world in which surfaces may move along themselves ([`SurfaceMotion`]): it remembers their travels.
    /// A motion that is set before the seal makes it true.
    pub moving_surfaces: bool,
    /// Workers that share a frame's work with the calling thread; `None` for the calling thread alone. The
    /// results are bit-identical.
    pub workers: Option<WorkerSettings>,
}

/// An instance of a model.
#[derive(Clone, Debug)]
pub(crate) struct Object {
    pub name: String,
    pub model: usize,
    /// Index of its first movable group in the scene; all of them are consecutive.
    pub first_body: usize,
}

/// One movable group of one Object.
#[derive(Clone, Debug)]
pub(crate) struct GroupInstance {
    pub object: usize,
    /// The Object's model.
    pub model: usize,
    /// Index of the movable group in its model.
    pub body: usize,
}

/// Two Objects that are tested against each other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObjectPair {
    pub a: usize,
    pub b: usize,
}

/// Two groups that never touch, with everything below them; the group of the Object of lower index first.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct GroupFilter {
    pub objects: [usize; 2],
    /// Full paths in their models.
    pub groups: [String; 2],
}

/// The scene of a world: models, Objects, pairs, laws and configuration, with names and ids. A
/// [`WorldBuilder`](crate::WorldBuilder) makes it; nothing changes it once the world is sealed.
#[derive(Clone)]
pub struct Scene {
    /// Stamp in every id of the scene.
    pub(crate) stamp: WorldStamp,
    pub(crate) config: Config,
    pub(crate) extensions: Extensions,
    pub(crate) laws: Laws,
    pub(crate) models: Vec<Arc<Model>>,
    pub(crate) objects: Vec<Object>,
    pub(crate) bodies: Vec<GroupInstance>,
    pub(crate) pairs: Vec<ObjectPair>,
    /// Filters, without duplicates.
    pub(crate) filters: Vec<GroupFilter>,
    /// Memory that the host wants to be left after the seal, per pair of movable groups, bytes.
    pub(crate) room_per_pair: usize,
}

impl Scene {
    /// An empty scene.
    pub(crate) fn empty(config: Config, extensions: Extensions, laws: Laws) -> Self {
        Self {
            stamp: WorldStamp::fresh(),
            config: Config { ledger: config.ledger || config.accounts.is_some(), ..config },
            extensions,
            laws,
            models: Vec::new(),
            objects: Vec::new(),
            bodies: Vec::new(),
            pairs: Vec::new(),
            filters: Vec::new(),
            room_per_pair: 0,
        }
    }

    /// Movable group of the model, for an instance of it.
    #[inline]
    pub(crate) fn body(&self, instance: usize) -> &MovableGroup {
        let instance = &self.bodies[instance];
        &self.models[instance.model].bodies[instance.body]
    }

    /// The model of a movable group.
    #[inline]
    pub(crate) fn model_of_body(&self, instance: usize) -> &Model {
        &self.models[self.bodies[instance].model]
    }

    /// Indices of the model, and of the movable group in the model, for an instance; the same for all
    /// instances of the model.
    pub(crate) fn group_of_model(&self, instance: usize) -> (usize, usize) {
        let instance = &self.bodies[instance];
        (instance.model, instance.body)
    }

    /// `object/path` of a movable group, for messages.
    pub(crate) fn body_name(&self, instance: usize) -> String {
        let object = &self.objects[self.bodies[instance].object];
        format!("{}/{}", object.name, self.body(instance).path)
    }
}

/// Path of a movable group below the root of its model; empty for the root.
pub(crate) fn below_root<'m>(model: &Model, group: &'m MovableGroup) -> &'m str {
    let below =
        group.path.strip_prefix(model.bodies[0].path.as_str()).expect("every path begins with the root's");
    below.strip_prefix('/').unwrap_or(below)
}
