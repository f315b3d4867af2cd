//! A counting global allocator: bytes held and allocations. The counts are exact, unlike resident memory.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The system's allocator with counters; a program makes it its `#[global_allocator]`.
pub struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);
static CALLS: AtomicUsize = AtomicUsize::new(0);

/// Bytes held now.
pub fn held() -> usize {
    HELD.load(Relaxed)
}

/// Most bytes held since the last [`reset_peak`].
pub fn peak() -> usize {
    PEAK.load(Relaxed)
}

/// Restarts the peak at the bytes held now.
pub fn reset_peak() {
    PEAK.store(held(), Relaxed);
}

/// Allocations so far.
pub fn calls() -> usize {
    CALLS.load(Relaxed)
}

fn took(bytes: usize) {
    CALLS.fetch_add(1, Relaxed);
    PEAK.fetch_max(HELD.fetch_add(bytes, Relaxed) + bytes, Relaxed);
}

// SAFETY: every call is passed to `System` unchanged; the counters touch no memory of the caller.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        took(layout.size());
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        HELD.fetch_sub(layout.size(), Relaxed);
        took(size);
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

/// Bytes held now by the C library's counters, which include engines in C.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn held_in_c() -> usize {
    /// `struct mallinfo2` of glibc 2.33 and later.
    #[repr(C)]
    struct Account {
        arena: usize,
        free_chunks: usize,
        fast_chunks: usize,
        mapped_count: usize,
        mapped_bytes: usize,
        unused: usize,
        fast_bytes: usize,
        used_bytes: usize,
        free_bytes: usize,
        top_bytes: usize,
    }
    unsafe extern "C" {
        fn mallinfo2() -> Account;
    }
    // SAFETY: reads the C library's own counters.
    let account = unsafe { mallinfo2() };
    account.used_bytes + account.mapped_bytes
}
