//! Counters, printed when the program ends.

use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering};

/// Inputs of this process.
static INPUTS: AtomicU64 = AtomicU64::new(0);
/// Inputs that the engine accepted.
static ACCEPTED: AtomicU64 = AtomicU64::new(0);
/// Calls of the C interface.
static CALLS: AtomicU64 = AtomicU64::new(0);
/// Calls that succeeded.
static SUCCEEDED: AtomicU64 = AtomicU64::new(0);
/// Frames that were computed.
static FRAMES: AtomicU64 = AtomicU64::new(0);
static AT_END: Once = Once::new();

/// Counts an input.
pub fn input() {
    AT_END.call_once(|| {
        // SAFETY: the function takes nothing and does not unwind.
        unsafe { libc::atexit(tell) };
    });
    INPUTS.fetch_add(1, Ordering::Relaxed);
}

/// Counts an accepted input.
pub fn accepted() {
    ACCEPTED.fetch_add(1, Ordering::Relaxed);
}

/// Counts a call of the C interface.
pub fn call(succeeded: bool) {
    CALLS.fetch_add(1, Ordering::Relaxed);
    SUCCEEDED.fetch_add(u64::from(succeeded), Ordering::Relaxed);
}

/// Counts a frame.
pub fn frame() {
    FRAMES.fetch_add(1, Ordering::Relaxed);
}

extern "C" fn tell() {
    let [inputs, accepted, calls, succeeded, frames] =
        [&INPUTS, &ACCEPTED, &CALLS, &SUCCEEDED, &FRAMES].map(|count| count.load(Ordering::Relaxed));
    eprintln!(
        "counts: {inputs} inputs, {accepted} accepted, {frames} frames, {calls} C calls, {succeeded} succeeded"
    );
}
