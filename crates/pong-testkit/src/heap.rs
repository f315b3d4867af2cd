//! An allocator that counts its calls by thread: for tests that code does not allocate.
//!
//! ```
//! #[global_allocator]
//! static HEAP: pong_testkit::heap::Telling = pong_testkit::heap::COUNTING;
//!
//! assert_eq!(pong_testkit::heap::calls_during(|| drop(std::hint::black_box(Box::new(1)))), 2);
//! ```
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The system's allocator, with a function that is called before every call. That function must not allocate.
pub struct Telling(pub fn());

/// Counts the calls of each thread.
pub const COUNTING: Telling = Telling(count);

thread_local! {
    static CALLS: Cell<usize> = const { Cell::new(0) };
}

/// Number of calls to the allocator, allocations and deallocations, by the calling thread since it began.
pub fn calls() -> usize {
    CALLS.get()
}

/// Calls of the calling thread to the allocator while `work` runs.
pub fn calls_during(work: impl FnOnce()) -> usize {
    let before = calls();
    work();
    calls() - before
}

fn count() {
    // A thread that ends may free memory after its counter is destroyed.
    let _ = CALLS.try_with(|calls| calls.set(calls.get() + 1));
}

// SAFETY: every call is passed to `System` unchanged.
unsafe impl GlobalAlloc for Telling {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        (self.0)();
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        (self.0)();
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}
