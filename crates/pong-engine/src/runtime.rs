//! Run-time part of a sealed world: its memory, its workers and its frames. [`World`](crate::World) keeps the
//! states, and checks what the host hands in before it calls this part.

use crate::energy::LedgerEntry;
use crate::energy::account::EnergyAccount;
use crate::energy::contact::ContactEnergies;
use crate::energy::episodes::{PairEnergies, PairEnergy};
use crate::error::EngineError;
use crate::frame::{
    self, EvaluationBuffers, EvaluationInput, FrictionPreload, MOTIONS_AT_ONCE, ROUND, TunnellingEvents,
    WorkerInput, WorkerPool, new_records, write_records,
};
use crate::report::{Clock, FrameReport, MemoryReport, Stage, StatusBits, WorkTimes};
use crate::scene::{Scene, States};
use crate::seal::{GroupPair, Sealed, SurfaceTable};
use crate::state::{
    CarryOutcome, CommittedPoses, ContactKey, ContactMemory, ContactRole, Counterparts, StateError,
    largest_len, needed_len, read_block, write_block,
};
use pong_geometry::Pose;
use pong_threads::{ThreadWork, WorkerStart};
use std::sync::Arc;
use std::time::Duration;

/// The memory and the workers of a sealed world, and its last frame.
pub(crate) struct Runtime {
    pub sealed: Arc<Sealed>,
    pub tables: Arc<Vec<SurfaceTable>>,
    /// The committed contact state.
    pub memory: Arc<ContactMemory>,
    /// Memory for the next contact state, swapped with `memory` when it is written. A stuck worker may still
    /// hold an earlier contact state, so a world with workers has two back buffers.
    back_buffers: Vec<Arc<ContactMemory>>,
    /// Contact state without capacity; the workers hold it between frames.
    nothing: Arc<ContactMemory>,
    pub frame: EvaluationBuffers,
    pub pool: Option<WorkerPool>,
    /// True if `frame` was computed from the current states and is not yet committed.
    pub evaluated: bool,
    /// True if `frame` was computed from the current states, pairs and surfaces, whether committed or not.
    pub current: bool,
    /// Number of the frame last committed, in whole or in part; 0 before the first.
    pub committed: u64,
    pub clock: Clock,
    contacts_peak: usize,
    /// For each pair of Objects: true if the current partial commit accepts it. Rewritten by each partial
    /// commit.
    accepted: Box<[bool]>,
}

impl Runtime {
    /// Allocates all memory and starts the workers.
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
                CommittedPoses::new(Arc::clone(&sealed.paired_bodies), scene.bodies.len(), scene.pairs.len())
                    .with_travels(scene.config.moving_surfaces);
            let memory =
                ContactMemory::with_capacity(poses, pairs, sealed.record_capacity, sealed.law_state_len);
            let energies = ContactEnergies::with_capacity(sealed.coupling, sealed.record_capacity);
            let pairs = PairEnergies::new(sealed.account_pairs(), sealed.delay());
            Arc::new(memory.with_energies(energies, pairs))
        };
        let nothing = Arc::new(ContactMemory::default());
        let input = || WorkerInput {
            phase: 0,
            motions: Vec::with_capacity(pairs.min(MOTIONS_AT_ONCE)),
            surfaces: Vec::with_capacity(scene.bodies.len()),
            tables: Arc::clone(&tables),
            blocks: Vec::with_capacity(ROUND),
            clock,
        };
        // Allocated before the workers start: the allocator reserves address space for every thread, and this
        // space may be limited.
        let committed = memory();
        let back_buffers = if scene.config.workers.is_some() { 2 } else { 1 };
        let back_buffers = (0..back_buffers).map(|_| memory()).collect();
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
                pong_arena::keep_small_blocks_free();
                let started = WorkerPool::start(scene, &sealed, input(), &nothing, &settings);
                Some(started.map_err(|error| EngineError::Workers { cause: error.to_string() })?)
            }
        };
        Ok(Self {
            memory: committed,
            back_buffers,
            frame,
            pool,
            evaluated: false,
            current: false,
            committed: 0,
            clock,
            contacts_peak: 0,
            accepted: vec![false; scene.pairs.len()].into_boxed_slice(),
            nothing: Arc::clone(&nothing),
            sealed,
            tables,
        })
    }

    /// Starts a copy of this runtime for the same sealed scene, with other surface values and the same
    /// contact history. The copy has its own memory and workers, and no frame yet.
    pub fn start_clone(
        &self,
        scene: &Arc<Scene>,
        tables: Arc<Vec<SurfaceTable>>,
    ) -> Result<Self, EngineError> {
        let mut clone = Self::start(scene, Arc::clone(&self.sealed), tables, self.clock)?;
        Arc::get_mut(&mut clone.memory).expect("nobody else has it yet").copy_from(&self.memory);
        Ok(clone)
    }

    /// Marks the last frame as out of date.
    pub fn changed(&mut self) {
        (self.evaluated, self.current) = (false, false);
    }

    /// Computes a frame from the states.
    #[inline]
    pub fn evaluate(&mut self, scene: &Scene, states: &States) -> Result<FrameReport, EngineError> {
        frame::require_states(scene, &self.sealed, states)?;
        // If a host's law panics or a sum overflows, no frame is valid until the next evaluate.
        (self.evaluated, self.current, self.frame.computed) = (false, false, false);
        let given =
            EvaluationInput { scene, sealed: &self.sealed, states, memory: &self.memory, clock: self.clock };
        let overflow = frame::evaluate(&given, self.pool.as_mut(), &mut self.frame);
        self.release_memory();
        self.contacts_peak = self.contacts_peak.max(self.frame.order.len());
        if let Some(body) = overflow {
            // Discard the contacts of a frame whose wrench overflowed.
            self.frame.order.clear();
            self.frame.report = FrameReport::default();
            return Err(EngineError::NotFinite { interface: scene.body_name(body) });
        }
        (self.evaluated, self.current, self.frame.computed) = (true, true, true);
        Ok(self.frame.report)
    }

    /// Makes the workers release the contact state, even after a host's law has panicked. Afterwards only a
    /// stuck worker may still hold one.
    #[inline]
    fn release_memory(&mut self) {
        if let Some(pool) = &mut self.pool {
            pool.release(&self.nothing);
        }
    }

    /// Poses of the last two commits, earlier first, if both covered all pairs and no other commit lies
    /// between them.
    pub fn last_two_commits(&self) -> Option<(&CommittedPoses, &CommittedPoses)> {
        let now = &self.memory.poses;
        let earlier = self
            .back_buffers
            .iter()
            .map(|buffer| &buffer.poses)
            .filter(|poses| (1..now.frame()).contains(&poses.frame()));
        let before = earlier.max_by_key(|poses| poses.frame())?;
        (self.frame.computed && now.frame() == self.frame.number).then_some((before, now))
    }

    /// Commits the contact state of the last frame.
    #[inline]
    pub fn commit(&mut self, states: &States) {
        let mut watch = self.clock.start();
        let Self { memory, back_buffers, frame, .. } = self;
        write_and_swap(memory, back_buffers, |old, next| {
            next.poses.commit(&old.poses, (frame.number, &frame.poses), &states.enabled);
            next.poses.commit_travels(0, frame.input.travels());
            write_records(frame, next);
            let LedgerEntry { work, dissipated } = frame.energy.total;
            (next.work, next.dissipated) = (work, dissipated);
            next.pair_energies.copy_from(&frame.energy.pairs);
        });
        watch.lap(Stage::Commit, &mut frame.times);
        self.committed = frame.number;
        self.evaluated = false;
    }

    /// Commits some pairs of Objects; the others keep their contact state. If the contacts of both together
    /// exceed the capacity, those with the largest forces are kept and the status reports the limit.
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
        let Some(epoch) = self.memory.poses.free_epoch(&accepts) else {
            let most = self.memory.poses.capacity();
            let cause = format!(
                "the other pairs keep {most} commit epochs (commits that are the last of some pair), and there is no room for one \
                 more; commit some of them together, or all pairs at once"
            );
            return Err(EngineError::BadValue { what: "commit of some pairs".to_owned(), cause });
        };
        self.release_memory();
        let mut watch = self.clock.start();
        let Self { sealed, memory, back_buffers, frame, .. } = self;
        let accepted = |group_pair: u32| accepts(sealed.group_pairs[group_pair as usize].pair);
        let mut left_out = 0;
        write_and_swap(memory, back_buffers, |old, next| {
            let now = (&frame.poses[..], &states.enabled[..]);
            next.poses.commit_some(&old.poses, now, epoch, &accepts);
            next.poses.commit_travels(epoch, frame.input.travels());
            left_out = old.merge_into(
                new_records(frame),
                (&frame.energy.pairs, &frame.energy.added),
                accepted,
                next,
            );
        });
        if left_out > 0 {
            frame.report.status.set(StatusBits::CONTACT_LIMIT);
            let wanted = sealed.contact_capacity.saturating_add(left_out).try_into().unwrap_or(u32::MAX);
            frame.report.contacts_wanted = frame.report.contacts_wanted.max(wanted);
        }
        watch.lap(Stage::Commit, &mut frame.times);
        self.committed = frame.number;
        self.evaluated = false;
        Ok(())
    }

    /// Preloads the bristles of a pair of Objects after a commit of the last frame; returns the number of
    /// bristles. The accounts book the energy that the bristles gain as inserted by the host, the ledger as
    /// negative dissipation.
    pub fn preload(&mut self, scene: &Scene, pair: usize, preload: &FrictionPreload) -> usize {
        self.release_memory();
        let preloaded = self.frame.preloaded(scene, &self.sealed, &self.memory, pair, preload);
        write_and_swap(&mut self.memory, &mut self.back_buffers, |old, next| {
            next.copy_from(old);
            next.preload(&preloaded, scene.config.ledger);
        });
        self.changed();
        preloaded.len()
    }

    /// Clears the contact history of some pairs of Objects.
    pub fn clear_history(&mut self, scene: &Scene, cleared: impl Fn(usize) -> bool) {
        self.release_memory();
        let pairs = &self.sealed.group_pairs;
        write_and_swap(&mut self.memory, &mut self.back_buffers, |old, next| {
            next.copy_from(old);
            next.clear_history(&cleared, |index| pairs[index as usize].pair, scene.config.ledger);
        });
        self.changed();
    }

    /// Pairs of movable groups, each with its energies, its account in all and of the episode (stored energy
    /// included), and the result of [`stiffest`](Self::stiffest).
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

    /// Stiffness, N/m, and damping, N·s/m, of the stiffest two surfaces of a pair that can meet and whose
    /// normal force is linear in the depth; `None` if there are none.
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
        self.release_memory();
        let sealed = Arc::clone(&self.sealed);
        let exists = |key: &ContactKey| {
            let (body_a, _) = sealed.bodies_of(key.direction());
            (key.primitive_a as usize) < scene.body(body_a).primitives.len()
        };
        let mut outcome = Ok(());
        write_and_swap(&mut self.memory, &mut self.back_buffers, |old, next| {
            next.copy_from(old);
            outcome = read_block(next, sealed.hash, block, exists);
        });
        outcome?;
        self.changed();
        Ok(())
    }

    /// Checks that this world has room for the contact state of another one.
    ///
    /// # Errors
    /// [`EngineError::BadValue`] if it does not.
    pub fn require_room_for(&self, from: &Self, counterparts: &Counterparts<'_>) -> Result<(), EngineError> {
        let refused = |cause: String| {
            Err(EngineError::BadValue { what: "continue from another world".to_owned(), cause })
        };
        if from.memory.poses.has_travels() && !self.memory.poses.keeps_travels() {
            let cause = "its surfaces move along themselves, and those of this world may not; set `moving_surfaces` in its settings";
            return refused(cause.to_owned());
        }
        let records = from.memory.records_to_carry(counterparts.group_pairs);
        let room = self.memory.records.capacity();
        if records > room {
            let least = records.div_ceil(2);
            return refused(format!(
                "it has {records} contact records, and there is room for {room}; seal with a `contact_capacity` of {least} or \
                 more"
            ));
        }
        let epochs = from.memory.poses.epochs_to_carry(counterparts.pairs);
        let room = self.memory.poses.capacity();
        if epochs > room {
            return refused(format!(
                "its pairs keep {epochs} commit epochs (commits that are the last of some pair), and there is room for {room}; \
                 commit all pairs at once first"
            ));
        }
        Ok(())
    }

    /// Replaces the contact state by that of another world, which must fit
    /// ([`require_room_for`](Self::require_room_for)), and drops the results of the last frame. `poses` are
    /// those of the current states.
    pub fn carry(
        &mut self,
        from: &Self,
        counterparts: &Counterparts<'_>,
        poses: &[Pose],
        keeps_ledger: bool,
    ) -> CarryOutcome {
        self.release_memory();
        self.frame.begin(&self.sealed);
        self.frame.computed = false;
        self.frame.tunnelling = TunnellingEvents::default();
        let frame = self.frame.number;
        let mut carried = CarryOutcome::default();
        write_and_swap(&mut self.memory, &mut self.back_buffers, |old, next| {
            next.copy_from(old);
            carried = next.carry(&from.memory, counterparts, (poses, frame), keeps_ledger);
        });
        self.changed();
        carried
    }

    /// Replaces the surface values.
    pub fn set_tables(&mut self, tables: Vec<SurfaceTable>) {
        self.tables = Arc::new(tables);
        self.frame.input.tables = Arc::clone(&self.tables);
        // The workers get the tables now. Otherwise the next frame would replace theirs, and free the old
        // ones within the frame.
        self.pool.iter().for_each(|pool| pool.set_tables(&self.tables));
        self.changed();
    }

    pub fn worker_starts(&self) -> &[WorkerStart] {
        self.pool.as_ref().map_or(&[], |pool| pool.pool().start_report())
    }

    pub fn thread_work(&self) -> impl Iterator<Item = ThreadWork> + '_ {
        self.pool.iter().flat_map(|pool| pool.pool().work())
    }

    /// Work times per thread, the caller's first: serial work and the thread's share of parallel work.
    pub fn thread_times(&self) -> impl Iterator<Item = WorkTimes> + '_ {
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

    /// Joins the workers; returns the number of workers that did not end in time.
    pub fn end(&mut self) -> usize {
        self.pool.as_mut().map_or(0, WorkerPool::end)
    }

    pub fn memory_report(&self) -> MemoryReport {
        let thread = &self.frame.caller;
        let (arena, scratch) = self.pool.as_ref().map_or((0, 0), WorkerPool::peaks);
        MemoryReport {
            contacts_peak: self.contacts_peak,
            contacts_capacity: self.sealed.record_capacity,
            arena_peak: thread.arena.peak().max(arena),
            arena_capacity: thread.arena.capacity(),
            scratch_peak: thread.scratch.peak().max(scratch),
            scratch_capacity: thread.scratch.capacity(),
        }
    }
}

/// Writes the next contact state into a free back buffer and swaps it with the committed one.
#[inline]
fn write_and_swap(
    memory: &mut Arc<ContactMemory>,
    back_buffers: &mut [Arc<ContactMemory>],
    write: impl FnOnce(&ContactMemory, &mut ContactMemory),
) {
    let free = back_buffers.iter_mut().find(|buffer| Arc::strong_count(buffer) == 1);
    let buffer = free.expect("at most one contact state is held by a worker that is stuck");
    write(memory, Arc::get_mut(buffer).expect("nobody else has it"));
    std::mem::swap(memory, buffer);
}
