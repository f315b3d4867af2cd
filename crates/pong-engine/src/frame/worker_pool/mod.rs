//! Runs the blocks of a frame on the calling thread and the workers.
//!
//! Workers read a copy of the frame's input and write into their own contexts, under locks that are normally
//! free. A stuck worker keeps the locks of its context and of the input. Until it has released them, the
//! caller computes the frames alone, with the same results.

#[cfg(test)]
mod tests;

use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::input::{Round, WorkerInput};
use crate::frame::run_blocks::run_blocks;
use crate::frame::worker_context::WorkerContext;
use crate::report::WorkTimes;
use crate::scene::Scene;
use crate::seal::{Sealed, SurfaceTable};
use crate::state::ContactMemory;
use pong_threads::{Job, Outcome, Pool, Settings, StartError};
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, TryLockError};
use std::time::Duration;

/// Cost below which the caller works alone, ns.
const WORTH_SHARING_NS: u64 = 5_000;

/// Cost below which no worker is woken, ns, unless frames follow each other so closely that workers stay
/// awake. A wake-up takes 10 µs and more, and the worker starts with cold caches.
const WORTH_WAKING_NS: u64 = 60_000;

/// Work per worker, ns: with less, one more worker costs more to start and to collect results from than it
/// saves.
const WORTH_A_WORKER_NS: u64 = 4_000;

/// Time for which workers that were woken before the layout of a round stay awake: longer than a layout
/// should take.
const LONGEST_LAYOUT: Duration = Duration::from_micros(200);

/// Cost of a contact besides its tests, ns.
const CONTACT_NS: u64 = 200;

/// The workers and the data they share with the caller.
pub(crate) struct WorkerPool {
    pool: Pool,
    shared: Arc<Shared>,
    /// Rounds that the caller ran alone because a worker was stuck or timed out.
    pub timeouts: u64,
    /// True while the workers' input holds a contact state.
    lent: bool,
    /// True if the workers took part in this frame.
    worked: bool,
    /// Estimated cost of the last round, ns; 0 if it was not shared.
    last_cost_ns: u64,
    /// Time per kind of work of the workers in this frame; zero without a clock.
    times: Vec<WorkTimes>,
}

struct Shared {
    scene: Arc<Scene>,
    sealed: Arc<Sealed>,
    /// Boxed, to keep it off the cache line of the lock, which every claim writes.
    lent: RwLock<Box<Lent>>,
    /// One context per worker.
    contexts: Vec<Mutex<Box<WorkerContext>>>,
}

/// Input that the caller lends to the workers for a round.
struct Lent {
    input: WorkerInput,
    /// Committed contact state.
    memory: Arc<ContactMemory>,
}

impl Job for Shared {
    fn run(&self, block: u32, context: usize) {
        self.run_neighbors(block..block + 1, context);
    }

    /// Runs on a worker; the caller runs its blocks in its own context.
    fn run_neighbors(&self, blocks: Range<u32>, thread: usize) {
        let lent = self.lent.read().unwrap_or_else(PoisonError::into_inner);
        let Lent { input, memory } = &**lent;
        let mut context = locked(&self.contexts[thread - 1]);
        if context.out.phase != input.phase {
            context.out.begin(input.phase);
        }
        self.run_blocks((input, memory), blocks, &mut context);
        // Friction is computed here, on the worker, because its core's cache holds the contacts.
        context.out.flush();
    }
}

impl Lent {
    fn copy_from(&mut self, input: &WorkerInput, memory: &Arc<ContactMemory>) {
        self.input.copy_from(input);
        self.memory = Arc::clone(memory);
    }
}

impl Shared {
    fn run_blocks(
        &self,
        (input, memory): (&WorkerInput, &ContactMemory),
        blocks: Range<u32>,
        context: &mut WorkerContext,
    ) {
        let round = Round { scene: &self.scene, sealed: &self.sealed, memory, input };
        run_blocks(&round, blocks.start as usize..blocks.end as usize, context);
    }
}

/// Locks a context, even if a thread has panicked while it held the lock: the contents are discarded at the
/// next phase.
fn locked(context: &Mutex<Box<WorkerContext>>) -> MutexGuard<'_, Box<WorkerContext>> {
    context.lock().unwrap_or_else(PoisonError::into_inner)
}

impl WorkerPool {
    /// Starts the workers. `nothing` is an empty contact state, which they hold outside frames.
    pub fn start(
        scene: &Arc<Scene>,
        sealed: &Arc<Sealed>,
        input: WorkerInput,
        nothing: &Arc<ContactMemory>,
        settings: &Settings,
    ) -> Result<Self, StartError> {
        let workers = settings.workers_granted();
        let contacts = sealed.limits.worker_contacts(workers + 1);
        let shared = Arc::new(Shared {
            scene: Arc::clone(scene),
            sealed: Arc::clone(sealed),
            lent: RwLock::new(Box::new(Lent { input, memory: Arc::clone(nothing) })),
            contexts: (1..=workers)
                .map(|thread| Mutex::new(Box::new(WorkerContext::new(sealed, thread, contacts))))
                .collect(),
        });
        let pool = Pool::start(Arc::clone(&shared) as Arc<dyn Job>, settings)?;
        let times = vec![WorkTimes::default(); workers];
        Ok(Self { pool, shared, timeouts: 0, lent: false, worked: false, last_cost_ns: 0, times })
    }

    /// Number of workers worth using for a round with this many blocks and test cost, ns; 0 if the caller
    /// alone is faster. Each of the `records` of the last commit adds the cost of a contact.
    pub fn worth_asking(&mut self, records: usize, blocks: usize, cost_ns: u64) -> usize {
        let cost_ns = cost_ns + records as u64 * CONTACT_NS;
        let worth = cost_ns >= WORTH_SHARING_NS
            && blocks >= 2
            && (self.pool.has_workers_at_hand() || cost_ns >= WORTH_WAKING_NS);
        self.last_cost_ns = if worth { cost_ns } else { 0 };
        if worth { self.pool.workers().min(1.max((cost_ns / WORTH_A_WORKER_NS) as usize)) } else { 0 }
    }

    /// Runs the blocks of `input` on the caller and the first `workers` workers. Returns true if all results
    /// are in `context` or, per worker, in `back_buffers`. If it returns false, the caller has to run all
    /// blocks alone.
    pub fn run_parallel(
        &mut self,
        memory: &Arc<ContactMemory>,
        (input, workers): (&WorkerInput, usize),
        context: &mut WorkerContext,
        back_buffers: &mut [ContactBuffer],
    ) -> bool {
        // A worker may have claimed blocks of an earlier round and not started them. It would run blocks of
        // this round in their place, so the pool must be quiet first.
        if !self.pool.is_quiet() {
            self.timeouts += 1;
            return false;
        }
        (self.lent, self.worked) = (true, true);
        match self.shared.lent.try_write() {
            Ok(mut lent) => lent.copy_from(input, memory),
            Err(TryLockError::Poisoned(lent)) => lent.into_inner().copy_from(input, memory),
            Err(TryLockError::WouldBlock) => {
                self.timeouts += 1;
                return false;
            }
        }
        context.out.shares = true;
        let own = &mut |blocks| self.shared.run_blocks((input, memory), blocks, context);
        let outcome = self.pool.run_beside(input.blocks.len() as u32, workers, own);
        context.out.shares = false;
        if outcome == Outcome::Abandoned {
            self.timeouts += 1;
            return false;
        }
        self.gather(input.phase, context, back_buffers)
    }

    /// Collects the workers' results of a complete phase; returns false if there was no room for all of them.
    /// If the contacts are within the capacity, buffers are swapped where there are back buffers, because
    /// copying a contact costs more than anything else that the caller does with it.
    fn gather(
        &mut self,
        phase: u64,
        context: &mut WorkerContext,
        back_buffers: &mut [ContactBuffer],
    ) -> bool {
        let out = &mut context.out;
        let (mut found, mut overflowed) = (out.contacts.len(), out.demand.overflowed);
        // Skip workers without blocks: even to look at their contexts costs a cache miss.
        let at_work = || self.pool.work().skip(1).map(|thread| thread.blocks > 0);
        for (other, _) in self.shared.contexts.iter().zip(at_work()).filter(|(_, at_work)| *at_work) {
            let other = locked(other);
            debug_assert_eq!(other.out.phase, phase);
            found += other.out.contacts.len();
            overflowed |= other.out.demand.overflowed;
        }
        if overflowed {
            return false;
        }
        let may_swap = found <= self.shared.sealed.contact_capacity;
        let mut back_buffers = back_buffers.iter_mut();
        for ((times, other), at_work) in self.times.iter_mut().zip(&self.shared.contexts).zip(at_work()) {
            let back_buffer = back_buffers.next();
            if !at_work {
                continue;
            }
            let mut other = locked(other);
            times.add(&other.out.times);
            match back_buffer {
                Some(back_buffer) if may_swap => {
                    out.counts.add(&other.out.counts);
                    back_buffer.move_from(&mut other.out);
                }
                _ if out.merge(&other.out) => {}
                _ => return false,
            }
        }
        true
    }

    /// Resets the times. If the last round was worth waking workers for and all of them sleep, wakes them
    /// now, so that they are awake when the blocks have been laid out. Workers that are awake are left alone,
    /// because the host may have woken them for longer.
    pub fn begin_frame(&mut self) {
        if self.last_cost_ns >= WORTH_WAKING_NS && !self.pool.has_awake_workers() {
            self.pool.prewake(LONGEST_LAYOUT);
        }
        if self.worked {
            self.times.fill(WorkTimes::default());
            self.worked = false;
        }
    }

    /// Returns true if the workers took part in this frame.
    pub fn has_worked(&self) -> bool {
        self.worked
    }

    /// Times of the workers in shared rounds, by kind of work.
    pub fn times(&self) -> impl Iterator<Item = &WorkTimes> {
        self.times.iter()
    }

    /// Releases the workers' contact state, unless a worker still reads it.
    pub fn release(&mut self, nothing: &Arc<ContactMemory>) {
        if self.lent
            && let Ok(mut lent) = self.shared.lent.try_write()
        {
            lent.memory = Arc::clone(nothing);
            self.lent = false;
        }
    }

    /// Replaces the workers' surface tables, unless a worker still reads them.
    pub fn set_tables(&self, tables: &Arc<Vec<SurfaceTable>>) {
        if let Ok(mut lent) = self.shared.lent.try_write() {
            lent.input.tables = Arc::clone(tables);
        }
    }

    /// Peak use of an arena and of a scratch memory, bytes: the largest of all workers. Contexts in use are
    /// skipped.
    pub fn peaks(&self) -> (usize, usize) {
        let free = self.shared.contexts.iter().filter_map(|context| context.try_lock().ok());
        free.fold((0, 0), |(arena, scratch), context| {
            (arena.max(context.arena.peak()), scratch.max(context.scratch.peak()))
        })
    }

    /// See [`Pool::prewake`].
    pub fn prewake(&mut self, at_most: Duration) {
        self.pool.prewake(at_most);
    }

    /// See [`Pool::quiesce`].
    pub fn quiesce(&mut self) {
        self.pool.quiesce();
    }

    /// See [`Pool::end`].
    pub fn end(&mut self) -> usize {
        self.pool.end()
    }

    /// The pool, for reports.
    pub fn pool(&self) -> &Pool {
        &self.pool
    }
}
