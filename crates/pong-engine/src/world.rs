//! The world: set-up, seal, frames. The only owner of engine memory.

use crate::contact::{Contact, Ledger};
use crate::energy::account::{EnergyAccount, PairEnergyAccount, WrenchCoupling};
use crate::error::EngineError;
use crate::frame::{FrictionPreload, TunnellingEvent};
use crate::ids::{InterfaceId, ModelId, ObjectId, PairId, WorldStamp};
use crate::inspect::Inspection;
use crate::law::registry::Laws;
use crate::report::{Clock, FrameCounts, FrameReport, MemoryReport, StageTimes, TunnellingReport, WorkTimes};
use crate::running::Running;
use crate::scene::{Config, GroupInstance, Object, ObjectPair, Scene, State, States, check_state};
use crate::seal::{self, SealReport};
use pong_geometry::extension::Extensions;
use pong_geometry::{Pose, Twist, Wrench};
use pong_model::{LARGEST, Model, Surface};
use std::sync::Arc;

/// A contact world: Objects, pairs and everything remembered between frames.
///
/// Phases: set up (models, objects, pairs) → [`seal`](Self::seal) → frames. Calls in the wrong phase are refused
/// and change nothing.
pub struct World {
    stamp: WorldStamp,
    /// Shared with the workers once the world is sealed; until then this is the only one.
    scene: Arc<Scene>,
    /// The surfaces of every model as they are now.
    surfaces: Vec<Vec<Surface>>,
    states: States,
    clock: Clock,
    /// All that exists from seal on.
    running: Option<Running>,
}

impl World {
    /// An empty world.
    pub fn new(config: Config) -> Self {
        Self::with_extensions(config, Extensions::new(), Laws::default())
    }

    /// An empty world that knows the user's own kinds of primitives and bounding volumes, and laws.
    pub fn with_extensions(config: Config, extensions: Extensions, laws: Laws) -> Self {
        let config = Config { ledger: config.ledger || config.accounts.is_some(), ..config };
        let scene = Scene {
            config,
            extensions,
            laws,
            models: Vec::new(),
            objects: Vec::new(),
            bodies: Vec::new(),
            pairs: Vec::new(),
            room_per_pair: 0,
        };
        Self {
            stamp: WorldStamp::fresh(),
            scene: Arc::new(scene),
            surfaces: Vec::new(),
            states: States::default(),
            clock: Clock::default(),
            running: None,
        }
    }

    /// The user's own kinds that this world knows: load models with them.
    pub fn extensions(&self) -> &Extensions {
        &self.scene.extensions
    }

    /// Lets models that are loaded with these [`extensions`](Self::extensions) read the meshes that they name from this
    /// folder and those below it too; without it what lies outside a model's own folder, through a link, is refused.
    pub fn allow_files_below(&mut self, folder: impl Into<std::path::PathBuf>) -> Result<(), EngineError> {
        self.set_up("allow a folder")?.extensions.allow_files_below(folder);
        Ok(())
    }

    /// The registered force laws; more may be added until the world is sealed.
    pub fn laws_mut(&mut self) -> Result<&mut Laws, EngineError> {
        Ok(&mut self.set_up("register a law")?.laws)
    }

    /// Adds a model.
    pub fn add_model(&mut self, model: Arc<Model>) -> Result<ModelId, EngineError> {
        let surfaces = model.surfaces.clone();
        self.set_up("add a model")?.models.push(model);
        self.surfaces.push(surfaces);
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
        let scene = self.set_up("create an object")?;
        let object = scene.objects.len();
        let first_body = scene.bodies.len();
        scene.objects.push(Object { name: name.to_owned(), model, first_body });
        let bodies = scene.models[model].bodies.len();
        scene.bodies.extend((0..bodies).map(|body| GroupInstance { object, body }));
        self.states.bodies.resize(first_body + bodies, None);
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
        self.set_up("pair objects")?.pairs.push(ObjectPair { a, b });
        self.states.enabled.push(true);
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

    /// Has the seal make sure that so much memory (bytes) is left for each pair of movable groups that it lists: for a host
    /// that asks about every pair right after it, as with `pong_advise::step_report`.
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] once the world is sealed.
    pub fn leave_room_per_pair(&mut self, bytes: usize) -> Result<(), EngineError> {
        self.set_up("leave room")?.room_per_pair = bytes;
        Ok(())
    }

    /// Ends set-up: checks that everything that may meet can be tested and combined, sizes all memory of the frames
    /// and takes it, and starts the workers. From here on frames take no memory and give none back.
    pub fn seal(&mut self) -> Result<SealReport, EngineError> {
        self.must_not_be_sealed("seal")?;
        let (sealed, tables, mut report) = seal::seal(&self.scene, &self.surfaces)?;
        let running = Running::start(&self.scene, sealed, tables, self.clock)?;
        report.workers = running.worker_starts().to_vec();
        self.running = Some(running);
        Ok(report)
    }

    /// Gives the world a clock, in ns, with which it times the stages of its frames ([`stage_times`](Self::stage_times))
    /// and its workers; set it before the world is sealed to have the workers timed. Without one it never asks.
    pub fn set_clock(&mut self, now_ns: fn() -> u64) {
        self.clock = Clock(Some(now_ns));
    }

    /// Wakes the workers shortly before a frame: they look for its work until it comes or `at_most` has passed. For
    /// hosts whose frames are further apart than the workers spin. Does nothing without workers.
    pub fn prewake(&mut self, at_most: std::time::Duration) {
        self.running.iter_mut().for_each(|running| running.prewake(at_most));
    }

    /// Lets the workers sleep at once, as in a freeze. The next frame wakes them. Does nothing without workers.
    pub fn quiesce(&mut self) {
        self.running.iter_mut().for_each(Running::quiesce);
    }

    /// Ends the workers, as dropping the world does, and tells how many the system did not run within a second, or as
    /// long as the worker timeout if one is stuck in a block: they end by themselves and keep what they read until then. Frames are
    /// computed by the caller alone from then on.
    pub fn end_workers(&mut self) -> usize {
        self.running.as_mut().map_or(0, Running::end)
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
            let known = &mut self.states.bodies[index];
            // A host that sets the same states again, for a commit, must not pay for a second evaluation.
            if known.as_ref() != Some(state) {
                *known = Some(*state);
                self.changed();
            }
        }
        Ok(())
    }

    /// Computes wrenches from the states and the committed contact state. Changes nothing that a later evaluate
    /// or commit can see.
    pub fn evaluate(&mut self) -> Result<FrameReport, EngineError> {
        let running = self.running.as_mut().ok_or(not_sealed("evaluate"))?;
        running.evaluate(&self.scene, &self.states, self.clock)
    }

    /// Whether the last frame belongs to the states presently set: a commit would accept it as it is.
    pub fn is_evaluated(&self) -> bool {
        self.running.as_ref().is_some_and(|running| running.evaluated)
    }

    /// Whether wrenches and contacts are those of the states, pairs and surfaces as they are set now. A commit does not
    /// change that.
    pub fn frame_is_current(&self) -> bool {
        self.running.as_ref().is_some_and(|running| running.current)
    }

    /// Accepts the states presently set, evaluating them first if they are not the ones last evaluated.
    pub fn commit(&mut self) -> Result<(), EngineError> {
        self.must_be_evaluated()?;
        self.running_mut("commit")?.commit();
        Ok(())
    }

    /// As [`commit`](Self::commit), for some pairs only: the others keep their last committed state.
    pub fn commit_pairs(&mut self, pairs: &[PairId]) -> Result<(), EngineError> {
        for pair in pairs {
            self.pair_index(*pair)?;
        }
        self.must_be_evaluated()?;
        let stamp = self.stamp;
        let accepts = |pair| pairs.iter().any(|accepted| accepted.index_in(stamp) == Some(pair));
        self.running_mut("commit")?.commit_pairs(accepts);
        Ok(())
    }

    /// Evaluate and commit, for hosts that call once a frame.
    pub fn step(&mut self) -> Result<FrameReport, EngineError> {
        let report = self.evaluate()?;
        self.commit()?;
        Ok(report)
    }

    /// Accepts the states presently set, as [`commit`](Self::commit), and then preloads the bristles between two paired
    /// Objects: a contact that is there when a run begins is not a new one, and its friction needs no way to build up.
    /// For the first frame, and after [`clear_contact_history`](Self::clear_contact_history). Answers how many bristles were set; contacts without a bristle
    /// or without load have none. What the bristles store then, the host has put in. Allocates.
    pub fn preload_friction(
        &mut self,
        pair: PairId,
        preload: &FrictionPreload,
    ) -> Result<usize, EngineError> {
        let index = self.pair_index(pair)?;
        if let FrictionPreload::Holding(force) = preload
            && !force.iter().all(|x| x.abs() <= LARGEST)
        {
            let cause = format!(
                "the force is ({}, {}, {}) N; give numbers up to {LARGEST:e}",
                force.x, force.y, force.z
            );
            return Err(EngineError::BadValue { what: "preload of friction".to_owned(), cause });
        }
        self.running("preload friction")?;
        self.commit()?;
        let scene = Arc::clone(&self.scene);
        Ok(self.running_mut("preload friction")?.preload(&scene, index, preload))
    }

    /// Wrench on a movable group in the last frame: about the group's origin, expressed in the group's frame.
    pub fn wrench(&self, interface: InterfaceId) -> Result<Wrench, EngineError> {
        let index = self.interface_index(interface)?;
        Ok(self.framed()?.frame.wrenches[index])
    }

    /// As [`wrench`](Self::wrench), expressed along the axes of the common frame.
    pub fn wrench_common(&self, interface: InterfaceId) -> Result<Wrench, EngineError> {
        let index = self.interface_index(interface)?;
        let frame = &self.framed()?.frame;
        let (orientation, wrench) = (frame.poses[index].orientation, frame.wrenches[index]);
        Ok(Wrench { force: orientation * wrench.force, moment: orientation * wrench.moment })
    }

    /// The contacts of the last frame, in the order of every sum.
    pub fn contacts(&self) -> Vec<Contact> {
        self.contacts_iter().collect()
    }

    /// As [`contacts`](Self::contacts), one by one and without a list of their own.
    pub fn contacts_iter(&self) -> impl Iterator<Item = Contact> + '_ {
        let running = self.running.iter();
        running.flat_map(|running| running.frame.list_contacts(&self.scene, &running.sealed, self.stamp))
    }

    /// Number of contacts of the last frame.
    pub fn contact_count(&self) -> usize {
        self.report().contacts as usize
    }

    /// The last frame in short.
    pub fn report(&self) -> FrameReport {
        self.running.as_ref().map_or_else(FrameReport::default, |running| running.frame.report)
    }

    /// What went right through something else between the last commit and the last frame, if anything did
    /// ([`StatusBits::TUNNELLED`](crate::StatusBits)). A point, the centre of a ball, the origin of a ray, the ends and
    /// the middle of a segment are followed along straight lines; what is shorter than half of the thinnest part of the
    /// other movable group is taken to have gone through none.
    pub fn tunnelling(&self) -> Option<TunnellingReport> {
        let frame = &self.running.as_ref()?.frame;
        let TunnellingEvent { body_a, primitive_a, body_b } = frame.tunnelling.first?;
        let interface = |body| InterfaceId::new(self.stamp, body);
        let count = frame.tunnelling.count;
        Some(TunnellingReport {
            interface: interface(body_a),
            primitive: primitive_a,
            through: interface(body_b),
            count,
        })
    }

    /// How often what was tested in the last frame, and what that found.
    pub fn counts(&self) -> FrameCounts {
        self.running.as_ref().map_or_else(FrameCounts::default, |running| running.frame.counts)
    }

    /// Time per stage of the last frame; zero without a clock ([`set_clock`](Self::set_clock)).
    pub fn stage_times(&self) -> StageTimes {
        self.running.as_ref().map_or_else(StageTimes::default, |running| running.frame.times)
    }

    /// What the calling thread (first) and each worker did in the last round of work that they shared. Empty without
    /// workers.
    pub fn lane_work(&self) -> impl Iterator<Item = pong_threads::LaneWork> + '_ {
        self.running.iter().flat_map(Running::lane_work)
    }

    /// Where the time of the last frame's contacts went on the calling thread (first) and on each worker. Zero without a
    /// clock; empty before the seal. Rounds that the calling thread did again by itself count for it alone.
    pub fn lane_times(&self) -> impl Iterator<Item = WorkTimes> + '_ {
        self.running.iter().flat_map(Running::lane_times)
    }

    /// Rounds of work since the world was sealed that the calling thread did by itself because a worker did not come
    /// back in time, or had not come back from an earlier round. The results are the same; the time is not.
    pub fn worker_timeouts(&self) -> u64 {
        self.running.as_ref().map_or(0, Running::worker_timeouts)
    }

    /// Memory that frames have needed against what there is.
    pub fn memory(&self) -> MemoryReport {
        self.running.as_ref().map_or_else(MemoryReport::default, Running::memory_report)
    }

    /// Energies at the last commit. Zero unless [`Config::ledger`] is set.
    pub fn ledger(&self) -> Ledger {
        let Some(running) = &self.running else { return Ledger::default() };
        let memory = &running.memory;
        let stored = memory.records.iter().map(|record| record.stored).sum();
        Ledger { stored, work: memory.work, dissipated: memory.dissipated }
    }

    /// What the host does with wrenches, if accounts are kept ([`Config::accounts`]).
    pub fn wrench_coupling(&self) -> Option<WrenchCoupling> {
        self.scene.config.accounts
    }

    /// Accounts of the contacts of the last frame, one for each of [`contacts`](Self::contacts) and in their order; empty
    /// unless [`Config::accounts`] is set.
    pub fn contact_accounts(&self) -> impl Iterator<Item = EnergyAccount> + '_ {
        let running = self.running.iter().filter(|_| self.scene.config.accounts.is_some());
        running.flat_map(|running| running.frame.list_accounts())
    }

    /// Accounts of all pairs of movable groups at the last commit; empty unless [`Config::accounts`] is set.
    pub fn pair_accounts(&self) -> impl Iterator<Item = PairEnergyAccount> + '_ {
        let pairs = self.running.iter().flat_map(Running::pair_energies);
        pairs.map(|(pair, energy, total, episode, stiffest)| PairEnergyAccount {
            pair: PairId::new(self.stamp, pair.pair),
            interfaces: [pair.first, pair.second].map(|body| InterfaceId::new(self.stamp, body)),
            total,
            episode,
            in_contact: energy.episode.lasts,
            episodes: energy.episodes,
            episodes_gained: energy.episodes_gained,
            episodes_unresolved: energy.episodes_unresolved,
            excess: energy.excess,
            worst_excess: energy.worst_excess,
            stiffest,
            coupling: self.scene.config.accounts.unwrap_or_default(),
        })
    }

    /// The accounts of all pairs of movable groups together, at the last commit.
    pub fn account(&self) -> EnergyAccount {
        let mut all = EnergyAccount::default();
        self.pair_accounts().for_each(|pair| all.add(&pair.total));
        all
    }

    /// Size of the largest contact state block that this world can have, bytes; fixed when the world is sealed. A buffer of
    /// this size is always large enough to save into.
    pub fn state_size(&self) -> Result<usize, EngineError> {
        Ok(self.running("ask for the size of the contact state")?.state_size())
    }

    /// Size of the block of what is remembered now, bytes: it grows and shrinks with the contacts of the last commit.
    pub fn state_used(&self) -> Result<usize, EngineError> {
        Ok(self.running("ask for the size of the contact state")?.state_used())
    }

    /// Saves the committed contact state into a buffer of at least [`state_used`](Self::state_used) bytes. What lies behind
    /// them in the buffer, up to [`state_size`](Self::state_size), becomes zero.
    pub fn save_state(&self, out: &mut [u8]) -> Result<(), EngineError> {
        Ok(self.running("save the contact state")?.save_state(out)?)
    }

    /// Restores a contact state that a world built by the same calls saved: the block alone, or with zeros behind it up to
    /// [`state_size`](Self::state_size). The states of the movable groups are the host's and are not part of it.
    pub fn restore_state(&mut self, block: &[u8]) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        Ok(self.running_mut("restore the contact state")?.restore_state(&scene, block)?)
    }

    /// Saves the committed contact state into a buffer that becomes as long as the block. The last eight bytes are a hash
    /// of all before them.
    pub fn save_state_packed(&self, out: &mut Vec<u8>) -> Result<(), EngineError> {
        let running = self.running("save the contact state")?;
        out.resize(running.state_used(), 0);
        Ok(running.save_state(out)?)
    }

    /// Whether anything is remembered: no frame was committed yet, or all was forgotten, if not.
    pub fn has_contact_state(&self) -> bool {
        let memory = self.running.as_ref().map(|running| &running.memory);
        memory.is_some_and(|memory| {
            memory.poses.iter().any(|pair| pair.known)
                || memory.records.iter().len() > 0
                || (memory.work, memory.dissipated) != (0.0, 0.0)
        })
    }

    /// Drops an Object's contact state: after a teleport or a reset nothing of its past counts.
    pub fn clear_contact_history(&mut self, object: ObjectId) -> Result<(), EngineError> {
        let object = self.object_index(object)?;
        let running = self.running.as_mut().ok_or(not_sealed("forget an Object"))?;
        let bodies = &self.scene.bodies;
        running.forget(|pair| bodies[pair.first].object == object || bodies[pair.second].object == object);
        Ok(())
    }

    /// Switches a pair on or off. A pair that is off has no contacts, and when it is switched on again it has no
    /// past.
    pub fn set_pair_enabled(&mut self, pair: PairId, enabled: bool) -> Result<(), EngineError> {
        let pair = self.pair_index(pair)?;
        if self.states.enabled[pair] != enabled {
            self.states.enabled[pair] = enabled;
            if let Some(running) = &mut self.running {
                running.forget(|groups| groups.pair == pair);
            }
        }
        Ok(())
    }

    /// Replaces the values of a surface of a model (found by its name), for all its Objects. Laws may not change.
    pub fn set_surface(&mut self, model: ModelId, surface: &Surface) -> Result<(), EngineError> {
        let index = self.model_index(model)?;
        let known = |surfaces: &[Surface]| surfaces.iter().map(|surface| surface.name.clone()).collect();
        let surfaces = &mut self.surfaces[index];
        let Some(place) = surfaces.iter().position(|old| old.name == surface.name) else {
            let (what, name) = ("surface", surface.name.clone());
            return Err(EngineError::UnknownName { what, name, known: known(surfaces) });
        };
        seal::check_surface_change(&surfaces[place], surface)?;
        let before = std::mem::replace(&mut surfaces[place], surface.clone());
        let Some(running) = &mut self.running else { return Ok(()) };
        let tables = seal::surface_tables(&self.scene, &self.surfaces, &running.sealed.group_pairs);
        match tables {
            Ok(tables) => running.set_tables(tables),
            Err(problems) => {
                self.surfaces[index][place] = before;
                return Err(EngineError::Seal { problems });
            }
        }
        Ok(())
    }

    /// A surface of a model as it is now.
    pub fn surface(&self, model: ModelId, name: &str) -> Result<&Surface, EngineError> {
        let surfaces = &self.surfaces[self.model_index(model)?];
        surfaces.iter().find(|surface| surface.name == name).ok_or_else(|| EngineError::UnknownName {
            what: "surface",
            name: name.to_owned(),
            known: surfaces.iter().map(|surface| surface.name.clone()).collect(),
        })
    }

    /// All models in the order in which they were added.
    pub fn models(&self) -> impl ExactSizeIterator<Item = (ModelId, &Arc<Model>)> {
        self.scene.models.iter().enumerate().map(|(index, model)| (ModelId::new(self.stamp, index), model))
    }

    /// All surfaces of a model as they are now.
    pub fn surfaces(&self, model: ModelId) -> Result<&[Surface], EngineError> {
        Ok(&self.surfaces[self.model_index(model)?])
    }

    /// All Objects in the order in which they were created. Their Interfaces follow each other in that order too.
    pub fn objects(&self) -> impl ExactSizeIterator<Item = ObjectId> + '_ {
        (0..self.scene.objects.len()).map(|index| ObjectId::new(self.stamp, index))
    }

    /// The id of the model an Object was made from.
    pub fn model_id_of(&self, object: ObjectId) -> Result<ModelId, EngineError> {
        Ok(ModelId::new(self.stamp, self.scene.objects[self.object_index(object)?].model))
    }

    /// All pairs with their Objects in the order in which they were declared.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = (PairId, [ObjectId; 2])> + '_ {
        let object = |index| ObjectId::new(self.stamp, index);
        let pairs = self.scene.pairs.iter().enumerate();
        pairs.map(move |(index, pair)| (PairId::new(self.stamp, index), [object(pair.a), object(pair.b)]))
    }

    /// Whether a pair is tested.
    pub fn pair_enabled(&self, pair: PairId) -> Result<bool, EngineError> {
        Ok(self.states.enabled[self.pair_index(pair)?])
    }

    /// Names of the registered force laws.
    pub fn law_names(&self) -> impl Iterator<Item = &str> {
        self.scene.laws.names()
    }

    /// Most contacts of a frame.
    pub fn contact_capacity(&self) -> Result<usize, EngineError> {
        Ok(self.running("ask for the contact capacity")?.sealed.contact_capacity)
    }

    /// Whether energies are kept.
    pub fn keeps_ledger(&self) -> bool {
        self.scene.config.ledger
    }

    /// The model an Object was made from.
    pub fn model_of(&self, object: ObjectId) -> Result<&Arc<Model>, EngineError> {
        Ok(&self.scene.models[self.scene.objects[self.object_index(object)?].model])
    }

    /// Name of an Object.
    pub fn object_name(&self, object: ObjectId) -> Result<&str, EngineError> {
        Ok(&self.scene.objects[self.object_index(object)?].name)
    }

    /// `object/path` of a movable group, as messages name it.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an id that this world did not give out.
    pub fn interface_name(&self, interface: InterfaceId) -> Result<String, EngineError> {
        Ok(self.scene.body_name(self.interface_index(interface)?))
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
        let state = &self.states.bodies[self.interface_index(interface)?];
        Ok(state.as_ref().map(|state| (state.pose(), state.twist())))
    }

    /// The state last set for a movable group, as it was set; `None` if never. [`state`](Self::state) has the
    /// quaternion normalised.
    pub fn state_as_set(&self, interface: InterfaceId) -> Result<Option<&State>, EngineError> {
        Ok(self.states.bodies[self.interface_index(interface)?].as_ref())
    }

    /// What a tool beside the engine reads of the sealed world.
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] before the seal.
    pub fn inspect(&self) -> Result<Inspection<'_>, EngineError> {
        Ok(Inspection::new(&self.scene, self.running("inspect the scene")?))
    }

    /// Hash of the sealed scene: two worlds with equal hashes can exchange contact state.
    pub fn scene_hash(&self) -> Result<u64, EngineError> {
        Ok(self.running("ask for the hash")?.sealed.hash)
    }

    fn must_be_evaluated(&mut self) -> Result<(), EngineError> {
        if !self.is_evaluated() {
            self.evaluate()?;
        }
        Ok(())
    }

    /// The last frame does not belong to what is set now.
    fn changed(&mut self) {
        self.running.iter_mut().for_each(Running::changed);
    }

    fn must_not_be_sealed(&self, call: &'static str) -> Result<(), EngineError> {
        match self.running {
            None => Ok(()),
            Some(_) => Err(EngineError::WrongPhase { call, cure: "do it before the world is sealed" }),
        }
    }

    /// The scene, as long as it may change.
    fn set_up(&mut self, call: &'static str) -> Result<&mut Scene, EngineError> {
        self.must_not_be_sealed(call)?;
        Ok(Arc::get_mut(&mut self.scene).expect("nobody shares the scene before the world is sealed"))
    }

    fn running(&self, call: &'static str) -> Result<&Running, EngineError> {
        self.running.as_ref().ok_or(not_sealed(call))
    }

    fn running_mut(&mut self, call: &'static str) -> Result<&mut Running, EngineError> {
        self.running.as_mut().ok_or(not_sealed(call))
    }

    /// What runs, if a frame has been computed.
    fn framed(&self) -> Result<&Running, EngineError> {
        let computed = self.running.as_ref().filter(|running| running.frame.computed);
        computed
            .ok_or(EngineError::WrongPhase { call: "get a wrench", cure: "evaluate or step a frame first" })
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
}

const fn not_sealed(call: &'static str) -> EngineError {
    EngineError::WrongPhase { call, cure: "seal the world first" }
}
