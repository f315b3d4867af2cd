//! Workers that hang, panic, or no longer exist.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::SeqCst};
use std::time::{Duration, Instant};

use crate::common::{FOR_EVER, Meet, patient, start, wait_until};
use pong_threads::{Job, Outcome, Settings};

fn impatient(workers: usize) -> Settings {
    Settings { worker_timeout: Duration::from_millis(1), ..patient(workers) }
}

/// Job whose first block on a worker hangs while `held` is set.
struct Hang {
    held: AtomicBool,
    hanging: AtomicU32,
    runs: [AtomicU32; 8],
    thread_blocks: [AtomicU32; 4],
}

impl Hang {
    fn new() -> Arc<Hang> {
        Arc::new(Hang {
            held: AtomicBool::new(true),
            hanging: AtomicU32::new(0),
            runs: Default::default(),
            thread_blocks: Default::default(),
        })
    }

    fn take(&self) -> [u32; 8] {
        std::array::from_fn(|block| self.runs[block].swap(0, SeqCst))
    }

    fn hanging(&self) -> u32 {
        self.hanging.load(SeqCst)
    }

    /// Hangs until the test releases it, or a time limit passes.
    fn hang(&self) {
        let started = Instant::now();
        self.hanging.store(1, SeqCst);
        while self.held.load(SeqCst) && started.elapsed() < FOR_EVER {
            std::thread::sleep(Duration::from_micros(100));
        }
        self.hanging.store(0, SeqCst);
    }
}

impl Job for Hang {
    fn run(&self, block: u32, thread: usize) {
        if thread == 0 {
            wait_until("a worker hangs", || self.hanging() == 1 || !self.held.load(SeqCst));
        } else if self.held.load(SeqCst) && self.hanging() == 0 {
            self.hang();
        }
        self.runs[block as usize].fetch_add(1, SeqCst);
        self.thread_blocks[thread].fetch_add(1, SeqCst);
    }
}

#[test]
fn a_worker_that_hangs_costs_one_phase_and_is_used_again_when_it_returns() {
    let hang = Hang::new();
    let mut pool = start(&hang, &impatient(1));
    assert_eq!(pool.run(8), Outcome::Abandoned);
    assert!(!pool.is_quiet());
    // The caller had claimed four of the eight before the worker came, which claimed two of the remaining
    // four.
    assert_eq!(hang.take().iter().sum::<u32>(), 6);

    for _ in 0..100 {
        assert_eq!(pool.run(8), Outcome::Complete, "the caller alone");
        assert_eq!(hang.take(), [1; 8]);
        assert_eq!(pool.work().map(|thread| thread.blocks).collect::<Vec<_>>(), [8, 0]);
        assert!(!pool.is_quiet());
    }

    hang.held.store(false, SeqCst);
    wait_until("the worker is back", || pool.is_quiet());
    assert_eq!(hang.take().iter().sum::<u32>(), 2, "the abandoned blocks themselves");
    let before = hang.thread_blocks[1].load(SeqCst);
    wait_until_used_again(&mut pool, &hang, before);
}

fn wait_until_used_again(pool: &mut pong_threads::Pool, hang: &Hang, before: u32) {
    for _ in 0..1_000_000 {
        pool.prewake(Duration::from_millis(10));
        let outcome = pool.run(8);
        if outcome == Outcome::Abandoned {
            wait_until("a slow worker is back", || pool.is_quiet());
        }
        assert_eq!(hang.take(), [1; 8]);
        if hang.thread_blocks[1].load(SeqCst) > before {
            return;
        }
    }
    panic!("the worker is never used again");
}

#[test]
fn other_workers_go_on_while_one_hangs() {
    let hang = Hang::new();
    let mut pool = start(&hang, &impatient(3));
    assert_eq!(pool.run(8), Outcome::Abandoned);
    hang.take();
    let mut others = 0;
    for _ in 0..1_000_000 {
        let outcome = pool.run(8);
        let work: Vec<u32> = pool.work().map(|thread| thread.blocks).collect();
        others += work[1..].iter().filter(|blocks| **blocks > 0).count();
        assert_eq!(work.iter().sum::<u32>() == 8, outcome == Outcome::Complete);
        if others > 100 {
            break;
        }
        std::thread::yield_now();
    }
    assert!(others > 100);
    hang.held.store(false, SeqCst);
    wait_until("all are back", || pool.is_quiet());
}

#[test]
fn a_pool_with_a_hanging_worker_can_be_dropped() {
    let hang = Hang::new();
    let mut pool = start(&hang, &impatient(2));
    assert_eq!(pool.run(8), Outcome::Abandoned);
    drop(pool);
    assert_eq!(hang.hanging(), 1, "it was not waited for");
    hang.held.store(false, SeqCst);
    wait_until("the worker lets go of the job", || Arc::strong_count(&hang) == 1);
}

#[cfg(target_os = "linux")]
mod a_worker_that_is_not_run {
    use super::*;

    static HELD: AtomicBool = AtomicBool::new(true);
    static CAUGHT: AtomicBool = AtomicBool::new(false);

    extern "C" fn hold(_signal: libc::c_int) {
        CAUGHT.store(true, SeqCst);
        let started = Instant::now();
        while HELD.load(SeqCst) && started.elapsed() < FOR_EVER {
            std::thread::sleep(Duration::from_micros(100));
        }
    }

    /// The worker is in no block: a signal handler keeps it from running, as another thread on its core
    /// would.
    #[test]
    fn does_not_keep_the_pool_from_ending() {
        let worker = Arc::new(AtomicU32::new(0));
        let told = worker.clone();
        // SAFETY: a system call without arguments; it returns the id of the calling thread.
        let meet = Meet::new(move || told.store(unsafe { libc::gettid() } as u32, SeqCst));
        let mut pool = start(&meet, &patient(1));
        assert_eq!(pool.run(2), Outcome::Complete);
        // SAFETY: a handler for a signal that nothing else here uses, sent to the worker only.
        unsafe {
            libc::signal(libc::SIGTRAP, hold as extern "C" fn(libc::c_int) as libc::sighandler_t);
            libc::syscall(libc::SYS_tgkill, libc::getpid(), worker.load(SeqCst), libc::SIGTRAP);
        }
        wait_until("the worker is in the handler", || CAUGHT.load(SeqCst));
        assert_eq!(pool.end(), 1, "workers left behind");
        drop(pool);
        assert!(Arc::strong_count(&meet) > 1, "what it may still read lives");
        HELD.store(false, SeqCst);
        wait_until("the worker ends", || Arc::strong_count(&meet) == 1);
    }
}

#[test]
fn dropping_a_pool_ends_its_workers() {
    let meet = Meet::new(|| {});
    for _ in 0..50 {
        let mut pool = start(&meet, &patient(3));
        assert_eq!(pool.run(2), Outcome::Complete);
        drop(pool);
        assert_eq!(Arc::strong_count(&meet), 1);
    }
}

#[test]
fn a_panic_on_a_worker_goes_on_in_the_caller_and_the_pool_lives() {
    let panics = Arc::new(AtomicBool::new(true));
    let armed = panics.clone();
    let meet = Meet::new(move || assert!(!armed.swap(false, SeqCst), "thrown on a worker"));
    let mut pool = start(&meet, &patient(2));
    let payload = catch_unwind(AssertUnwindSafe(|| pool.run(2))).unwrap_err();
    assert_eq!(*payload.downcast::<&str>().unwrap(), "thrown on a worker");
    assert!(pool.is_quiet());
    for _ in 0..100 {
        assert_eq!(pool.run(2), Outcome::Complete);
    }
}

#[test]
fn a_panic_on_the_caller_closes_the_phase() {
    struct Throws(AtomicU32);
    impl Job for Throws {
        fn run(&self, _block: u32, thread: usize) {
            self.0.fetch_add(1, SeqCst);
            assert!(thread != 0, "thrown on the caller");
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    let throws = Arc::new(Throws(AtomicU32::new(0)));
    let mut pool = start(&throws, &patient(2));
    for _ in 0..20 {
        catch_unwind(AssertUnwindSafe(|| pool.run(10_000))).unwrap_err();
        assert!(pool.is_quiet());
        let ran = throws.0.swap(0, SeqCst);
        assert!(ran < 10_000);
        std::thread::sleep(Duration::from_millis(2));
        assert_eq!(throws.0.load(SeqCst), 0, "blocks of a closed phase still run");
    }
}

#[test]
fn a_panic_in_an_abandoned_block_does_not_reach_a_later_phase() {
    let held = Arc::new(AtomicBool::new(true));
    let on_worker = {
        let held = held.clone();
        move || {
            if held.load(SeqCst) {
                wait_until("the test lets go", || !held.load(SeqCst));
                panic!("thrown after the phase");
            }
        }
    };
    let mut pool = start(&Meet::new(on_worker), &impatient(1));
    assert_eq!(pool.run(2), Outcome::Abandoned);
    held.store(false, SeqCst);
    wait_until("the worker is back", || pool.is_quiet());
    for _ in 0..100 {
        let _ = pool.run(2);
        wait_until("a slow worker is back", || pool.is_quiet());
    }
}
