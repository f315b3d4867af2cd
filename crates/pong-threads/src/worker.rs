//! Worker thread: waits for a phase, claims and runs blocks until none is left, and waits again.

use std::any::Any;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};

use crate::Job;
use crate::board::{Board, CALM, Done, PARK};
use crate::sync::{LOOKS, Watch, mutant, park, spin_loop, yield_now};
use crate::word::Word;

/// Payload of a caught panic.
pub type Payload = Box<dyn Any + Send>;

/// State shared by the caller and its workers.
pub struct Shared {
    pub board: Board,
    pub job: Arc<dyn Job>,
    pub spin_ns: u64,
    pub worker_timeout_ns: u64,
    /// The host's clock for busy times, in ns.
    pub clock: Option<fn() -> u64>,
    /// Origin of the times of alerts.
    pub origin: Watch,
    /// First panic of the latest phase in which a worker panicked, with the epoch of that phase, until the
    /// caller takes it. The caller takes it only if a tally of the current phase reports a panic. So the
    /// panic of an abandoned phase alone is never raised.
    pub panic: Mutex<Option<(u64, Payload)>>,
}

impl Shared {
    /// Passes `blocks` to `run` and adds them to `done`. If a block panics, the panic is caught and its
    /// payload returned; the blocks that it skips count as done.
    pub fn run_blocks(
        &self,
        blocks: Range<u32>,
        run: impl FnOnce(Range<u32>),
        done: &mut Done,
    ) -> Result<(), Payload> {
        let started_ns = self.clock.map(|clock| clock());
        let count = blocks.end - blocks.start;
        let result = catch_unwind(AssertUnwindSafe(|| run(blocks)));
        if let (Some(clock), Some(started_ns)) = (self.clock, started_ns) {
            done.busy_ns += clock().saturating_sub(started_ns);
        }
        done.blocks += count;
        done.panicked |= result.is_err();
        result
    }

    fn keep_panic(&self, epoch: u64, payload: Payload) {
        let mut kept = self.panic.lock().unwrap_or_else(PoisonError::into_inner);
        keep_latest(&mut kept, epoch, payload);
    }
}

/// Keeps the first panic of the latest phase, because a late panic of an earlier phase must not replace it.
fn keep_latest(kept: &mut Option<(u64, Payload)>, epoch: u64, payload: Payload) {
    if kept.as_ref().is_none_or(|(kept_epoch, _)| *kept_epoch < epoch) {
        *kept = Some((epoch, payload));
    }
}

/// Waiting time, ns, after which a thread, worker or caller, yields its core between two reads, because a
/// thread with work may need the core. If other cores are free, yielding costs a fraction of a microsecond.
pub const YIELD_AFTER_NS: u64 = 5_000;

pub struct Worker {
    shared: Arc<Shared>,
    /// Index of the worker, from 1.
    thread: usize,
    /// Blocks finished since the start.
    finished: u64,
}

impl Worker {
    pub fn new(shared: Arc<Shared>, thread: usize) -> Worker {
        shared.board.introduce(thread);
        Worker { shared, thread, finished: 0 }
    }

    /// Runs phases until the end flag is set.
    pub fn serve(&mut self) {
        let mut seen = 0;
        loop {
            let word = self.wait(seen);
            seen = word.epoch();
            if self.thread <= word.workers() {
                self.work(seen);
            }
            if word.flag() {
                return;
            }
        }
    }

    /// Claims and runs blocks of phase `epoch` until none is left.
    fn work(&mut self, epoch: u64) {
        let shared = &*self.shared;
        let mut done = Done::default();
        while let Some(blocks) = shared.board.claim(epoch) {
            self.finished += u64::from(blocks.end - blocks.start);
            let run = |blocks| shared.job.run_neighbors(blocks, self.thread);
            if let Err(payload) = shared.run_blocks(blocks, run, &mut done) {
                shared.keep_panic(epoch, payload);
            }
            shared.board.record(self.thread, epoch, done, self.finished);
        }
    }

    /// Waits for a phase other than `seen`, or for the end flag, and returns the claim word.
    fn wait(&self, seen: u64) -> Word {
        loop {
            if let Some(word) = self.spin(seen) {
                return word;
            }
            self.sleep(seen);
        }
    }

    /// Spins until there is a new phase or the end flag, and returns the claim word; `None` once the worker
    /// should park. The clock is first read after [`LOOKS`] reads without news.
    fn spin(&self, seen: u64) -> Option<Word> {
        let mut idle = None;
        loop {
            for _ in 0..LOOKS {
                let news = self.shared.board.news(seen);
                if news.is_some() {
                    return news;
                }
                spin_loop();
            }
            let idle = idle.get_or_insert_with(Watch::start);
            if !self.stays_awake(idle) {
                return None;
            }
            if idle.elapsed_ns() > YIELD_AFTER_NS {
                yield_now();
            }
        }
    }

    fn stays_awake(&self, idle: &Watch) -> bool {
        let alert = self.shared.board.alert();
        alert != PARK && (idle.elapsed_ns() < self.shared.spin_ns || self.is_alerted(alert))
    }

    fn is_alerted(&self, alert: u64) -> bool {
        alert != CALM && alert != PARK && self.shared.origin.elapsed_ns() < alert
    }

    /// Parks until woken. Does not park if a phase, the end flag or an alert has come since the worker last
    /// looked.
    fn sleep(&self, seen: u64) {
        let board = &self.shared.board;
        board.lie_down(self.thread);
        let has_news = board.news(seen).is_some() || self.is_alerted(board.alert());
        if !has_news || mutant("sleep_unseen") {
            park();
        }
        board.get_up(self.thread);
        board.wake_others(self.is_alerted(board.alert()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_panics_the_first_of_the_latest_phase_is_kept() {
        let mut kept = None;
        for (epoch, payload) in [(3, "early"), (5, "first"), (5, "second"), (4, "late")] {
            keep_latest(&mut kept, epoch, Box::new(payload));
        }
        assert_eq!(*kept.unwrap().1.downcast::<&str>().unwrap(), "first");
    }
}
