//! Jobs and waits shared by several tests.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::SeqCst};
use std::time::{Duration, Instant};

use pong_threads::{Job, Pool, Settings};

/// Long enough for any machine; a test that reaches it has failed.
pub const FOR_EVER: Duration = Duration::from_secs(60);

pub fn wait_until(what: &str, condition: impl Fn() -> bool) {
    let started = Instant::now();
    while !condition() {
        assert!(started.elapsed() < FOR_EVER, "in vain: {what}");
        std::thread::yield_now();
    }
}

/// Settings with exactly this number of workers, even without free cores, and a caller that waits practically
/// for ever.
pub fn patient(workers: usize) -> Settings {
    Settings { workers, oversubscribe: true, worker_timeout: FOR_EVER, ..Settings::default() }
}

pub fn start(job: &Arc<impl Job>, settings: &Settings) -> Pool {
    Pool::start(job.clone(), settings).unwrap()
}

/// Counts how often each block ran, and detects two blocks on one thread at once.
pub struct Count {
    pub runs: Vec<AtomicU32>,
    threads: Vec<AtomicBool>,
}

impl Count {
    pub fn new(blocks: usize) -> Arc<Count> {
        let threads = (0..=pong_threads::MAX_WORKERS).map(|_| AtomicBool::new(false)).collect();
        Arc::new(Count { runs: (0..blocks).map(|_| AtomicU32::new(0)).collect(), threads })
    }

    pub fn take(&self) -> Vec<u32> {
        self.runs.iter().map(|runs| runs.swap(0, SeqCst)).collect()
    }
}

impl Job for Count {
    fn run(&self, block: u32, thread: usize) {
        if thread == 0 {
            // Yields so that workers get their share, even of short blocks.
            std::thread::yield_now();
        }
        assert!(!self.threads[thread].swap(true, SeqCst), "two blocks on thread {thread}");
        self.runs[block as usize].fetch_add(1, SeqCst);
        self.threads[thread].store(false, SeqCst);
    }
}

/// Job for phases of two blocks: the caller's block waits until a worker has the other, so each has one.
pub struct Meet<F> {
    waiting: AtomicBool,
    on_worker: F,
}

impl<F: Fn() + Send + Sync + 'static> Meet<F> {
    /// Creates the job; `on_worker` is run in the worker's block.
    pub fn new(on_worker: F) -> Arc<Meet<F>> {
        Arc::new(Meet { waiting: AtomicBool::new(false), on_worker })
    }
}

impl<F: Fn() + Send + Sync + 'static> Job for Meet<F> {
    fn run(&self, _block: u32, thread: usize) {
        if thread == 0 {
            wait_until("a worker takes part", || self.waiting.swap(false, SeqCst));
        } else {
            self.waiting.store(true, SeqCst);
            (self.on_worker)();
        }
    }
}
