//! A counting allocator that keeps one count per kind of call, so that a failure names the call.
//!
//! The thread that runs the frames and the world's own workers are counted. Workers are recognised by the
//! registered law that they evaluate.

use pong_testkit::heap::Telling;
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};

thread_local! {
    static COUNTED: Cell<bool> = const { Cell::new(false) };
}
/// True while frames are running.
static WATCHING: AtomicBool = AtomicBool::new(false);
/// Allocator calls, by the host call in progress.
static COUNTS: [AtomicUsize; CALLS.len()] = [const { AtomicUsize::new(0) }; CALLS.len()];
/// Number of counted threads besides the first.
static HELPERS: AtomicUsize = AtomicUsize::new(0);
static CALL: AtomicUsize = AtomicUsize::new(0);
/// One test at a time.
static TURN: Mutex<()> = Mutex::new(());

/// Calls of a host in a frame.
const CALLS: [&str; 15] = [
    "between the calls",
    "set_states",
    "set_state",
    "evaluate",
    "commit",
    "commit_pairs",
    "step",
    "set_pair_enabled",
    "clear_contact_history",
    "save_state",
    "restore_state",
    "contacts_iter",
    "wrench and wrench_common",
    "prewake and quiesce",
    "reports",
];

fn count() {
    // A thread that ends may free memory after its thread-local variables are gone.
    if COUNTED.try_with(Cell::get).unwrap_or(false) && WATCHING.load(Relaxed) {
        COUNTS[CALL.load(Relaxed)].fetch_add(1, Relaxed);
    }
}

#[global_allocator]
static HEAP: Telling = Telling(count);

/// Counts the allocator calls of the calling thread and of every thread that evaluates one of the laws below.
/// Returns the host calls with any, and their counts.
pub fn counted(work: impl FnOnce()) -> Vec<(&'static str, usize)> {
    COUNTS.iter().for_each(|count| count.store(0, Relaxed));
    HELPERS.store(0, Relaxed);
    COUNTED.set(true);
    WATCHING.store(true, Relaxed);
    work();
    WATCHING.store(false, Relaxed);
    COUNTED.set(false);
    let counts = CALLS.iter().zip(&COUNTS).map(|(call, count)| (*call, count.load(Relaxed)));
    counts.filter(|(_, count)| *count > 0).collect()
}

/// Counts the allocator calls of `work` under a name of [`CALLS`].
pub fn during<T>(call: &str, work: impl FnOnce() -> T) -> T {
    CALL.store(CALLS.iter().position(|name| *name == call).expect("a known call"), Relaxed);
    let answer = work();
    CALL.store(0, Relaxed);
    answer
}

pub fn my_turn() -> MutexGuard<'static, ()> {
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Counts the calling thread as well, if frames are running.
pub fn count_this_thread() {
    if WATCHING.load(Relaxed) && !COUNTED.replace(true) {
        HELPERS.fetch_add(1, Relaxed);
    }
}

/// Number of threads counted in the last count, besides the one that ran it.
pub fn helpers() -> usize {
    HELPERS.load(Relaxed)
}
