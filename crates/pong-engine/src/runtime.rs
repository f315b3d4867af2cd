//! What a seal starts: the memory, the workers and the frames of a world. [`World`](crate::World) checks what a host gives
//! and keeps the states; everything here has been checked.

use crate::energy::account::EnergyAccount;
use crate::energy::contact::ContactEnergies;
use crate::energy::episodes::{PairEnergies, PairEnergy};
use crate::error::EngineError;
use crate::frame::{
    self, EvaluationBuffers, EvaluationInput, FrictionPreload, MOTIONS_AT_ONCE, ROUND, WorkerInput,
    WorkerPool, fresh, remember,
};
use crate::report::{Clock, FrameReport, MemoryReport, Stage, StatusBits, WorkTimes};
use crate::scene::{Scene, States};
use crate::seal::leave_room_for_small_things;
use crate::sealed::{GroupPair, Sealed, SurfaceTable};
use crate::state::{
    CommittedPoses, ContactKey, ContactMemory, ContactRole, StateError, largest_len, needed_len, read_block,
    write_block,
};
use pong_threads::{LaneWork, WorkerStart};
use std::sync::Arc;
use std::time::Duration;

/// The memory and the workers of a sealed world, and its last frame.
pub(crate) struct Runtime {
    pub sealed: Arc<Sealed>,
    pub tables: Arc<Vec<SurfaceTable>>,
    /// The committed contact state.
    pub memory: Arc<ContactMemory>,
    /// Where the next contact state is written. A worker that is stuck may still read one that was committed once,
    /// so there is one more than the two that take turns.
    spares: Vec<Arc<ContactMemory>>,
    /// A contact state without room.
    nothing: Arc<ContactMemory>,
    pub frame: EvaluationBuffers,
    pub pool: Option<WorkerPool>,
    /// Whether `frame` belongs to the states presently set.
    pub evaluated: bool,
    /// Whether `frame` belongs to the states, pairs and surfaces as they are set now, committed or not.
    pub current: bool,
    pub clock: Clock,
    contacts_peak: usize,
    /// Of every pair of Objects whether a commit of some accepts it; written anew by each.
    accepted: Box<[bool]>,
}

impl Runtime {
    /// Takes all memory and starts the workers.
    pub fn start(
        scene: &Arc<Scene>,
        sealed: Arc<Sealed>,
        tables: Arc<Vec<SurfaceTable>>,
        clock: Clock,
    ) -> Result<Self, EngineError> {
        let pairs = sealed.group_pairs.len();
        let settings = scene.config.workers.as_ref();
        let workers = settings.map_or(0, |settings| settings.workers_granted());
        let memory = || {
            let poses =
                CommittedPoses::new(Arc::clone(&sealed.paired_bodies), scene.bodies.len(), scene.pairs.len());
            let memory =
                ContactMemory::with_capacity(poses, pairs, sealed.record_capacity, sealed.law_state_len);
            let energies = ContactEnergies::with_capacity(sealed.coupling, sealed.record_capacity);
            let pairs = PairEnergies::new(sealed.account_pairs(), sealed.delay());
            Arc::new(
                memory.with_lanes(workers + 1, sealed.limits.lane_records()).with_energies(energies, pairs),
            )
        };
        let nothing = Arc::new(ContactMemory::default());
        let input = || WorkerInput {
            phase: 0,
            motions: Vec::with_capacity(pairs.min(MOTIONS_AT_ONCE)),
            tables: Arc::clone(&tables),
            blocks: Vec::with_capacity(ROUND),
            clock,
        };
        // Before the workers: the allocator reserves address space for every thread.
        let committed = memory();
        let spares = if scene.config.workers.is_some() { 2 } else { 1 };
        let spares = (0..spares).map(|_| memory()).collect();
        let frame = EvaluationBuffers::new(scene, &sealed, input(), workers);
        let pool = match &scene.config.workers {
            None => None,
            Some(settings) => {
                if settings.workers > pong_threads::MAX_WORKERS {
                    let (asked, most) = (settings.workers, pong_threads::MAX_WORKERS);
                    let cause =
                        format!("{asked} are more than any machine has cores for; ask for at most {most}");
                    return Err(EngineError::Workers { cause });
                }
                let settings = crate::scene::WorkerSettings { clock: clock.0, ..settings.clone() };
                leave_room_for_small_things();
                let started = WorkerPool::start(scene, &sealed, input(), &nothing, &settings);
                Some(started.map_err(|error| EngineError::Workers { cause: error.to_string() })?)
            }
        };
        Ok(Self {
            memory: committed,
            spares,
            frame,
            pool,
            evaluated: false,
            current: false,
            clock,
            contacts_peak: 0,
            accepted: vec![false; scene.pairs.len()].into_boxed_slice(),
            nothing: Arc::clone(&nothing),
            sealed,
            tables,
        })
    }

    /// Another of the same sealed scene, with these values of surfaces, that remembers the same contacts. It has memory and
    /// workers of its own and no frame yet.
    pub fn start_clone(
        &self,
        scene: &Arc<Scene>,
        tables: Arc<Vec<SurfaceTable>>,
    ) -> Result<Self, EngineError> {
        let mut clone = Self::start(scene, Arc::clone(&self.sealed), tables, self.clock)?;
        Arc::get_mut(&mut clone.memory).expect("nobody else has it yet").copy_from(&self.memory);
        Ok(clone)
    }

    /// What is set now is no longer what the last frame was computed from.
    pub fn changed(&mut self) {
        (self.evaluated, self.current) = (false, false);
    }

    /// Computes a frame.
    #[inline]
    pub fn evaluate(&mut self, scene: &Scene, states: &States) -> Result<FrameReport, EngineError> {
        frame::require_states(scene, &self.sealed, states)?;
        // Should a law of the host's panic or a sum overflow, there is no frame until the next one.
        (self.evaluated, self.current, self.frame.computed) = (false, false, false);
        let given =
            EvaluationInput { scene, sealed: &self.sealed, states, memory: &self.memory, clock: self.clock };
        frame::evaluate(&given, self.pool.as_mut(), &mut self.frame);
        self.let_go_of_memory();
        self.contacts_peak = self.contacts_peak.max(self.frame.order.len());
        if let Some(body) = self.frame.overflows(&self.sealed) {
            // Nobody is to see its contacts.
            self.frame.order.clear();
            self.frame.report = FrameReport::default();
            return Err(EngineError::NotFinite { interface: scene.body_name(body) });
        }
        (self.evaluated, self.current, self.frame.computed) = (true, true, true);
        Ok(self.frame.report)
    }

    /// Once a frame is done, or a law of the host's has panicked in it, only a worker that is stuck may still hold a
    /// contact state.
    #[inline]
    fn let_go_of_memory(&mut self) {
        if let Some(pool) = &mut self.pool {
            pool.release(&self.nothing);
        }
    }

    /// Poses of the last two commits, the earlier ones first, if both were of all pairs and nothing came in between.
    pub fn last_two_commits(&self) -> Option<(&CommittedPoses, &CommittedPoses)> {
        let now = &self.memory.poses;
        let earlier = self
            .spares
            .iter()
            .map(|spare| &spare.poses)
            .filter(|poses| (1..now.frame()).contains(&poses.frame()));
        let before = earlier.max_by_key(|poses| poses.frame())?;
        (now.frame() == self.frame.number).then_some((before, now))
    }

    /// Makes what the frame found the committed contact state.
    #[inline]
    pub fn commit(&mut self, states: &States) {
        let mut watch = self.clock.start();
        let Self { memory, spares, frame, .. } = self;
        take_turns(memory, spares, |old, next| {
            next.poses.commit(&old.poses, (frame.number, &frame.poses), &states.enabled);
            remember(frame, next);
            (next.work, next.dissipated) = (frame.energy.work, frame.energy.dissipated);
            next.pair_energies.copy_from(&frame.energy.pairs);
        });
        watch.lap(Stage::Commit, &mut frame.times);
        self.evaluated = false;
    }

    /// As [`commit`](Self::commit) for some pairs of Objects; the others keep their contact state. Both
    /// together may be more than there is room for: then the strongest stay, and the status says so.
    ///
    /// # Errors
    /// [`EngineError::BadValue`] if the others were last committed at more moments than there is room for beside this one.
    /// Nothing is committed then.
    pub fn commit_pairs(
        &mut self,
        states: &States,
        pairs: impl Iterator<Item = usize>,
    ) -> Result<(), EngineError> {
        let mut accepted = std::mem::take(&mut self.accepted);
        accepted.fill(false);
        pairs.for_each(|pair| accepted[pair] = true);
        let outcome = self.commit_accepted(states, |pair| accepted[pair]);
        self.accepted = accepted;
        outcome
    }

    fn commit_accepted(
        &mut self,
        states: &States,
        accepts: impl Fn(usize) -> bool,
    ) -> Result<(), EngineError> {
        if !(0..self.memory.poses.pairs()).any(&accepts) {
            self.evaluated = false;
            return Ok(());
        }
        let Some(moment) = self.memory.poses.free_moment(&accepts) else {
            let most = self.memory.poses.capacity();
            let cause = format!(
                "the pairs that keep their past were last committed at {most} different moments, and there is no room to \
                 remember one more; commit some of them together, or all pairs at once"
            );
            return Err(EngineError::BadValue { what: "commit of some pairs".to_owned(), cause });
        };
        self.let_go_of_memory();
        let mut watch = self.clock.start();
        let Self { sealed, memory, spares, frame, .. } = self;
        let accepted = |group_pair: u32| accepts(sealed.group_pairs[group_pair as usize].pair);
        let mut left_out = 0;
        take_turns(memory, spares, |old, next| {
            let now = (&frame.poses[..], &states.enabled[..]);
            next.poses.commit_some(&old.poses, now, moment, &accepts);
            left_out =
                old.accept_into(fresh(frame), (&frame.energy.pairs, &frame.energy.added), accepted, next);
        });
        if left_out > 0 {
            frame.report.status.set(StatusBits::CONTACT_LIMIT);
            let wanted = sealed.contact_capacity.saturating_add(left_out).try_into().unwrap_or(u32::MAX);
            frame.report.contacts_wanted = frame.report.contacts_wanted.max(wanted);
        }
        watch.lap(Stage::Commit, &mut frame.times);
        self.evaluated = false;
        Ok(())
    }

    /// Preloads the bristles of a pair of Objects after a commit of the last frame; answers how many there are. What they store
    /// more is booked as put in by the host.
    pub fn preload(&mut self, scene: &Scene, pair: usize, preload: &FrictionPreload) -> usize {
        self.let_go_of_memory();
        let preloaded = self.frame.preloaded(scene, &self.sealed, &self.memory, pair, preload);
        take_turns(&mut self.memory, &mut self.spares, |old, next| {
            next.copy_from(old);
            next.preload(&preloaded, scene.config.ledger);
        });
        self.changed();
        preloaded.len()
    }

    /// Drops what is remembered of some pairs of Objects.
    pub fn clear_history(&mut self, scene: &Scene, cleared: impl Fn(usize) -> bool) {
        self.let_go_of_memory();
        let pairs = &self.sealed.group_pairs;
        take_turns(&mut self.memory, &mut self.spares, |old, next| {
            next.copy_from(old);
            next.clear_history(&cleared, |index| pairs[index as usize].pair, scene.config.ledger);
        });
        self.changed();
    }

    /// Pairs of movable groups with their accounts, what they have stored taken in, and the stiffest of their contacts.
    pub fn pair_energies(
        &self,
    ) -> impl Iterator<Item = (&GroupPair, &PairEnergy, EnergyAccount, EnergyAccount, Option<(f64, f64)>)>
    {
        let energies = &self.memory.pair_energies.pairs;
        self.sealed.group_pairs.iter().zip(energies).enumerate().map(|(index, (pair, energy))| {
            let records = &self.memory.records;
            let of_pair = records.of_group_pair(index as u32);
            let pushing = of_pair.filter(|record| record.role == ContactRole::Active);
            let stored = pushing.map(|record| record.stored).sum::<f64>() + 0.0;
            let total = EnergyAccount { stored, ..energy.total };
            let episode = EnergyAccount { stored, ..energy.episode.account };
            (pair, energy, total, episode, self.stiffest(pair))
        })
    }

    /// Stiffness and damping of the stiffest contact of a pair, where they do not depend on the depth.
    pub fn stiffest(&self, pair: &GroupPair) -> Option<(f64, f64)> {
        let tables = pair.tables.iter().map(|&table| &self.tables[table]);
        tables.filter_map(SurfaceTable::stiffest).max_by(|a, b| a.0.total_cmp(&b.0))
    }

    pub fn state_size(&self) -> usize {
        largest_len(&self.memory)
    }

    pub fn save_state(&self, out: &mut [u8]) -> Result<(), StateError> {
        write_block(&self.memory, self.sealed.hash, out)
    }

    pub fn state_used(&self) -> usize {
        needed_len(&self.memory)
    }

    pub fn restore_state(&mut self, scene: &Scene, block: &[u8]) -> Result<(), StateError> {
        self.let_go_of_memory();
        let sealed = Arc::clone(&self.sealed);
        let exists = |key: &ContactKey| {
            let (body_a, _) = sealed.bodies_of(key.direction());
            (key.primitive_a as usize) < scene.body(body_a).primitives.len()
        };
        let mut outcome = Ok(());
        take_turns(&mut self.memory, &mut self.spares, |old, next| {
            next.copy_from(old);
            outcome = read_block(next, sealed.hash, block, exists);
        });
        outcome?;
        self.changed();
        Ok(())
    }

    /// Replaces the values of surfaces.
    pub fn set_tables(&mut self, tables: Vec<SurfaceTable>) {
        self.tables = Arc::new(tables);
        self.frame.input.tables = Arc::clone(&self.tables);
        // Not left to the next frame, which would give the old ones back.
        self.pool.iter().for_each(|pool| pool.set_tables(&self.tables));
        self.changed();
    }

    pub fn worker_starts(&self) -> &[WorkerStart] {
        self.pool.as_ref().map_or(&[], |pool| pool.pool().start_report())
    }

    pub fn lane_work(&self) -> impl Iterator<Item = LaneWork> + '_ {
        self.pool.iter().flat_map(|pool| pool.pool().work())
    }

    /// WorkerContext by lane, the caller's first: what it did alone, and its part of what was shared.
    pub fn lane_times(&self) -> impl Iterator<Item = WorkTimes> + '_ {
        let workers = self.pool.iter().flat_map(WorkerPool::times);
        std::iter::once(self.frame.caller.out.times).chain(workers.copied())
    }

    pub fn worker_timeouts(&self) -> u64 {
        self.pool.as_ref().map_or(0, |pool| pool.timeouts)
    }

    pub fn prewake(&mut self, at_most: Duration) {
        self.pool.iter_mut().for_each(|pool| pool.prewake(at_most));
    }

    pub fn quiesce(&mut self) {
        self.pool.iter_mut().for_each(WorkerPool::quiesce);
    }

    /// Ends the workers; how many were left behind.
    pub fn end(&mut self) -> usize {
        self.pool.as_mut().map_or(0, WorkerPool::end)
    }

    pub fn memory_report(&self) -> MemoryReport {
        let lane = &self.frame.caller;
        let (arena, scratch) = self.pool.as_ref().map_or((0, 0), WorkerPool::peaks);
        MemoryReport {
            contacts_peak: self.contacts_peak,
            contacts_capacity: self.sealed.record_capacity,
            arena_peak: lane.arena.peak().max(arena),
            arena_capacity: lane.arena.capacity(),
            scratch_peak: lane.scratch.peak().max(scratch),
            scratch_capacity: lane.scratch.capacity(),
        }
    }
}

/// Writes the next contact state and makes it the committed one. The old one waits for its turn.
#[inline]
fn take_turns(
    memory: &mut Arc<ContactMemory>,
    spares: &mut [Arc<ContactMemory>],
    write: impl FnOnce(&ContactMemory, &mut ContactMemory),
) {
    let free = spares.iter_mut().find(|spare| Arc::strong_count(spare) == 1);
    let spare = free.expect("at most one contact state is held by a worker that is stuck");
    write(memory, Arc::get_mut(spare).expect("nobody else has it"));
    std::mem::swap(memory, spare);
}
