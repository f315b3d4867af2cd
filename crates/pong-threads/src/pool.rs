//! Pool of workers: starts the workers, runs the caller's side of the protocol, and ends the workers.

use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::thread::{self, JoinHandle, Thread};
use std::time::{Duration, Instant};

use crate::board::Board;
use crate::caller::Caller;
use crate::place::{cores_of_workers, settle};
use crate::sync::Watch;
use crate::system::without_signals;
use crate::worker::{Shared, Worker};
use crate::{Job, Outcome, Settings, ThreadWork, WorkerStart};

/// Workers that share phases with one calling thread.
///
/// Dropping the pool ends the workers, as [`end`](Self::end) does. Workers handle no signals
/// ([`without_signals`](crate::system::without_signals)).
pub struct Pool {
    caller: Caller,
    threads: Vec<JoinHandle<()>>,
    start_report: Vec<WorkerStart>,
    /// Start barrier, kept until the pool ends. Otherwise the last worker to drop its reference would free
    /// the memory during the first phases.
    started: Arc<StartBarrier>,
    worker_timeout: Duration,
    /// Id of the process that started the workers; threads do not survive a `fork`.
    process: u32,
}

/// Time limit for the start of a pool. If a new thread has not run by then, another thread keeps it off its
/// core.
pub const LONGEST_START: Duration = Duration::from_secs(10);

/// Time limit for the end of a pool in which no worker is inside a block. Each worker then only needs to be
/// scheduled.
pub const LONGEST_FAREWELL: Duration = Duration::from_secs(1);

/// Error of a pool's start: a thread could not be created, or the system did not run it.
#[derive(Debug)]
pub struct StartError {
    /// Index of the worker for which the thread was meant, from 1.
    pub thread: usize,
    /// Error reported by the system.
    pub source: std::io::Error,
}

impl fmt::Display for StartError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { thread, source } = self;
        match source.kind() {
            std::io::ErrorKind::TimedOut => write!(
                out,
                "worker {thread} was not run within {} s of its start: another thread keeps its core; ask for fewer workers, \
                 or for a core or a priority that is free",
                LONGEST_START.as_secs()
            ),
            _ => write!(out, "no thread for worker {thread}: {source}; ask for fewer workers"),
        }
    }
}

impl std::error::Error for StartError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.source)
    }
}

impl Pool {
    /// Starts the workers and returns the pool once each worker is bound and has reported, after
    /// [`LONGEST_START`] at most. The caller sleeps meanwhile and must not spin: a new thread may have the
    /// core and the priority of the calling thread, and under SCHED_FIFO would then never run.
    ///
    /// # Errors
    /// [`StartError`] if a thread cannot be created or does not run within [`LONGEST_START`]. The workers
    /// started before it have then been ended.
    pub fn start(job: Arc<dyn Job>, settings: &Settings) -> Result<Pool, StartError> {
        let cores = cores_of_workers(settings);
        let shared = Arc::new(Shared {
            board: Board::new(cores.len()),
            job,
            spin_ns: in_ns(settings.spin),
            worker_timeout_ns: in_ns(settings.worker_timeout),
            clock: settings.clock,
            origin: Watch::start(),
            panic: Mutex::new(None),
        });
        let mut pool = Pool {
            caller: Caller::new(shared.clone()),
            threads: Vec::with_capacity(cores.len()),
            start_report: Vec::new(),
            started: Arc::new(StartBarrier::new(cores.len())),
            worker_timeout: settings.worker_timeout,
            process: std::process::id(),
        };
        for (worker, core) in cores.iter().enumerate() {
            let thread = start_worker(&shared, worker + 1, *core, settings.fifo_priority, &pool.started);
            // On an error the pool is dropped, which ends the workers already running.
            pool.threads.push(thread.map_err(|source| StartError { thread: worker + 1, source })?);
        }
        pool.start_report = pool.started.wait_for_all(LONGEST_START)?;
        Ok(pool)
    }

    /// Returns the number of workers, without the caller.
    pub fn workers(&self) -> usize {
        self.threads.len()
    }

    /// Returns `true` if it is worth sharing a short phase. That is so if a worker is awake, or if the
    /// previous call was so recent (within [`Settings::spin`]) that a woken worker would stay awake between
    /// phases. Otherwise waking a worker costs each phase more than it saves.
    ///
    /// Call this before each phase that is short compared with a wake-up. If it returns `false`, do the work
    /// on the calling thread.
    pub fn has_workers_at_hand(&mut self) -> bool {
        self.caller.has_workers_at_hand()
    }

    /// Returns `true` if some worker was awake a moment ago. This is a hint for speed only.
    pub fn has_awake_workers(&self) -> bool {
        self.caller.has_awake_workers()
    }

    /// Runs blocks 0 to `blocks` − 1 of the job, the last first, on the caller and on the workers that are
    /// awake in time.
    ///
    /// If a block panics, its panic is resumed on the calling thread, once the claimed blocks of other
    /// threads have ended or the worker timeout has passed. Blocks that were claimed together with the
    /// panicking block are skipped.
    ///
    /// # Panics
    ///
    /// If `blocks` exceeds [`MAX_BLOCKS`](crate::MAX_BLOCKS), or if a block panics.
    pub fn run(&mut self, blocks: u32) -> Outcome {
        self.caller.run(blocks)
    }

    /// Runs a phase like [`run`](Self::run), but with the first `workers` workers only, because more workers
    /// would slow a small phase down. The blocks that the caller claims are passed to `run` instead of the
    /// job, so `run` can use memory that no worker shares. `run` gets a range of neighbouring blocks, as in
    /// [`Job::run_neighbors`].
    ///
    /// # Panics
    ///
    /// As for [`run`](Self::run), or if the function `run` panics.
    pub fn run_beside(&mut self, blocks: u32, workers: usize, run: &mut dyn FnMut(Range<u32>)) -> Outcome {
        self.caller.run_beside(blocks, workers, run)
    }

    /// Returns `true` if no block of an abandoned phase is still running. Only then may the output of such
    /// blocks be read.
    pub fn is_quiet(&self) -> bool {
        self.caller.stuck() == 0 || self.is_forked()
    }

    /// Wakes the workers, which then stay awake until a phase opens or `at_most` has passed. Call this about
    /// 100 µs before a frame that follows the previous one by more than [`Settings::spin`].
    pub fn prewake(&mut self, at_most: Duration) {
        self.caller.prewake(in_ns(at_most));
    }

    /// Lets the workers park at once, for example when the simulation is paused. The next phase wakes them.
    pub fn quiesce(&mut self) {
        self.caller.quiesce();
    }

    /// Returns the start report of each worker: core and priority, or why they were refused.
    pub fn start_report(&self) -> &[WorkerStart] {
        &self.start_report
    }

    /// Returns the work of each thread in the last phase, the caller first.
    pub fn work(&self) -> impl Iterator<Item = ThreadWork> + '_ {
        self.caller.work()
    }

    fn is_forked(&self) -> bool {
        self.process != std::process::id()
    }

    /// Ends the workers and returns how many had not ended in time. The time limit is
    /// [`Settings::worker_timeout`] if a worker is inside a block of an abandoned phase, otherwise
    /// [`LONGEST_FAREWELL`]. A worker that has not ended in time ends when the system runs it, and keeps the
    /// job alive until then.
    pub fn end(&mut self) -> usize {
        if self.is_forked() {
            // The threads belong to the parent process, so waiting for them would never end.
            self.threads.drain(..).for_each(std::mem::forget);
            return 0;
        }
        self.caller.end();
        self.wait_for_the_end(if self.is_quiet() { LONGEST_FAREWELL } else { self.worker_timeout });
        let mut left = 0;
        for thread in self.threads.drain(..) {
            if thread.is_finished() {
                // A finished thread has nothing left to run, so `join` returns at once. The worker caught the
                // panics of its blocks, so `join` has none to report.
                let _ = thread.join();
            } else {
                left += 1;
            }
        }
        left
    }

    fn wait_for_the_end(&self, at_most: Duration) {
        let started = Instant::now();
        while !self.threads.iter().all(JoinHandle::is_finished) && started.elapsed() < at_most {
            thread::sleep(Duration::from_micros(50));
        }
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.end();
    }
}

fn in_ns(duration: Duration) -> u64 {
    u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX)
}

fn start_worker(
    shared: &Arc<Shared>,
    thread: usize,
    core: Option<usize>,
    fifo_priority: Option<u8>,
    started: &Arc<StartBarrier>,
) -> std::io::Result<JoinHandle<()>> {
    let (shared, started) = (shared.clone(), started.clone());
    let work = move || {
        let report = settle(thread, core, fifo_priority);
        let mut worker = Worker::new(shared, thread);
        started.report(report);
        worker.serve();
    };
    without_signals(|| thread::Builder::new().name(format!("pong-worker-{thread}")).spawn(work))
}

/// Start barrier: the workers report to it, and the caller sleeps until all have reported or the time limit
/// passes.
struct StartBarrier {
    reports: Box<[OnceLock<WorkerStart>]>,
    missing: AtomicUsize,
    caller: Thread,
}

impl StartBarrier {
    fn new(workers: usize) -> StartBarrier {
        let reports = (0..workers).map(|_| OnceLock::new()).collect();
        StartBarrier { reports, missing: AtomicUsize::new(workers), caller: thread::current() }
    }

    fn report(&self, report: WorkerStart) {
        let slot = &self.reports[report.thread - 1];
        slot.set(report).expect("one worker per thread");
        if self.missing.fetch_sub(1, Ordering::AcqRel) == 1 {
            self.caller.unpark();
        }
    }

    fn wait_for_all(&self, at_most: Duration) -> Result<Vec<WorkerStart>, StartError> {
        let started = Instant::now();
        while self.missing.load(Ordering::Acquire) > 0 {
            let waited = started.elapsed();
            if waited >= at_most {
                let absent = self.reports.iter().position(|report| report.get().is_none()).unwrap_or(0);
                return Err(StartError { thread: absent + 1, source: std::io::ErrorKind::TimedOut.into() });
            }
            thread::park_timeout(at_most - waited);
        }
        Ok(self.reports.iter().filter_map(|report| report.get().cloned()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_worker_that_is_never_run_ends_the_start_with_an_error_that_names_it() {
        let started = StartBarrier::new(2);
        let report = settle(1, None, None);
        started.report(report);
        let error = started.wait_for_all(Duration::from_millis(1)).unwrap_err();
        assert_eq!(error.thread, 2);
        assert!(error.to_string().contains("worker 2 was not run within 10 s"), "{error}");
    }

    struct Idle;

    impl Job for Idle {
        fn run(&self, _block: u32, _lane: usize) {}
    }

    const HOUR: Duration = Duration::from_secs(3600);

    fn pool(spin: Duration) -> Pool {
        let settings =
            Settings { workers: 3, oversubscribe: true, spin, worker_timeout: HOUR, ..Settings::default() };
        Pool::start(Arc::new(Idle), &settings).unwrap()
    }

    /// Waits until `workers` workers sleep; fails after a time that is ample on any machine and far below
    /// [`HOUR`].
    fn wait_until_asleep(pool: &Pool, workers: usize) {
        let started = Instant::now();
        while pool.caller.asleep() != workers {
            assert!(started.elapsed() < HOUR / 60, "{} of {workers} sleep", pool.caller.asleep());
            thread::sleep(Duration::from_micros(100));
        }
    }

    #[test]
    fn workers_park_when_their_spin_time_is_over() {
        let mut pool = pool(Duration::from_micros(50));
        for _ in 0..20 {
            wait_until_asleep(&pool, 3);
            assert_eq!(pool.run(100), Outcome::Complete);
        }
    }

    #[test]
    fn quiesced_workers_park_before_their_spin_time_is_over() {
        let mut pool = pool(HOUR);
        for _ in 0..20 {
            assert_eq!(pool.run(100), Outcome::Complete);
            pool.quiesce();
            wait_until_asleep(&pool, 3);
        }
    }

    /// The spin time is zero, so only the prewake keeps the workers awake.
    #[test]
    fn prewoken_workers_stay_awake_until_the_next_phase_or_the_deadline() {
        let mut pool = pool(Duration::ZERO);
        for _ in 0..5 {
            wait_until_asleep(&pool, 3);
            pool.prewake(HOUR);
            wait_until_asleep(&pool, 0);
            thread::sleep(Duration::from_millis(2));
            assert_eq!(pool.caller.asleep(), 0);
            assert_eq!(pool.run(100), Outcome::Complete);
            wait_until_asleep(&pool, 3);
            pool.prewake(Duration::from_millis(1));
            wait_until_asleep(&pool, 3);
        }
    }

    #[test]
    fn workers_are_at_hand_while_one_is_awake_or_if_one_that_is_woken_would_stay_so() {
        let mut awake = pool(HOUR);
        assert_eq!(awake.run(100), Outcome::Complete);
        assert!(awake.has_workers_at_hand());
        awake.quiesce();
        wait_until_asleep(&awake, 3);
        // The first call cannot know how soon the next phase comes; the second comes within the spin time of
        // an hour.
        assert!(!awake.has_workers_at_hand());
        assert!(awake.has_workers_at_hand());

        let mut sleepy = pool(Duration::ZERO);
        wait_until_asleep(&sleepy, 3);
        assert!((0..3).all(|_| !sleepy.has_workers_at_hand()));
        sleepy.prewake(HOUR);
        wait_until_asleep(&sleepy, 0);
        assert!(sleepy.has_workers_at_hand());

        let alone = Settings { workers: 0, spin: HOUR, ..Settings::default() };
        let mut alone = Pool::start(Arc::new(Idle), &alone).unwrap();
        assert!((0..3).all(|_| !alone.has_workers_at_hand()));
    }
}
