//! Signals belong to the host: no worker takes one that another thread could take.
//!
//! A program of its own: it changes the signal handling of the process.
#![cfg(target_os = "linux")]

#[allow(dead_code, reason = "these tests use some of it")]
#[path = "it/common/mod.rs"]
mod common;

use std::sync::{Arc, Mutex};

use common::{Meet, patient, start};
use pong_threads::Outcome;

/// Signals blocked in the calling thread.
fn blocked() -> Vec<i32> {
    // SAFETY: an all-zero set is valid; the calls access only this set.
    unsafe {
        let mut set: libc::sigset_t = std::mem::zeroed();
        libc::pthread_sigmask(libc::SIG_BLOCK, std::ptr::null(), &mut set);
        (1..=libc::SIGRTMAX()).filter(|signal| libc::sigismember(&set, *signal) == 1).collect()
    }
}

#[test]
fn workers_take_no_signal_but_those_of_their_own_faults() {
    let on_worker = Arc::new(Mutex::new(Vec::new()));
    let told = on_worker.clone();
    let before = blocked();
    let mut pool = start(&Meet::new(move || *told.lock().unwrap() = blocked()), &patient(1));
    assert_eq!(blocked(), before, "the caller's mask is as it was");
    assert_eq!(pool.run(2), Outcome::Complete);

    let own = [libc::SIGSEGV, libc::SIGBUS, libc::SIGFPE, libc::SIGILL, libc::SIGTRAP, libc::SIGSYS];
    // Not blockable; the C library reserves those between 31 and SIGRTMIN.
    let unblockable = [libc::SIGKILL, libc::SIGSTOP];
    let could_go_elsewhere = |signal: &i32| !own.contains(signal) && !unblockable.contains(signal);
    let expected: Vec<i32> =
        (1..32).chain(libc::SIGRTMIN()..=libc::SIGRTMAX()).filter(could_go_elsewhere).collect();
    assert_eq!(*on_worker.lock().unwrap(), expected);
}
