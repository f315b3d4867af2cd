//! The world: set-up, seal, frames. The only owner of engine memory.

use crate::contact::{Contact, FrameReport, Ledger};
use crate::error::EngineError;
use crate::frame::{self, Frame};
use crate::ids::{InterfaceId, ModelId, ObjectId, PairId, WorldStamp};
use crate::registry::Laws;
use crate::scene::{BodyInstance, Config, Object, ObjectPair, Scene, State, check_state};
use crate::sealed::{self, SealReport, Sealed};
use crate::state::{ContactMemory, block_len, read_block, write_block};
use pong_geometry::extension::Extensions;
use pong_geometry::{Pose, Twist, Wrench};
use pong_model::{Model, Surface};
use std::sync::Arc;

/// The stiffest single contact between two movable groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StiffestContact {
    /// The two movable groups.
    pub interfaces: [InterfaceId; 2],
    /// Stiffness k of a whole contact, N/m.
    pub stiffness: f64,
    /// Its damping c, N·s/m; 0 for laws whose damping follows the load.
    pub damping: f64,
}

/// A contact world: Objects, pairs and everything remembered between frames.
///
/// Phases: set up (models, objects, pairs) → [`seal`](Self::seal) → frames. Calls in the wrong phase are refused
/// and change nothing.
pub struct World {
    stamp: WorldStamp,
    scene: Scene,
    sealed: Option<Sealed>,
    memory: ContactMemory,
    frame: Frame,
    /// Whether `frame` belongs to the states presently set.
    evaluated: bool,
}

impl World {
    /// An empty world.
    pub fn new(config: Config) -> Self {
        Self::with_extensions(config, Extensions::new(), Laws::default())
    }

    /// An empty world that knows the user's own kinds of primitives and bounding volumes, and laws.
    pub fn with_extensions(config: Config, extensions: Extensions, laws: Laws) -> Self {
        let scene = Scene {
            config,
            extensions,
            laws,
            models: Vec::new(),
            objects: Vec::new(),
            bodies: Vec::new(),
            pairs: Vec::new(),
        };
        Self {
            stamp: WorldStamp::fresh(),
            scene,
            sealed: None,
            memory: ContactMemory::default(),
            frame: Frame::default(),
            evaluated: false,
        }
    }

    /// The user's own kinds that this world knows: load models with them.
    pub fn extensions(&self) -> &Extensions {
        &self.scene.extensions
    }

    /// The registered force laws; more may be added until the world is sealed.
    pub fn laws_mut(&mut self) -> Result<&mut Laws, EngineError> {
        self.must_not_be_sealed("register a law")?;
        Ok(&mut self.scene.laws)
    }

    /// Adds a model.
    pub fn add_model(&mut self, model: Arc<Model>) -> Result<ModelId, EngineError> {
        self.must_not_be_sealed("add a model")?;
        self.scene.models.push(model);
        Ok(ModelId::new(self.stamp, self.scene.models.len() - 1))
    }

    /// Creates an Object from a model. Objects of one model are independent.
    pub fn create_object(&mut self, model: ModelId, name: &str) -> Result<ObjectId, EngineError> {
        self.must_not_be_sealed("create an object")?;
        let model = self.model_index(model)?;
        if name.is_empty() || name.contains('/') {
            let cause = "a name must not be empty nor hold `/`, which separates an object from its groups";
            return Err(EngineError::BadValue { what: format!("object `{name}`"), cause: cause.to_owned() });
        }
        if self.scene.objects.iter().any(|object| object.name == name) {
            return Err(EngineError::Duplicate { what: format!("object `{name}`") });
        }
        let object = self.scene.objects.len();
        let first_body = self.scene.bodies.len();
        self.scene.objects.push(Object { name: name.to_owned(), model, first_body });
        let bodies = self.scene.models[model].bodies.len();
        self.scene.bodies.extend((0..bodies).map(|body| BodyInstance { object, body, state: None }));
        Ok(ObjectId::new(self.stamp, object))
    }

    /// Declares that two Objects may touch. An Object paired with itself has its movable groups tested against
    /// each other.
    pub fn pair(&mut self, a: ObjectId, b: ObjectId) -> Result<PairId, EngineError> {
        self.must_not_be_sealed("pair objects")?;
        let (a, b) = (self.object_index(a)?, self.object_index(b)?);
        let names = format!("pair (`{}`, `{}`)", self.scene.objects[a].name, self.scene.objects[b].name);
        if self.scene.pairs.iter().any(|pair| (pair.a, pair.b) == (a, b) || (pair.a, pair.b) == (b, a)) {
            return Err(EngineError::Duplicate { what: names });
        }
        if a == b && self.scene.models[self.scene.objects[a].model].bodies.len() < 2 {
            let cause = "an Object paired with itself needs two movable groups; mark one as movable or leave the \
                         pair out";
            return Err(EngineError::BadValue { what: names, cause: cause.to_owned() });
        }
        self.scene.pairs.push(ObjectPair { a, b, enabled: true });
        Ok(PairId::new(self.stamp, self.scene.pairs.len() - 1))
    }

    /// The Object of a name.
    pub fn object(&self, name: &str) -> Result<ObjectId, EngineError> {
        match self.scene.objects.iter().position(|object| object.name == name) {
            Some(index) => Ok(ObjectId::new(self.stamp, index)),
            None => Err(EngineError::UnknownName {
                what: "object",
                name: name.to_owned(),
                known: self.scene.objects.iter().map(|object| object.name.clone()).collect(),
            }),
        }
    }

    /// The Interface of a movable group by its path in the model, `root/arm/latch`, or by its bare name where
    /// only one movable group has it. An empty path is the root.
    pub fn interface(&self, object: ObjectId, path: &str) -> Result<InterfaceId, EngineError> {
        let object = &self.scene.objects[self.object_index(object)?];
        let bodies = &self.scene.models[object.model].bodies;
        let by_path = bodies.iter().position(|body| body.path == path);
        let by_name = || {
            let mut named = bodies.iter().enumerate().filter(|(_, body)| body.name == path);
            named.next().filter(|_| named.next().is_none()).map(|(index, _)| index)
        };
        let found = if path.is_empty() { Some(0) } else { by_path.or_else(by_name) };
        match found {
            Some(body) => Ok(InterfaceId::new(self.stamp, object.first_body + body)),
            None => Err(EngineError::UnknownName {
                what: "movable group",
                name: format!("{}/{path}", object.name),
                known: bodies.iter().map(|body| body.path.clone()).collect(),
            }),
        }
    }

    /// All Interfaces of an Object, the root's first.
    pub fn interfaces(&self, object: ObjectId) -> Result<Vec<InterfaceId>, EngineError> {
        let object = &self.scene.objects[self.object_index(object)?];
        let count = self.scene.models[object.model].bodies.len();
        Ok((0..count).map(|body| InterfaceId::new(self.stamp, object.first_body + body)).collect())
    }

    /// Ends set-up: checks that everything that may meet can be tested and combined, and sizes the contact state.
    pub fn seal(&mut self) -> Result<SealReport, EngineError> {
        self.must_not_be_sealed("seal")?;
        let (sealed, report) = sealed::seal(&self.scene)?;
        self.memory = ContactMemory::new(sealed.group_pairs.len(), sealed.custom_stride);
        self.frame = Frame::new(self.scene.bodies.len(), &self.memory);
        self.sealed = Some(sealed);
        Ok(report)
    }

    /// Sets the state of one movable group. See [`set_states`](Self::set_states).
    pub fn set_state(&mut self, interface: InterfaceId, state: &State) -> Result<(), EngineError> {
        self.set_states(&[(interface, *state)])
    }

    /// Sets the states of movable groups: all of them, or, if any is refused, none.
    ///
    /// # Errors
    /// A value that is not finite, or a quaternion whose norm is off by more than 1e-3.
    pub fn set_states(&mut self, states: &[(InterfaceId, State)]) -> Result<(), EngineError> {
        for (interface, state) in states {
            let index = self.interface_index(*interface)?;
            check_state(state)
                .map_err(|cause| EngineError::BadState { interface: self.scene.body_name(index), cause })?;
        }
        for (interface, state) in states {
            let index = self.interface_index(*interface)?;
            let known = &mut self.scene.bodies[index].state;
            // A host that sets the same states again, for a commit, must not pay for a second evaluation.
            if known.as_ref() != Some(state) {
                *known = Some(*state);
                self.evaluated = false;
            }
        }
        Ok(())
    }

    /// Computes wrenches from the states and the committed contact state. Changes nothing that a later evaluate
    /// or commit can see.
    pub fn evaluate(&mut self) -> Result<FrameReport, EngineError> {
        let sealed = self.sealed.as_ref().ok_or(not_sealed("evaluate"))?;
        frame::require_states(&self.scene, sealed)?;
        frame::evaluate(&self.scene, sealed, &self.memory, &mut self.frame);
        self.evaluated = true;
        Ok(self.frame.report)
    }

    /// Whether the last frame belongs to the states presently set: a commit would accept it as it is.
    pub fn is_evaluated(&self) -> bool {
        self.evaluated
    }

    /// Accepts the states presently set, evaluating them first if they are not the ones last evaluated.
    pub fn commit(&mut self) -> Result<(), EngineError> {
        self.must_be_evaluated()?;
        std::mem::swap(&mut self.memory, &mut self.frame.trial);
        self.evaluated = false;
        Ok(())
    }

    /// As [`commit`](Self::commit), for some pairs only: the others keep their last committed state.
    pub fn commit_pairs(&mut self, pairs: &[PairId]) -> Result<(), EngineError> {
        let accepted: Vec<usize> =
            pairs.iter().map(|pair| self.pair_index(*pair)).collect::<Result<_, _>>()?;
        self.must_be_evaluated()?;
        let group_pairs = &self.sealed.as_ref().ok_or(not_sealed("commit"))?.group_pairs;
        self.memory.accept(&self.frame.trial, |index| accepted.contains(&group_pairs[index as usize].pair));
        self.evaluated = false;
        Ok(())
    }

    /// Evaluate and commit, for hosts that call once a frame.
    pub fn step(&mut self) -> Result<FrameReport, EngineError> {
        let report = self.evaluate()?;
        self.commit()?;
        Ok(report)
    }

    /// Wrench on a movable group in the last frame: about the group's origin, expressed in the group's frame.
    pub fn wrench(&self, interface: InterfaceId) -> Result<Wrench, EngineError> {
        Ok(self.frame.wrenches[self.framed_index(interface)?])
    }

    /// As [`wrench`](Self::wrench), expressed along the axes of the common frame.
    pub fn wrench_common(&self, interface: InterfaceId) -> Result<Wrench, EngineError> {
        let index = self.framed_index(interface)?;
        let orientation = self.frame.poses[index].orientation;
        let wrench = self.frame.wrenches[index];
        Ok(Wrench { force: orientation * wrench.force, moment: orientation * wrench.moment })
    }

    /// The contacts of the last frame, in the order of every sum.
    pub fn contacts(&self) -> Vec<Contact> {
        self.contacts_iter().collect()
    }

    /// As [`contacts`](Self::contacts), one by one and without a list of their own.
    pub fn contacts_iter(&self) -> impl Iterator<Item = Contact> + '_ {
        let sealed = self.sealed.iter();
        sealed.flat_map(|sealed| self.frame.list_contacts(&self.scene, sealed, self.stamp))
    }

    /// Number of contacts of the last frame.
    pub fn contact_count(&self) -> usize {
        self.frame.listed()
    }

    /// Counts of the last frame.
    pub fn report(&self) -> FrameReport {
        self.frame.report
    }

    /// Energies at the last commit. Zero unless [`Config::ledger`] is set.
    pub fn ledger(&self) -> Ledger {
        let stored = self.memory.records.iter().map(|record| record.stored).sum();
        Ledger { stored, work: self.memory.work, dissipated: self.memory.dissipated }
    }

    /// Size of the contact state block, bytes; fixed when the world is sealed.
    pub fn state_size(&self) -> Result<usize, EngineError> {
        let sealed = self.sealed.as_ref().ok_or(not_sealed("ask for the size of the contact state"))?;
        Ok(block_len(sealed.group_pairs.len(), sealed.record_capacity, sealed.custom_stride))
    }

    /// Saves the committed contact state into a buffer of [`state_size`](Self::state_size) bytes.
    pub fn save_state(&self, out: &mut [u8]) -> Result<(), EngineError> {
        let sealed = self.sealed.as_ref().ok_or(not_sealed("save the contact state"))?;
        Ok(write_block(&self.memory, sealed.hash, sealed.record_capacity, out)?)
    }

    /// Restores a contact state that a world built by the same calls saved. The states of the movable groups are
    /// the host's and are not part of it.
    pub fn restore_state(&mut self, block: &[u8]) -> Result<(), EngineError> {
        let sealed = self.sealed.as_ref().ok_or(not_sealed("restore the contact state"))?;
        self.memory = read_block(&self.memory, sealed.hash, sealed.record_capacity, block)?;
        self.evaluated = false;
        Ok(())
    }

    /// Drops an Object's contact state: after a teleport or a reset nothing of its past counts.
    pub fn forget(&mut self, object: ObjectId) -> Result<(), EngineError> {
        let object = self.object_index(object)?;
        let sealed = self.sealed.as_ref().ok_or(not_sealed("forget an Object"))?;
        let bodies = &self.scene.bodies;
        self.memory.forget(|index| {
            let pair = &sealed.group_pairs[index as usize];
            bodies[pair.first].object == object || bodies[pair.second].object == object
        });
        self.evaluated = false;
        Ok(())
    }

    /// Switches a pair on or off. A pair that is off has no contacts, and when it is switched on again it has no
    /// past.
    pub fn set_pair_enabled(&mut self, pair: PairId, enabled: bool) -> Result<(), EngineError> {
        let pair = self.pair_index(pair)?;
        if self.scene.pairs[pair].enabled != enabled {
            self.scene.pairs[pair].enabled = enabled;
            self.evaluated = false;
            if let Some(sealed) = &self.sealed {
                self.memory.forget(|index| sealed.group_pairs[index as usize].pair == pair);
            }
        }
        Ok(())
    }

    /// Replaces the values of a surface of a model (found by its name), for all its Objects. Laws may not change.
    pub fn set_surface(&mut self, model: ModelId, surface: &Surface) -> Result<(), EngineError> {
        let index = self.model_index(model)?;
        let mut changed = (*self.scene.models[index]).clone();
        let Some(old) = changed.surfaces.iter_mut().find(|old| old.name == surface.name) else {
            return Err(EngineError::UnknownName {
                what: "surface",
                name: surface.name.clone(),
                known: changed.surfaces.iter().map(|old| old.name.clone()).collect(),
            });
        };
        sealed::check_surface_change(old, surface)?;
        *old = surface.clone();
        let before = std::mem::replace(&mut self.scene.models[index], Arc::new(changed));
        if let Some(sealed) = &mut self.sealed {
            match sealed::surface_tables(&self.scene, &sealed.group_pairs) {
                Ok(tables) => sealed.tables = tables,
                Err(problems) => {
                    self.scene.models[index] = before;
                    return Err(EngineError::Seal { problems });
                }
            }
        }
        self.evaluated = false;
        Ok(())
    }

    /// A surface of a model as it is now.
    pub fn surface(&self, model: ModelId, name: &str) -> Result<&Surface, EngineError> {
        let surfaces = &self.scene.models[self.model_index(model)?].surfaces;
        surfaces.iter().find(|surface| surface.name == name).ok_or_else(|| EngineError::UnknownName {
            what: "surface",
            name: name.to_owned(),
            known: surfaces.iter().map(|surface| surface.name.clone()).collect(),
        })
    }

    /// The model an Object was made from.
    pub fn model_of(&self, object: ObjectId) -> Result<&Arc<Model>, EngineError> {
        Ok(&self.scene.models[self.scene.objects[self.object_index(object)?].model])
    }

    /// Name of an Object.
    pub fn object_name(&self, object: ObjectId) -> Result<&str, EngineError> {
        Ok(&self.scene.objects[self.object_index(object)?].name)
    }

    /// Path of an Interface's movable group in its model.
    pub fn interface_path(&self, interface: InterfaceId) -> Result<&str, EngineError> {
        Ok(&self.scene.body(self.interface_index(interface)?).path)
    }

    /// Path of a primitive, as a contact names it.
    pub fn primitive_path(&self, interface: InterfaceId, primitive: u32) -> Result<&str, EngineError> {
        let body = self.scene.body(self.interface_index(interface)?);
        let info = body.primitives.get(primitive as usize);
        Ok(&info.ok_or(EngineError::UnknownId { what: "primitive" })?.path)
    }

    /// Pose at which the model's author placed a movable group, in the frame of the root group.
    pub fn authored_pose(&self, interface: InterfaceId) -> Result<Pose, EngineError> {
        let body = self.scene.body(self.interface_index(interface)?);
        Ok(body.initial_pose.unwrap_or_else(Pose::identity))
    }

    /// Pose and twist last set for a movable group; `None` if never set.
    pub fn state(&self, interface: InterfaceId) -> Result<Option<(Pose, Twist)>, EngineError> {
        let state = &self.scene.bodies[self.interface_index(interface)?].state;
        Ok(state.as_ref().map(|state| (state.pose(), state.twist())))
    }

    /// The stiffest single contact that each pair of movable groups can have, as far as it does not depend on the
    /// depth (Hertz contacts and registered laws do): what a step must be short enough for.
    pub fn stiffest_contacts(&self) -> Result<Vec<StiffestContact>, EngineError> {
        let sealed = self.sealed.as_ref().ok_or(not_sealed("ask for the stiffest contacts"))?;
        let of_pair = |pair: &sealed::GroupPair| {
            let tables = pair.tables.iter().map(|&table| &sealed.tables[table]);
            let stiffest =
                tables.filter_map(sealed::SurfaceTable::stiffest).max_by(|a, b| a.0.total_cmp(&b.0))?;
            let interfaces = [pair.first, pair.second].map(|body| InterfaceId::new(self.stamp, body));
            Some(StiffestContact { interfaces, stiffness: stiffest.0, damping: stiffest.1 })
        };
        Ok(sealed.group_pairs.iter().filter_map(of_pair).collect())
    }

    /// Hash of the sealed scene: two worlds with equal hashes can exchange contact state.
    pub fn scene_hash(&self) -> Result<u64, EngineError> {
        Ok(self.sealed.as_ref().ok_or(not_sealed("ask for the hash"))?.hash)
    }

    fn must_be_evaluated(&mut self) -> Result<(), EngineError> {
        if !self.evaluated {
            self.evaluate()?;
        }
        Ok(())
    }

    fn must_not_be_sealed(&self, call: &'static str) -> Result<(), EngineError> {
        match self.sealed {
            None => Ok(()),
            Some(_) => Err(EngineError::WrongPhase { call, cure: "do it before the world is sealed" }),
        }
    }

    fn model_index(&self, id: ModelId) -> Result<usize, EngineError> {
        let index = id.index_in(self.stamp).filter(|i| *i < self.scene.models.len());
        index.ok_or(EngineError::UnknownId { what: "model" })
    }

    fn object_index(&self, id: ObjectId) -> Result<usize, EngineError> {
        let index = id.index_in(self.stamp).filter(|i| *i < self.scene.objects.len());
        index.ok_or(EngineError::UnknownId { what: "object" })
    }

    fn pair_index(&self, id: PairId) -> Result<usize, EngineError> {
        let index = id.index_in(self.stamp).filter(|i| *i < self.scene.pairs.len());
        index.ok_or(EngineError::UnknownId { what: "pair" })
    }

    fn interface_index(&self, id: InterfaceId) -> Result<usize, EngineError> {
        let index = id.index_in(self.stamp).filter(|i| *i < self.scene.bodies.len());
        index.ok_or(EngineError::UnknownId { what: "interface" })
    }

    /// The index of an interface, if a frame has been computed.
    fn framed_index(&self, id: InterfaceId) -> Result<usize, EngineError> {
        let index = self.interface_index(id)?;
        if self.frame.computed {
            Ok(index)
        } else {
            Err(EngineError::WrongPhase { call: "get a wrench", cure: "evaluate or step a frame first" })
        }
    }
}

const fn not_sealed(call: &'static str) -> EngineError {
    EngineError::WrongPhase { call, cure: "seal the world first" }
}
