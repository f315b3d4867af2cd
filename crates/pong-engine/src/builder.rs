//! Set-up of models, Objects and pairs, until the scene is sealed into a world.

use crate::error::EngineError;
use crate::ids::{InterfaceId, ModelId, ObjectId, PairId};
use crate::law::registry::Laws;
use crate::report::Clock;
use crate::runtime::Runtime;
use crate::scene::{
    Config, GroupFilter, GroupInstance, Object, ObjectPair, Scene, State, States, SurfaceMotion, Surfaces,
};
use crate::seal::{self, SealReport};
use crate::world::World;
use pong_model::{Extensions, Model, Surface};
use std::collections::BTreeSet;
use std::sync::Arc;

/// A world in set-up: it takes models, Objects, pairs and laws, and [`seal`](Self::seal) makes a [`World`] of
/// them, which computes frames. The builder has no methods for frames, and the world has none for set-up, so
/// that a call in the wrong phase does not compile.
///
/// A frame before the seal:
///
/// ```compile_fail,E0599
/// use pong_engine::{Config, WorldBuilder};
///
/// let mut builder = WorldBuilder::new(Config::default());
/// builder.evaluate();
/// ```
///
/// A pair after it:
///
/// ```compile_fail,E0599
/// # use pong_engine::{Config, EngineError, ObjectId, WorldBuilder};
/// # fn late(a: ObjectId, b: ObjectId) -> Result<(), EngineError> {
/// let (mut world, _) = WorldBuilder::new(Config::default()).seal()?;
/// world.pair(a, b);
/// # Ok(())
/// # }
/// ```
///
/// The right order:
///
/// ```
/// # use pong_engine::{Config, EngineError, State, WorldBuilder};
/// # use std::sync::Arc;
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let text = r#"(format: "pong-model", version: 1, name: "ball", surfaces: {"steel": (stiffness: 1e6)},
///     root: (name: "ball", surface: "steel", primitives: [Sphere(name: "s", center: (0, 0, 0), radius: 0.1)]))"#;
/// let mut builder = WorldBuilder::new(Config::default());
/// let model = pong_model::parse(text, "ball.ron", None, builder.scene().extensions())?;
/// let model = builder.add_model(Arc::new(model));
/// let (a, b) = (builder.create_object(model, "a")?, builder.create_object(model, "b")?);
/// builder.pair(a, b)?;
/// let (mut world, report) = builder.seal()?;
/// assert_eq!(report.group_pairs, 1);
/// for (object, x) in [(a, 0.0), (b, 1.0)] {
///     let interface = world.scene().interface(object, "")?;
///     world.set_state(interface, &State { position: [x, 0.0, 0.0], ..State::identity() })?;
/// }
/// world.step()?;
/// assert_eq!(world.contact_count(), 0);
/// # Ok(())
/// # }
/// ```
pub struct WorldBuilder {
    scene: Scene,
    surfaces: Surfaces,
    states: States,
    /// Objects of every pair, the lower index first.
    paired: BTreeSet<(usize, usize)>,
    clock: Clock,
}

impl WorldBuilder {
    /// An empty world.
    pub fn new(config: Config) -> Self {
        Self::with_extensions(config, Extensions::new(), Laws::default())
    }

    /// An empty world with the host's own kinds of primitives and bounding volumes, and laws.
    pub fn with_extensions(config: Config, extensions: Extensions, laws: Laws) -> Self {
        Self {
            scene: Scene::empty(config, extensions, laws),
            surfaces: Surfaces::default(),
            states: States::default(),
            paired: BTreeSet::new(),
            clock: Clock::default(),
        }
    }

    /// A world in set-up that starts as a copy of a sealed one, with its current states, pairs and surface
    /// values: add new Objects, seal, and continue the other world's run ([`World::continue_from`]). Models
    /// are shared, not loaded again. The other world may run on meanwhile.
    ///
    /// Ids of the sealed world are valid in this one. Ids of additions are valid in this world only, and must
    /// not be used in another extension of the same world.
    pub fn extending(world: &World) -> Self {
        let (scene, surfaces, states, clock) = world.set_up_again();
        let paired = scene.pairs.iter().map(|pair| (pair.a.min(pair.b), pair.a.max(pair.b))).collect();
        Self { scene, surfaces, states, paired, clock }
    }

    /// Scene as set up so far, with names and ids.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Lets models loaded with these [`extensions`](Scene::extensions) read meshes from this folder and below
    /// it. By default, files outside the model's own folder are refused, also through a link.
    pub fn allow_files_below(&mut self, folder: impl Into<std::path::PathBuf>) {
        self.scene.extensions.allow_files_below(folder);
    }

    /// Registered force laws, to add more.
    pub fn laws_mut(&mut self) -> &mut Laws {
        &mut self.scene.laws
    }

    /// Adds a model.
    pub fn add_model(&mut self, model: Arc<Model>) -> ModelId {
        self.surfaces.add(&model);
        self.scene.models.push(model);
        ModelId::new(self.scene.stamp, self.scene.models.len() - 1)
    }

    /// Creates an Object from a model. Objects of one model are independent.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a model of another world, [`EngineError::BadValue`] for a name that is
    /// empty or contains `/`, [`EngineError::Duplicate`] for a name that another Object has.
    pub fn create_object(&mut self, model: ModelId, name: &str) -> Result<ObjectId, EngineError> {
        let model = self.scene.model_index(model)?;
        if name.is_empty() || name.contains('/') {
            let cause = "a name must not be empty nor hold `/`, which separates an object from its groups";
            return Err(EngineError::BadValue { what: format!("object `{name}`"), cause: cause.to_owned() });
        }
        let scene = &mut self.scene;
        if scene.objects.iter().any(|object| object.name == name) {
            return Err(EngineError::Duplicate { what: format!("object `{name}`") });
        }
        let object = scene.objects.len();
        let first_body = scene.bodies.len();
        scene.objects.push(Object { name: name.to_owned(), model, first_body });
        let bodies = scene.models[model].bodies.len();
        scene.bodies.extend((0..bodies).map(|body| GroupInstance { object, model, body }));
        self.states.resize(first_body + bodies);
        Ok(ObjectId::new(scene.stamp, object))
    }

    /// Declares that two Objects may touch. If an Object is paired with itself, its movable groups are tested
    /// against each other.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Object of another world, [`EngineError::Duplicate`] for a pair that
    /// exists already, [`EngineError::BadValue`] for an Object of one movable group that is paired with
    /// itself.
    pub fn pair(&mut self, a: ObjectId, b: ObjectId) -> Result<PairId, EngineError> {
        let scene = &mut self.scene;
        let (a, b) = (scene.object_index(a)?, scene.object_index(b)?);
        let names = || format!("pair (`{}`, `{}`)", scene.objects[a].name, scene.objects[b].name);
        let objects = (a.min(b), a.max(b));
        if self.paired.contains(&objects) {
            return Err(EngineError::Duplicate { what: names() });
        }
        if a == b && scene.models[scene.objects[a].model].bodies.len() < 2 {
            let cause = "an Object paired with itself needs two movable groups; mark one as movable or leave the \
                         pair out";
            return Err(EngineError::BadValue { what: names(), cause: cause.to_owned() });
        }
        self.paired.insert(objects);
        scene.pairs.push(ObjectPair { a, b });
        self.states.enabled.push(true);
        Ok(PairId::new(scene.stamp, scene.pairs.len() - 1))
    }

    /// Keeps two groups apart, with everything below them: nothing of one ever touches anything of the other,
    /// at no cost in a frame. The groups may be movable or not, and belong to two Objects or to one. Names
    /// are as in [`Scene::group_path`](Scene::group_path). The Objects may be paired before or later.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Object of another world, [`EngineError::UnknownName`] for a name
    /// that leads to no group, [`EngineError::Duplicate`] for a filter that exists already,
    /// [`EngineError::BadValue`] for two parts of one rigid body, which never touch, and for too many filters
    /// between two Objects.
    pub fn filter(
        &mut self,
        a: ObjectId,
        group_a: &str,
        b: ObjectId,
        group_b: &str,
    ) -> Result<(), EngineError> {
        /// Maximum filters between two Objects.
        const MOST: usize = 1024;
        let scene = &mut self.scene;
        let side = |object, name| -> Result<_, EngineError> {
            Ok((scene.object_index(object)?, scene.group_path(object, name)?.to_owned()))
        };
        let mut sides = [side(a, group_a)?, side(b, group_b)?];
        sides.sort_unstable();
        let [(a, group_a), (b, group_b)] = sides;
        let what = || {
            format!(
                "filter of `{}/{group_a}` and `{}/{group_b}`",
                scene.objects[a].name, scene.objects[b].name
            )
        };
        let refused = |cause: &str| Err(EngineError::BadValue { what: what(), cause: cause.to_owned() });
        let model = &scene.models[scene.objects[a].model];
        if a == b && model.is_within_one_body([&group_a, &group_b]) {
            return refused("both are parts of one rigid body, which never touch; leave it out");
        }
        if scene.filters.iter().filter(|filter| filter.objects == [a, b]).count() >= MOST {
            return refused(
                "there are 1,024 between these two Objects already; filter a group that holds several",
            );
        }
        if scene
            .filters
            .iter()
            .any(|filter| filter.objects == [a, b] && filter.groups == [&*group_a, &*group_b])
        {
            return Err(EngineError::Duplicate { what: what() });
        }
        scene.filters.push(GroupFilter { objects: [a, b], groups: [group_a, group_b] });
        Ok(())
    }

    /// Sets whether a pair is on at first. See [`World::set_pair_enabled`].
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a pair of another world.
    pub fn set_pair_enabled(&mut self, pair: PairId, enabled: bool) -> Result<(), EngineError> {
        let pair = self.scene.pair_index(pair)?;
        self.states.enabled[pair] = enabled;
        Ok(())
    }

    /// Replaces the values of a model's surface (found by its name), for all its Objects. Laws cannot change.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a model of another world, [`EngineError::UnknownName`] if the model has
    /// no surface of this name, [`EngineError::BadValue`] for another law or a value that no surface may
    /// have.
    pub fn set_surface(&mut self, model: ModelId, surface: &Surface) -> Result<(), EngineError> {
        self.surfaces.replace(self.scene.model_index(model)?, surface)?;
        Ok(())
    }

    /// Surface of a model with its current values.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for a model of another world, [`EngineError::UnknownName`] if it has no
    /// such surface.
    pub fn surface(&self, model: ModelId, name: &str) -> Result<&Surface, EngineError> {
        self.surfaces.named(self.scene.model_index(model)?, name)
    }

    /// Sets initial states; they may also be set after the seal ([`World::set_states`]).
    ///
    /// # Errors
    /// As [`World::set_states`].
    pub fn set_states(&mut self, states: &[(InterfaceId, State)]) -> Result<(), EngineError> {
        self.states.set(&self.scene, states)?;
        Ok(())
    }

    /// Sets initial motions of surfaces along themselves, and so
    /// [`Config::moving_surfaces`]; they may also be set after the seal ([`World::set_surface_motions`]).
    ///
    /// # Errors
    /// As [`World::set_surface_motions`].
    pub fn set_surface_motions(
        &mut self,
        motions: &[(InterfaceId, SurfaceMotion)],
    ) -> Result<(), EngineError> {
        let before = self.scene.config.moving_surfaces;
        self.scene.config.moving_surfaces |= !motions.is_empty();
        let set = self.states.set_surfaces(&self.scene, motions);
        if set.is_err() {
            self.scene.config.moving_surfaces = before;
        }
        set.map(|_| ())
    }

    /// Motion of the surface of a movable group along itself, as it was set last; at rest if never set.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world.
    pub fn surface_motion(&self, interface: InterfaceId) -> Result<&SurfaceMotion, EngineError> {
        self.states.surface_of(&self.scene, interface)
    }

    /// State last set for a movable group, as it was set; `None` if never set.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world.
    pub fn state_as_set(&self, interface: InterfaceId) -> Result<Option<&State>, EngineError> {
        self.states.of(&self.scene, interface)
    }

    /// Makes the seal check that this much memory (bytes) is left for each pair of movable groups. For a host
    /// that examines every pair right after the seal, as `pong_advise::step_report` does.
    pub fn leave_room_per_pair(&mut self, bytes: usize) {
        self.scene.room_per_pair = bytes;
    }

    /// Gives the world a clock, in ns, to time its workers and the stages of its frames
    /// ([`World::stage_times`]). Without one it never reads a clock.
    pub fn set_clock(&mut self, now_ns: fn() -> u64) {
        self.clock = Clock(Some(now_ns));
    }

    /// Ends set-up: checks that everything that may meet can be tested and combined, allocates all memory of
    /// the frames, and starts the workers. Frames neither allocate nor free memory.
    ///
    /// # Errors
    /// A [`SealError`], which holds the unchanged builder and the reason: [`EngineError::Seal`] with every
    /// fault of the scene, [`EngineError::OutOfMemory`], or [`EngineError::Workers`].
    #[expect(clippy::result_large_err, reason = "a refusal for want of memory must not ask for a box")]
    pub fn seal(mut self) -> Result<(World, SealReport), SealError> {
        if let Err(error) = seal::part_groups(&mut self.scene) {
            return Err(SealError { error, builder: self });
        }
        let (sealed, tables, mut report) = match seal::seal(&self.scene, &self.surfaces.of_models) {
            Ok(made) => made,
            Err(error) => return Err(SealError { error, builder: self }),
        };
        let scene = Arc::new(self.scene);
        match Runtime::start(&scene, Arc::new(sealed), Arc::new(tables), self.clock) {
            Ok(runtime) => {
                report.workers = runtime.worker_starts().to_vec();
                report.state_size = runtime.state_size();
                Ok((World::new(scene, self.surfaces, self.states, runtime), report))
            }
            Err(error) => {
                // A worker that has not run yet may still hold the scene; then the builder gets a copy.
                let builder = Self { scene: Arc::unwrap_or_clone(scene), ..self };
                Err(SealError { error, builder })
            }
        }
    }
}

/// Failure of a seal, with the unchanged builder, to be corrected and sealed again.
#[derive(thiserror::Error)]
#[error("{error}")]
pub struct SealError {
    error: EngineError,
    builder: WorldBuilder,
}

impl SealError {
    /// The reason.
    pub fn error(&self) -> &EngineError {
        &self.error
    }

    /// The unchanged builder, and the reason.
    pub fn into_parts(self) -> (WorldBuilder, EngineError) {
        (self.builder, self.error)
    }
}

impl std::fmt::Debug for SealError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.error.fmt(f)
    }
}

impl From<SealError> for EngineError {
    fn from(refused: SealError) -> Self {
        refused.error
    }
}
