//! The calls of a host.

use crate::block;
use crate::error::SlowError;
use crate::frame::{compute, plain_status};
use crate::input::{Coupling, GroupInput, require_couplings};
use crate::memory::Memory;
use crate::report::Report;
use crate::settings::Settings;
use pong_engine::{InterfaceId, State, World};
use pong_geometry::{Pose, Wrench};

/// Contact for a host that calls once in a long frame: a world of its own, with the same ids as the world it was made
/// from, that follows copies of the bodies.
pub struct SlowHost {
    world: World,
    settings: Settings,
    couplings: Vec<Coupling>,
    memory: Memory,
    /// Committed contact state.
    block: Vec<u8>,
    pending: Option<Pending>,
    report: Report,
    wrenches: Vec<Wrench>,
    orientations: Vec<pong_geometry::Quat>,
}

/// Result of an evaluation, for the commit.
enum Pending {
    Slow(Memory),
    Plain,
}

impl SlowHost {
    /// A slow host with a clone of a world, and its contact state.
    ///
    /// # Errors
    /// [`SlowError::BadSetting`] for settings outside their ranges; [`SlowError::Engine`] as
    /// [`World::try_clone`](pong_engine::World::try_clone).
    pub fn new(world: &World, settings: Settings) -> Result<Self, SlowError> {
        settings.require_valid()?;
        Self::with_world(world.try_clone()?, settings)
    }

    /// A slow host that owns this world, and begins with its contact state: for worlds with laws of the caller's, which
    /// [`World::try_clone_with_laws`](pong_engine::World::try_clone_with_laws) clones.
    ///
    /// # Errors
    /// [`SlowError::BadSetting`] for settings outside their ranges.
    pub fn with_world(world: World, settings: Settings) -> Result<Self, SlowError> {
        settings.require_valid()?;
        let mut block = Vec::new();
        world.save_state_packed(&mut block);
        let (memory, report) = (Memory::default(), Report::default());
        let (wrenches, orientations) = (Vec::new(), Vec::new());
        let couplings = Vec::new();
        Ok(Self { world, settings, couplings, memory, block, pending: None, report, wrenches, orientations })
    }

    /// The world of the copies.
    pub fn into_world(self) -> World {
        self.world
    }

    /// Settings of the run.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// World of the copies, for its scene, names and ids, and for the contacts of its last evaluation.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Sets the couplings of jointed groups, for the frames that are evaluated from now on: all of them, in place of those
    /// of the last call. Groups that are not coupled do not move by the impulses of each other.
    ///
    /// # Errors
    /// [`SlowError::BadInput`] for a coupling of a group with itself, given twice, or not finite;
    /// [`SlowError::Engine`] for ids of another world. The couplings stay as they were then.
    pub fn set_couplings(&mut self, couplings: &[Coupling]) -> Result<(), SlowError> {
        require_couplings(&self.world, couplings)?;
        self.couplings.clear();
        self.couplings.extend_from_slice(couplings);
        Ok(())
    }

    /// Computes the wrenches to hold over a frame of this length (s). Has no effect on later calls of evaluate or
    /// commit. Inputs are needed of every movable group.
    ///
    /// # Errors
    /// [`SlowError::BadInput`] for a length that is not positive, for masses that are missing, given twice or not
    /// positive, and for couplings of groups that are not jointed or that give a mobility with a negative eigenvalue; [`SlowError::Engine`] for ids of another world and for states that the engine refuses.
    pub fn evaluate(&mut self, length: f64, inputs: &[GroupInput]) -> Result<&Report, SlowError> {
        self.pending = None;
        self.world.restore_state(&self.block)?;
        let memory = (&self.memory, &self.block[..]);
        let given = (inputs, &self.couplings[..]);
        let computed = compute(&mut self.world, &self.settings, memory, length, given)?;
        self.orientations.clear();
        self.orientations.resize(inputs.len(), pong_geometry::Quat::identity());
        for input in inputs {
            self.orientations[input.interface.index()] = input.state.pose().orientation;
        }
        self.report = computed.report;
        self.wrenches = computed.wrenches;
        self.pending = Some(Pending::Slow(computed.memory));
        Ok(&self.report)
    }

    /// Evaluates the engine at states of which nothing else is known: the wrenches are those of
    /// [`World::evaluate`](pong_engine::World::evaluate), bit for bit. Copies are given up at the commit.
    ///
    /// # Errors
    /// As [`World::set_states`](pong_engine::World::set_states) and
    /// [`World::evaluate`](pong_engine::World::evaluate).
    pub fn evaluate_states(&mut self, states: &[(InterfaceId, State)]) -> Result<&Report, SlowError> {
        self.pending = None;
        self.world.restore_state(&self.block)?;
        self.world.set_states(states)?;
        let frame = self.world.evaluate()?;
        let objects: Vec<_> = self.world.scene().objects().collect();
        self.wrenches.clear();
        self.orientations.clear();
        for object in objects {
            for interface in self.world.scene().interfaces(object)? {
                self.wrenches.push(self.world.wrench_common(interface)?);
                let pose = self.world.state(interface)?.map_or_else(Pose::identity, |(pose, _)| pose);
                self.orientations.push(pose.orientation);
            }
        }
        let (contacts, status) = (frame.contacts, plain_status(frame.status));
        self.report = Report { evaluations: 1, contacts, status, ..Report::default() };
        self.pending = Some(Pending::Plain);
        Ok(&self.report)
    }

    /// Accepts the frame that was evaluated last: the only call that changes what is kept.
    ///
    /// # Errors
    /// [`SlowError::WrongPhase`] if there is none.
    pub fn commit(&mut self) -> Result<(), SlowError> {
        match self.pending.take() {
            None => {
                let cure = "evaluate a frame first";
                return Err(SlowError::WrongPhase { call: "commit of a slow host", cure });
            }
            Some(Pending::Slow(memory)) => self.memory = memory,
            Some(Pending::Plain) => {
                self.world.commit()?;
                self.memory = Memory::default();
            }
        }
        self.world.save_state_packed(&mut self.block);
        Ok(())
    }

    /// Drops the frame that was evaluated last, so that it cannot be committed.
    pub fn discard(&mut self) {
        self.pending = None;
    }

    /// [`evaluate`](Self::evaluate) and [`commit`](Self::commit).
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); nothing is committed then.
    pub fn step(&mut self, length: f64, inputs: &[GroupInput]) -> Result<&Report, SlowError> {
        self.evaluate(length, inputs)?;
        self.commit()?;
        Ok(&self.report)
    }

    /// Report of the last frame.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Wrench on a movable group about its origin, N and N·m, along common axes for the orientation at the start of the
    /// frame. A free body holds it along these axes.
    ///
    /// # Errors
    /// [`SlowError::Engine`] for an id of another world; [`SlowError::WrongPhase`] before the first frame.
    pub fn wrench_common(&self, interface: InterfaceId) -> Result<Wrench, SlowError> {
        self.world.state_as_set(interface)?;
        let cure = "evaluate a frame first";
        let missing = SlowError::WrongPhase { call: "get a wrench", cure };
        self.wrenches.get(interface.index()).copied().ok_or(missing)
    }

    /// Wrench on a movable group about its origin, N and N·m, along the axes of the group. A jointed body holds it along
    /// these axes, which turn with it.
    ///
    /// # Errors
    /// As [`wrench_common`](Self::wrench_common).
    pub fn wrench(&self, interface: InterfaceId) -> Result<Wrench, SlowError> {
        let common = self.wrench_common(interface)?;
        let back = self.orientations[interface.index()].inverse();
        Ok(Wrench { force: back * common.force, moment: back * common.moment })
    }

    /// Size of the largest state that this host can save, bytes.
    pub fn state_size(&self) -> usize {
        let bodies = self.world.inspect().group_count();
        block::size_max(bodies, self.settings.delay_frames, self.world.state_size())
    }

    /// Memory between frames, with the contact state, as bytes.
    pub fn save_state(&self) -> Vec<u8> {
        block::write(&self.memory, &self.block, self.world.scene_hash())
    }

    /// Restores bytes that [`save_state`](Self::save_state) returned, in a world of the same scene.
    ///
    /// # Errors
    /// [`SlowError::BadState`] or [`SlowError::Engine`] for bytes that are damaged or of another scene; nothing is
    /// restored then.
    pub fn restore_state(&mut self, bytes: &[u8]) -> Result<(), SlowError> {
        let bodies = self.world.inspect().group_count();
        let (memory, contact) = block::read(bytes, self.world.scene_hash(), bodies)?;
        self.world.restore_state(&contact)?;
        (self.memory, self.block, self.pending) = (memory, contact, None);
        Ok(())
    }
}
