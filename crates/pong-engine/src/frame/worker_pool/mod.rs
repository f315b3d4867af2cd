//! The calling thread and its workers on the blocks of a frame.
//!
//! Workers read a copy of the frame's input and write into contexts of their own, under locks that nobody waits for in
//! the common case. A worker that does not come back from a block keeps its context and the input it reads; the frame
//! then goes on without the workers, alone and with the same results, until that worker has let go.

#[cfg(test)]
mod tests;
mod trials;

use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::input::{Round, WorkerInput};
use crate::frame::run_blocks::run_blocks;
use crate::frame::worker_context::WorkerContext;
use crate::report::WorkTimes;
use crate::scene::Scene;
use crate::sealed::{Sealed, SurfaceTable};
use crate::state::ContactMemory;
use pong_threads::{Job, Outcome, Pool, Settings, StartError};
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, TryLockError};
use std::time::Duration;
use trials::{SharingTrials, WORTH_SHARING_NS};

/// Work below this wakes no worker, unless frames follow each other so closely that it will stay awake, ns: to wake one takes
/// 10 µs and more, and it comes with cold caches.
const WORTH_WAKING_NS: u64 = 60_000;

/// For each so much work there is to be a worker, ns: one more takes longer to begin and to be asked what it has found than it
/// takes off the others.
const WORTH_A_WORKER_NS: u64 = 4_000;

/// Longer than it takes to lay out the blocks of any round.
const LONGEST_LAYOUT: Duration = Duration::from_micros(200);

/// What a contact costs beside its tests, ns.
const CONTACT_NS: u64 = 200;

/// Workers and what they share with the caller.
pub(crate) struct WorkerPool {
    pool: Pool,
    shared: Arc<Shared>,
    /// Rounds that the caller did by itself because a worker had not let go, or did not come back.
    pub timeouts: u64,
    /// Whether the workers were given a frame's input since it was last taken back.
    lent: bool,
    /// Whether the workers were given a round of this frame.
    worked: bool,
    /// What the last round might cost, ns, if it was worth sharing.
    last_cost_ns: u64,
    trials: SharingTrials,
    /// Where the workers' time of this frame's rounds went; zero without a clock.
    times: Vec<WorkTimes>,
}

struct Shared {
    scene: Arc<Scene>,
    sealed: Arc<Sealed>,
    /// Apart from its lock: every claim writes to that.
    lent: RwLock<Box<Lent>>,
    /// One per worker.
    contexts: Vec<Mutex<Box<WorkerContext>>>,
}

/// What the caller lends for a round.
struct Lent {
    input: WorkerInput,
    /// Committed contact state.
    memory: Arc<ContactMemory>,
}

impl Job for Shared {
    fn run(&self, block: u32, context: usize) {
        self.run_neighbors(block..block + 1, context);
    }

    /// On a worker: the caller runs its blocks in its own context.
    fn run_neighbors(&self, blocks: Range<u32>, lane: usize) {
        let lent = self.lent.read().unwrap_or_else(PoisonError::into_inner);
        let Lent { input, memory } = &**lent;
        let mut context = locked(&self.contexts[lane - 1]);
        if context.out.phase != input.phase {
            context.out.begin(input.phase);
            memory.records.fetch();
        }
        self.run_blocks((input, memory), blocks, &mut context);
        // Here and not by the caller, on whose core nothing of it is.
        context.out.finish();
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

/// A context whose owner panicked is still memory: what it holds is thrown away when the next phase begins.
fn locked(context: &Mutex<Box<WorkerContext>>) -> MutexGuard<'_, Box<WorkerContext>> {
    context.lock().unwrap_or_else(PoisonError::into_inner)
}

impl WorkerPool {
    /// Starts the workers.
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
                .map(|lane| Mutex::new(Box::new(WorkerContext::new(sealed, lane, contacts))))
                .collect(),
        });
        let pool = Pool::start(Arc::clone(&shared) as Arc<dyn Job>, settings)?;
        let times = vec![WorkTimes::default(); workers];
        let trials = SharingTrials::NONE;
        Ok(Self { pool, shared, timeouts: 0, lent: false, worked: false, last_cost_ns: 0, trials, times })
    }

    /// How many workers are worth asking for a round of so many blocks whose tests may cost so much, ns; none if it is sooner
    /// done by the caller alone. What touched at the last commit, so many `records`, as a rule touches now, and costs as much
    /// again. Where the cost leaves doubts, trials decide: call [`end_frame`](Self::end_frame) when the frame is done.
    pub fn worth_asking(&mut self, records: usize, blocks: usize, cost_ns: u64) -> usize {
        let cost_ns = cost_ns + records as u64 * CONTACT_NS;
        let worth = cost_ns >= WORTH_SHARING_NS
            && blocks >= 2
            && (self.pool.has_workers_at_hand() || cost_ns >= WORTH_WAKING_NS)
            && self.trials.shares(cost_ns);
        self.last_cost_ns = if worth { cost_ns } else { 0 };
        if worth { self.pool.workers().min(1.max((cost_ns / WORTH_A_WORKER_NS) as usize)) } else { 0 }
    }

    /// Runs the blocks of `input` beside the first so many workers; whether all that was found is there: in `context`, or in
    /// `taken`, a buffer for each worker. If not, the caller does it all again by itself.
    pub fn run_parallel(
        &mut self,
        memory: &Arc<ContactMemory>,
        (input, workers): (&WorkerInput, usize),
        context: &mut WorkerContext,
        taken: &mut [ContactBuffer],
    ) -> bool {
        // A worker that has claimed blocks of an earlier round and not begun with them would run them in this one.
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
        self.gather(input.phase, context, taken)
    }

    /// Takes over what the workers have found in a phase that is complete; whether nothing is missing. As long as the limits are
    /// far, each buffer as it is: to copy a contact takes longer than all else that the caller does with it.
    fn gather(&mut self, phase: u64, context: &mut WorkerContext, taken: &mut [ContactBuffer]) -> bool {
        let out = &mut context.out;
        let (mut found, mut overflowed) = (out.contacts.len(), out.demand.overflowed);
        // To look at the context of one that has done nothing is to wait for a cache line.
        let at_work = || self.pool.work().skip(1).map(|lane| lane.blocks > 0);
        for (other, _) in self.shared.contexts.iter().zip(at_work()).filter(|(_, at_work)| *at_work) {
            let other = locked(other);
            debug_assert_eq!(other.out.phase, phase);
            found += other.out.contacts.len();
            overflowed |= other.out.demand.overflowed;
        }
        if overflowed {
            return false;
        }
        let as_they_are = found <= self.shared.sealed.contact_capacity;
        let mut taken = taken.iter_mut();
        for ((times, other), at_work) in self.times.iter_mut().zip(&self.shared.contexts).zip(at_work()) {
            let taken = taken.next();
            if !at_work {
                continue;
            }
            let mut other = locked(other);
            times.add(&other.out.times);
            match taken {
                Some(taken) if as_they_are && other.out.remembers_all() => {
                    out.counts.add(&other.out.counts);
                    taken.take_over(&mut other.out);
                }
                _ if out.absorb(&other.out) => {}
                _ => return false,
            }
        }
        true
    }

    /// No time has been spent yet. Where the last round was worth waking workers for and all sleep, they are woken now: they are
    /// up when the blocks of this one are laid out. Whom the host has woken is awake for as long as it said.
    pub fn begin_frame(&mut self) {
        if self.last_cost_ns >= WORTH_WAKING_NS && !self.pool.has_awake_workers() {
            self.pool.prewake(LONGEST_LAYOUT);
        }
        if self.worked {
            self.times.fill(WorkTimes::default());
            self.worked = false;
        }
    }

    /// All that depends on who did this frame's rounds is done.
    #[inline]
    pub fn end_frame(&mut self) {
        let Self { pool, worked, trials, .. } = self;
        trials.end_round(|| *worked && pool.work().skip(1).any(|lane| lane.blocks > 0));
    }

    /// Whether the workers were given a round of this frame.
    pub fn has_worked(&self) -> bool {
        self.worked
    }

    /// Where the workers' time of the rounds that were shared out went.
    pub fn times(&self) -> impl Iterator<Item = &WorkTimes> {
        self.times.iter()
    }

    /// Lets go of the contact state that the workers were given, unless one still reads it.
    pub fn release(&mut self, nothing: &Arc<ContactMemory>) {
        if self.lent
            && let Ok(mut lent) = self.shared.lent.try_write()
        {
            lent.memory = Arc::clone(nothing);
            self.lent = false;
        }
    }

    /// Replaces the values of surfaces that the workers were given, unless one still reads them.
    pub fn set_tables(&self, tables: &Arc<Vec<SurfaceTable>>) {
        if let Ok(mut lent) = self.shared.lent.try_write() {
            lent.input.tables = Arc::clone(tables);
        }
    }

    /// Most that the workers' arenas and scratch memories were asked for, as far as they are not in use, bytes.
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

    /// The pool, for what it reports.
    pub fn pool(&self) -> &Pool {
        &self.pool
    }
}
