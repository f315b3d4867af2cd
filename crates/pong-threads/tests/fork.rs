//! After a fork the child has the pool but no workers, as if all workers had been killed.
//!
//! A program of its own: it forks, and only the calling thread continues in the child.
#![cfg(target_os = "linux")]

#[allow(dead_code, reason = "these tests use some of it")]
#[path = "it/common/mod.rs"]
mod common;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::time::{Duration, Instant};

use common::{Count, FOR_EVER, Meet, patient, start};
use pong_threads::{Outcome, Settings};

/// Runs `child` in a forked process and returns its result. A child that hangs is killed.
fn in_a_fork(child: impl FnOnce() -> bool) -> bool {
    // SAFETY: the child runs code of this test only, touches no lock that another thread may have held, and ends
    // without unwinding into the test runner.
    let process = unsafe { libc::fork() };
    assert!(process >= 0, "fork: {}", std::io::Error::last_os_error());
    if process == 0 {
        let succeeds = catch_unwind(AssertUnwindSafe(child)).unwrap_or(false);
        let status = i32::from(!succeeds);
        // SAFETY: ends the child and nothing else.
        unsafe { libc::_exit(status) };
    }
    succeeds(process)
}

fn succeeds(process: libc::pid_t) -> bool {
    let started = Instant::now();
    let mut status = 0;
    // SAFETY: waits for, and kills, the child that this test has made.
    unsafe {
        while libc::waitpid(process, &mut status, libc::WNOHANG) == 0 {
            if started.elapsed() > FOR_EVER {
                libc::kill(process, libc::SIGKILL);
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    libc::WIFEXITED(status) && libc::WEXITSTATUS(status) == 0
}

#[test]
fn without_any_worker_left_the_caller_completes_alone() {
    for asleep in [false, true] {
        let count = Count::new(20);
        let mut pool = start(&count, &patient(3));
        assert_eq!(pool.run(20), Outcome::Complete);
        count.take();
        if asleep {
            pool.quiesce();
            std::thread::sleep(Duration::from_millis(50));
        }
        let completes = in_a_fork(|| {
            let complete = (0..20).all(|_| {
                let outcome = pool.run(20);
                let once = count.runs.iter().all(|runs| runs.swap(0, SeqCst) == 1);
                outcome == Outcome::Complete && once && pool.is_quiet()
            });
            pool.prewake(Duration::from_millis(1));
            pool.quiesce();
            complete && pool.work().map(|thread| thread.blocks).eq([20, 0, 0, 0])
        });
        assert!(completes);
        assert_eq!(pool.run(20), Outcome::Complete, "and the parent has its workers");
        assert_eq!(count.take(), [1; 20]);
    }
}

#[test]
fn the_child_can_drop_the_pool() {
    let mut pool = Some(start(&Count::new(20), &patient(3)));
    assert!(in_a_fork(|| {
        pool.take();
        true
    }));
    assert!(pool.is_some());
}

#[test]
fn a_block_that_was_abandoned_before_the_fork_disturbs_nothing() {
    let held = Arc::new(AtomicBool::new(true));
    let on_worker = {
        let held = held.clone();
        move || common::wait_until("the test lets go", || !held.load(SeqCst))
    };
    let meet = Meet::new(on_worker);
    let settings = Settings { worker_timeout: Duration::from_millis(1), ..patient(1) };
    let mut pool = start(&meet, &settings);
    assert_eq!(pool.run(2), Outcome::Abandoned);
    assert!(!pool.is_quiet());
    assert!(in_a_fork(|| pool.is_quiet()));
    held.store(false, SeqCst);
    common::wait_until("the worker is back", || pool.is_quiet());
}
