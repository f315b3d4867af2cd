//! What a host in real time relies on: no allocation in a phase, an idle pool that costs next to nothing, a start
//! under SCHED_FIFO that does not hang.
#![cfg(target_os = "linux")]

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::SeqCst};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use common::{Count, FOR_EVER, patient, start};
use pong_threads::{Grant, Outcome, Settings};

/// Counts the calls of all threads while `COUNTING`.
struct Counting;

static COUNTING: AtomicBool = AtomicBool::new(false);
static CALLS: AtomicU64 = AtomicU64::new(0);

// SAFETY: hands every call to the system's allocator unchanged.
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
    an_idle_pool_costs_little();
    a_quiesced_pool_costs_less_than_one_that_spins();
    prewake_keeps_workers_awake_until_the_next_phase();
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
        blocks_of_workers += pool.work().skip(1).map(|lane| lane.blocks).sum::<u32>();
    }
    COUNTING.store(false, SeqCst);
    assert_eq!(CALLS.load(SeqCst), 0);
    println!("no allocation in 3000 phases; workers ran {blocks_of_workers} of 300000 blocks");
}

/// Processor time of this process, all threads.
fn cpu_time() -> Duration {
    // SAFETY: an all-zero rusage is valid, and the call fills it.
    let usage = unsafe {
        let mut usage: libc::rusage = std::mem::zeroed();
        libc::getrusage(libc::RUSAGE_SELF, &mut usage);
        usage
    };
    let time = |t: libc::timeval| Duration::new(t.tv_sec as u64, t.tv_usec as u32 * 1000);
    time(usage.ru_utime) + time(usage.ru_stime)
}

/// Processor time over time while `frame` is called at 100 Hz.
fn load_at_100_hz(frames: u32, mut frame: impl FnMut()) -> f64 {
    let (started, cpu_before) = (Instant::now(), cpu_time());
    for number in 1..=frames {
        frame();
        std::thread::sleep(
            (started + Duration::from_millis(10) * number).saturating_duration_since(Instant::now()),
        );
    }
    (cpu_time() - cpu_before).as_secs_f64() / started.elapsed().as_secs_f64()
}

fn an_idle_pool_costs_little() {
    let count = Count::new(16);
    let mut pool = start(&count, &Settings { pin: true, ..Settings::default() });
    let load = load_at_100_hz(200, || {
        let _ = pool.run(16);
    });
    println!(
        "frames of 16 empty blocks at 100 Hz: {:.2} % of a core, {} worker",
        load * 100.0,
        pool.workers()
    );
    assert!(load < 0.05, "an idle pool takes {load} of a core");
}

fn a_quiesced_pool_costs_less_than_one_that_spins() {
    let long = Settings { spin: Duration::from_millis(5), ..Settings::default() };
    let count = Count::new(2);
    let mut pool = start(&count, &long);
    let spinning = load_at_100_hz(50, || {
        let _ = pool.run(2);
    });
    let quiesced = load_at_100_hz(50, || {
        let _ = pool.run(2);
        pool.quiesce();
    });
    println!(
        "5 ms of spin at 100 Hz: {:.1} % of a core; quiesced {:.1} %",
        spinning * 100.0,
        quiesced * 100.0
    );
    assert!(pool.workers() == 0 || quiesced < spinning);
}

/// The worker has no spin time of its own, so what it takes is by the prewake.
fn prewake_keeps_workers_awake_until_the_next_phase() {
    let count = Count::new(2);
    let mut pool = start(&count, &Settings { spin: Duration::ZERO, ..patient(1) });
    let cpu_over_100_ms = || {
        std::thread::sleep(Duration::from_millis(5));
        let before = cpu_time();
        std::thread::sleep(Duration::from_millis(100));
        cpu_time() - before
    };
    pool.prewake(Duration::from_secs(10));
    let awake = cpu_over_100_ms();
    assert_eq!(pool.run(2), Outcome::Complete);
    let after = cpu_over_100_ms();
    pool.prewake(Duration::from_millis(1));
    let past = cpu_over_100_ms();
    println!(
        "processor time in 100 ms: prewoken {awake:?}, after the phase {after:?}, after the deadline {past:?}"
    );
    assert!(awake > 3 * after && awake > 3 * past);
}

/// The caller has the highest claim to its core, and the worker begins there.
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
