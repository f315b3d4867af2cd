//! Cost of a waiting pool: processor time of the whole process, caller and worker, as a fraction of one core,
//! for frames of empty blocks at 100 Hz.
//!
//! `cargo run --release -p pong-threads --example idle_cost`
//!
//! A system that samples processor time by ticks may report far too little, or the same for every case.

use std::sync::Arc;
use std::time::{Duration, Instant};

use pong_threads::{Job, Pool, Settings};

struct Empty;

impl Job for Empty {
    fn run(&self, _block: u32, _lane: usize) {}
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

/// Runs frames at 100 Hz for 2 s and prints their cost.
fn measure(name: &str, settings: &Settings, after_frame: impl Fn(&mut Pool)) {
    let mut pool = Pool::start(Arc::new(Empty), settings).unwrap();
    let (started, cpu_before) = (Instant::now(), cpu_time());
    for number in 1..=200 {
        let _ = pool.run(16);
        after_frame(&mut pool);
        let next = started + Duration::from_millis(10) * number;
        std::thread::sleep(next.saturating_duration_since(Instant::now()));
    }
    let share = (cpu_time() - cpu_before).as_secs_f64() / started.elapsed().as_secs_f64();
    println!("{name:<40} {} worker {:6.2} % of a core", pool.workers(), share * 100.0);
}

fn main() {
    let pinned = Settings { pin: true, ..Settings::default() };
    let long = Settings { spin: Duration::from_millis(5), ..pinned.clone() };
    measure("spin time 50 us", &pinned, |_| ());
    measure("spin time 5 ms", &long, |_| ());
    measure("spin time 5 ms, quiesced after each frame", &long, Pool::quiesce);
}
