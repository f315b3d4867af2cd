//! Guarantees for a real-time host: no allocation in a phase, and a start under SCHED_FIFO that does not
//! hang.
#![cfg(target_os = "linux")]

#[allow(dead_code, reason = "these tests use some of it")]
#[path = "it/common/mod.rs"]
mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::SeqCst};
use std::sync::mpsc::channel;
use std::time::Duration;

use common::{Count, FOR_EVER, patient, start};
use pong_threads::{Grant, Outcome, Settings};

/// Allocator that counts the calls of all threads while `COUNTING` is set.
struct Counting;

static COUNTING: AtomicBool = AtomicBool::new(false);
static CALLS: AtomicU64 = AtomicU64::new(0);

// SAFETY: passes every call to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        CALLS.fetch_add(u64::from(COUNTING.load(SeqCst)), SeqCst);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        CALLS.fetch_add(u64::from(COUNTING.load(SeqCst)), SeqCst);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn main() {
    phases_do_not_allocate();
    a_start_under_fifo_does_not_hang();
}

fn phases_do_not_allocate() {
    let count = Count::new(100);
    let mut pool = start(&count, &patient(3));
    let mut blocks_of_workers = 0;
    COUNTING.store(true, SeqCst);
    for turn in 0..3000 {
        match turn % 3 {
            0 => pool.prewake(Duration::from_micros(100)),
            1 => pool.quiesce(),
            _ => {}
        }
        assert_eq!(pool.run(100), Outcome::Complete);
        blocks_of_workers += pool.work().skip(1).map(|thread| thread.blocks).sum::<u32>();
    }
    COUNTING.store(false, SeqCst);
    assert_eq!(CALLS.load(SeqCst), 0);
    println!("no allocation in 3000 phases; workers ran {blocks_of_workers} of 300000 blocks");
}

/// The caller has the highest priority on its core, and the worker starts on that core.
fn a_start_under_fifo_does_not_hang() {
    let (done, is_done) = channel();
    std::thread::spawn(move || {
        let permitted = on_one_core_under_fifo();
        let settings = Settings { fifo_priority: Some(40), ..patient(2) };
        let count = Count::new(20);
        let mut pool = start(&count, &settings);
        for report in pool.start_report() {
            println!("caller under SCHED_FIFO: {permitted}; {report}");
            assert_eq!(permitted, report.fifo_priority == Grant::Granted(40));
        }
        for _ in 0..100 {
            assert_eq!(pool.run(20), Outcome::Complete);
            assert_eq!(count.take(), [1; 20]);
        }
        drop(pool);
        done.send(()).unwrap();
    });
    is_done.recv_timeout(FOR_EVER).expect("the start, phases and the end of a pool under SCHED_FIFO");
}

fn on_one_core_under_fifo() -> bool {
    let core = core_affinity::get_core_ids().unwrap()[0];
    core_affinity::set_for_current(core);
    // SAFETY: an all-zero sched_param is valid, and the call reads it only.
    unsafe {
        let mut parameters: libc::sched_param = std::mem::zeroed();
        parameters.sched_priority = 40;
        libc::pthread_setschedparam(libc::pthread_self(), libc::SCHED_FIFO, &parameters) == 0
    }
}
