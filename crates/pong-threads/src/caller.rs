//! Caller's side of the protocol. The caller opens a phase, runs blocks too, and waits only for blocks that
//! workers have claimed.

use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::{Arc, TryLockError};

use crate::board::{Board, CALM, Done, PARK};
use crate::sync::{LOOKS, Watch, spin_loop, yield_now};
use crate::word::Word;
use crate::worker::{Payload, Shared, YIELD_AFTER_NS};
use crate::{MAX_BLOCKS, Outcome, ThreadWork};

pub struct Caller {
    shared: Arc<Shared>,
    /// Epoch of the last phase that was opened to workers.
    epoch: u64,
    /// The caller's own work in the last phase.
    own: Done,
    /// Number of workers that take part in the last phase.
    workers: usize,
    /// Blocks that workers have claimed since the start.
    handed_out: u64,
    /// True while an alert holds; the next phase ends it.
    alert_stands: bool,
    /// Time at which all workers were last found asleep, ns since the start.
    found_asleep_ns: Option<u64>,
}

impl Caller {
    pub fn new(shared: Arc<Shared>) -> Caller {
        Caller {
            shared,
            epoch: 0,
            own: Done::default(),
            workers: 0,
            handed_out: 0,
            alert_stands: false,
            found_asleep_ns: None,
        }
    }

    /// See [`Pool::has_awake_workers`](crate::Pool::has_awake_workers).
    pub fn has_awake_workers(&self) -> bool {
        self.shared.board.seems_awake()
    }

    /// See [`Pool::has_workers_at_hand`](crate::Pool::has_workers_at_hand).
    pub fn has_workers_at_hand(&mut self) -> bool {
        if self.shared.board.workers() == 0 {
            return false;
        }
        if self.has_awake_workers() {
            return true;
        }
        let now_ns = self.shared.origin.elapsed_ns();
        let earlier_ns = self.found_asleep_ns.replace(now_ns);
        // If phases are closer together than the spin time, a woken worker stays awake between them.
        earlier_ns.is_some_and(|earlier_ns| now_ns - earlier_ns < self.shared.spin_ns)
    }

    /// Runs all blocks of the job, on the caller and all workers.
    pub fn run(&mut self, blocks: u32) -> Outcome {
        let job = Arc::clone(&self.shared.job);
        self.run_beside(blocks, usize::MAX, &mut |blocks| job.run_neighbors(blocks, 0))
    }

    /// Runs all blocks, on the caller and the first `workers` workers. The blocks that the caller claims are
    /// passed to `run`.
    pub fn run_beside(&mut self, blocks: u32, workers: usize, run: &mut dyn FnMut(Range<u32>)) -> Outcome {
        assert!(blocks <= MAX_BLOCKS, "a phase of {blocks} blocks: at most {MAX_BLOCKS}");
        self.own = Done::default();
        self.workers = if blocks > 1 { workers.min(self.shared.board.workers()) } else { 0 };
        if self.workers > 0 { self.run_shared(blocks, run) } else { self.run_alone(blocks, run) }
    }

    fn run_alone(&mut self, blocks: u32, run: &mut dyn FnMut(Range<u32>)) -> Outcome {
        self.shared
            .run_blocks(0..blocks, run, &mut self.own)
            .unwrap_or_else(|payload| resume_unwind(payload));
        Outcome::Complete
    }

    /// Runs a phase with workers. The caller takes its first blocks before the phase opens, so that they need
    /// no atomic operation.
    fn run_shared(&mut self, blocks: u32, run: &mut dyn FnMut(Range<u32>)) -> Outcome {
        self.epoch = Word::next_epoch(self.epoch);
        // Blocks of abandoned phases that still run. They are counted before this phase opens, because
        // afterwards a worker may finish a block that is not yet in `handed_out`.
        let stuck = self.stuck();
        let left = blocks - Board::share_of(blocks, self.workers);
        self.shared.board.open(self.epoch, self.workers, left);
        self.call_workers(left, stuck);
        let own_panic = self.drain(left..blocks, run).err();
        let unclaimed = if own_panic.is_some() { self.shared.board.close(self.epoch) } else { 0 };

        let claimed = blocks - self.own.blocks - unclaimed;
        self.handed_out += u64::from(claimed);
        let (outcome, panicked) = self.wait(claimed);
        if let Some(payload) = own_panic.or_else(|| self.take_panic(panicked)) {
            resume_unwind(payload);
        }
        outcome
    }

    /// Wakes one sleeping worker of the open phase, if fewer workers are awake than the phase can use. The
    /// woken worker wakes others.
    fn call_workers(&mut self, blocks: u32, stuck: u64) {
        self.end_alert();
        let asleep = u64::from(self.shared.board.asleep(self.workers));
        if asleep == 0 {
            return;
        }
        let awake = (self.workers as u64 - asleep).saturating_sub(stuck);
        if u64::from(blocks) > awake {
            self.shared.board.wake(1, self.workers);
        }
    }

    /// Runs the blocks `first`, then claims and runs blocks until none is left. Returns the payload if a
    /// block panics.
    fn drain(&mut self, first: Range<u32>, run: &mut dyn FnMut(Range<u32>)) -> Result<(), Payload> {
        let mut blocks = Some(first);
        while let Some(claimed) = blocks {
            self.shared.run_blocks(claimed, &mut *run, &mut self.own)?;
            blocks = self.shared.board.claim(self.epoch);
        }
        Ok(())
    }

    /// Waits until workers have done `claimed` blocks, or the worker timeout has passed. The second result is
    /// `true` if a worker panicked.
    fn wait(&self, claimed: u32) -> (Outcome, bool) {
        let mut waited = None;
        loop {
            let mut panicked = false;
            for _ in 0..LOOKS {
                let done;
                (done, panicked) = self.shared.board.done_by(self.workers, self.epoch);
                if done == claimed {
                    return (Outcome::Complete, panicked);
                }
                spin_loop();
            }
            let waited_ns = waited.get_or_insert_with(Watch::start).elapsed_ns();
            if waited_ns >= self.shared.worker_timeout_ns {
                return (Outcome::Abandoned, panicked);
            }
            if waited_ns > YIELD_AFTER_NS {
                yield_now();
            }
        }
    }

    /// Returns the payload of a worker's panic in this phase, or a text in its place if another panicking
    /// worker holds the lock; `None` unless `panicked`. The payload of a panic in an abandoned phase is never
    /// returned: it stays until the panic of a later phase replaces it.
    fn take_panic(&self, panicked: bool) -> Option<Payload> {
        if !panicked {
            return None;
        }
        // Does not block, because another panicking worker may hold the lock and not be scheduled.
        match self.shared.panic.try_lock() {
            Ok(mut kept) => kept.take(),
            Err(TryLockError::Poisoned(kept)) => kept.into_inner().take(),
            Err(TryLockError::WouldBlock) => {
                Some((self.epoch, Box::new("several workers panicked at once") as Payload))
            }
        }
        .map(|(_, payload)| payload)
    }

    /// Returns the number of blocks that workers have claimed and not finished. Between phases these are
    /// blocks of abandoned phases that still run.
    pub fn stuck(&self) -> u64 {
        self.handed_out - self.shared.board.finished_by_all()
    }

    /// Returns the number of workers that are parked or about to park.
    #[cfg(test)]
    pub fn asleep(&self) -> usize {
        self.shared.board.asleep(self.shared.board.workers()) as usize
    }

    pub fn work(&self) -> impl Iterator<Item = ThreadWork> + '_ {
        let thread_work = |done: Done| ThreadWork { blocks: done.blocks, busy_ns: done.busy_ns };
        let of_worker = move |thread| match thread <= self.workers {
            true => thread_work(self.shared.board.done(thread, self.epoch)),
            false => ThreadWork::default(),
        };
        std::iter::once(thread_work(self.own)).chain((1..=self.shared.board.workers()).map(of_worker))
    }

    pub fn prewake(&mut self, at_most_ns: u64) {
        let until_ns = self.shared.origin.elapsed_ns().saturating_add(at_most_ns).min(PARK - 1);
        self.shared.board.set_alert(until_ns);
        self.alert_stands = true;
        let workers = self.shared.board.workers();
        if self.shared.board.asleep(workers) > 0 {
            self.shared.board.wake(1, workers);
        }
    }

    pub fn quiesce(&mut self) {
        self.shared.board.set_alert(PARK);
        self.alert_stands = true;
    }

    /// Ends the alert. This is called after a phase opens; if it were called earlier, a worker that finds the
    /// alert over would park just before the phase needs it.
    fn end_alert(&mut self) {
        if self.alert_stands {
            self.shared.board.set_alert(CALM);
            self.alert_stands = false;
        }
    }

    /// Sets the end flag and wakes all sleeping workers. The wake-ups are not limited to the number of
    /// sleepers counted, because another worker may park after the count.
    pub fn end(&mut self) {
        self.shared.board.end();
        let workers = self.shared.board.workers();
        if self.shared.board.asleep(workers) > 0 {
            self.shared.board.wake(u32::MAX, workers);
        }
    }
}
