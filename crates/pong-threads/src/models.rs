//! Models for loom, which runs the protocol's own code under every interleaving of its threads, at small
//! sizes.
//!
//!     RUSTFLAGS="--cfg loom" cargo test -p pong-threads --lib --release models
//!
//! Loom runs each model once per order of accesses and per value that a load may return. It fails on a data
//! race, a failed assertion, or a deadlock. Each block is a cell whose accesses loom watches. So a block that
//! runs twice at once, or a caller that reads a cell too early, is reported as a data race.

use std::ops::Range;
use std::sync::{Arc, Mutex};

use loom::cell::UnsafeCell;
use loom::sync::atomic::{AtomicBool, Ordering};
use loom::thread::{self, JoinHandle};

use crate::board::Board;
use crate::caller::Caller;
use crate::sync::Watch;
use crate::worker::{Shared, Worker};
use crate::{Job, Outcome};

/// One cell per block; running a block adds 1 to its cell.
struct Cells(Vec<UnsafeCell<u32>>);

// SAFETY: loom watches the accesses to the cells and fails on a race.
unsafe impl Sync for Cells {}

impl Cells {
    fn new(blocks: u32) -> Arc<Cells> {
        Arc::new(Cells((0..blocks).map(|_| UnsafeCell::new(0)).collect()))
    }

    fn add_one(&self, block: u32) {
        // SAFETY: as above.
        self.0[block as usize].with_mut(|cell| unsafe { *cell += 1 });
    }

    fn get(&self, block: usize) -> u32 {
        // SAFETY: as above.
        self.0[block].with(|cell| unsafe { *cell })
    }

    /// Checks that the first `blocks` cells were incremented once and the others not, and resets all.
    fn expect_once_each(&self, blocks: usize) {
        for block in 0..self.0.len() {
            assert_eq!(self.get(block), u32::from(block < blocks), "block {block}");
            // SAFETY: as above.
            self.0[block].with_mut(|cell| unsafe { *cell = 0 });
        }
    }
}

impl Job for Cells {
    fn run(&self, block: u32, _lane: usize) {
        self.add_one(block);
    }
}

/// Worker timeout that never passes, because loom's clock ticks once per read.
const PATIENT: u64 = u64::MAX;

struct Model {
    caller: Caller,
    threads: Vec<JoinHandle<()>>,
}

impl Model {
    fn start(job: Arc<dyn Job>, workers: usize, spin_ns: u64, worker_timeout_ns: u64) -> Model {
        let shared = Arc::new(Shared {
            board: Board::new(workers),
            job,
            spin_ns,
            worker_timeout_ns,
            clock: None,
            origin: Watch::start(),
            panic: Mutex::new(None),
        });
        let serve = |thread| {
            let shared = shared.clone();
            thread::spawn(move || Worker::new(shared, thread).serve())
        };
        Model { threads: (1..=workers).map(serve).collect(), caller: Caller::new(shared.clone()) }
    }

    /// Ends the workers. If one of them misses the end flag, all threads wait, and loom reports a deadlock.
    fn end(mut self) {
        self.caller.end();
        self.threads.into_iter().for_each(|thread| thread.join().unwrap());
    }
}

fn explore(preemptions: usize, model: impl Fn() + Sync + Send + 'static) {
    let mut builder = loom::model::Builder::new();
    builder.preemption_bound = Some(preemptions);
    builder.max_branches = 10_000;
    builder.check(model);
}

/// A worker that is late for a phase finds the next phase open, with another number of blocks.
#[test]
fn a_late_worker_enters_no_closed_phase() {
    explore(3, || {
        let cells = Cells::new(3);
        let mut model = Model::start(cells.clone(), 1, 0, PATIENT);
        for blocks in [3, 2] {
            assert_eq!(model.caller.run(blocks), Outcome::Complete);
            cells.expect_once_each(blocks as usize);
        }
        model.end();
    });
}

#[test]
fn two_workers_and_the_caller_run_each_block_once() {
    let two_workers = |phases: &'static [u32]| {
        move || {
            let cells = Cells::new(3);
            let mut model = Model::start(cells.clone(), 2, 0, PATIENT);
            for blocks in phases {
                assert_eq!(model.caller.run(*blocks), Outcome::Complete);
                cells.expect_once_each(*blocks as usize);
            }
            model.end();
        }
    };
    explore(1, two_workers(&[3, 2]));
    // Half of the time of all models: a run of the night.
    if std::env::var("PONG_TESTS").as_deref() == Ok("night") {
        explore(2, two_workers(&[3]));
    }
}

/// Runs one phase with the first of two workers, then one with both workers. The worker that does not take
/// part in the first phase claims nothing in it, and takes part in the second.
#[test]
fn a_phase_for_some_is_left_alone_by_the_others() {
    explore(1, || {
        let cells = Cells::new(3);
        let mut model = Model::start(cells.clone(), 2, 0, PATIENT);
        for workers in [1, 2] {
            let own = &mut |blocks: Range<u32>| blocks.for_each(|block| cells.add_one(block));
            assert_eq!(model.caller.run_beside(3, workers, own), Outcome::Complete);
            cells.expect_once_each(3);
            assert!(model.caller.work().skip(1 + workers).all(|thread| thread.blocks == 0));
        }
        model.end();
    });
}

/// A worker that parks at the moment when the pool ends or a phase opens is still woken.
#[test]
fn no_wake_up_is_lost() {
    explore(3, || Model::start(Cells::new(0), 2, 0, PATIENT).end());
    explore(3, || {
        let job = Arc::new(NeedsWorker { called: AtomicBool::new(false) });
        let mut model = Model::start(job, 1, 0, PATIENT);
        assert_eq!(model.caller.run(2), Outcome::Complete);
        model.end();
    });
}

/// Job whose block on the caller ends only after a worker has begun the other block.
struct NeedsWorker {
    called: AtomicBool,
}

impl Job for NeedsWorker {
    fn run(&self, _block: u32, thread: usize) {
        if thread != 0 {
            return self.called.store(true, Ordering::Release);
        }
        while !self.called.load(Ordering::Acquire) {
            thread::yield_now();
        }
    }
}

/// Memory that the blocks of an abandoned phase may still use is not touched until the pool is quiet, as in
/// the engine.
#[test]
fn an_abandoned_block_counts_for_no_later_phase() {
    explore(3, || {
        let job = Arc::new(ByPhase::default());
        let mut model = Model::start(job.clone(), 1, 0, 0);
        for phase in 0..3 {
            job.phase.store(phase, Ordering::Release);
            let outcome = model.caller.run(2);
            if outcome == Outcome::Complete {
                job.phases[phase].expect_once_each(2);
            }
        }
        while model.caller.stuck() > 0 {
            thread::yield_now();
        }
        for cells in &job.phases {
            assert!((0..2).all(|block| cells.get(block) <= 1));
        }
        model.end();
    });
}

/// Separate cells for each of three phases, so that an abandoned block may write late.
struct ByPhase {
    phase: loom::sync::atomic::AtomicUsize,
    phases: [Arc<Cells>; 3],
}

impl Default for ByPhase {
    fn default() -> ByPhase {
        ByPhase { phase: Default::default(), phases: std::array::from_fn(|_| Cells::new(2)) }
    }
}

impl Job for ByPhase {
    fn run(&self, block: u32, _lane: usize) {
        self.phases[self.phase.load(Ordering::Acquire)].add_one(block);
    }
}

#[test]
fn prewake_and_quiesce_disturb_no_phase() {
    explore(2, || {
        let cells = Cells::new(2);
        let mut model = Model::start(cells.clone(), 1, 0, PATIENT);
        model.caller.prewake(2);
        assert_eq!(model.caller.run(2), Outcome::Complete);
        cells.expect_once_each(2);
        model.caller.quiesce();
        assert_eq!(model.caller.run(2), Outcome::Complete);
        cells.expect_once_each(2);
        model.end();
    });
}
