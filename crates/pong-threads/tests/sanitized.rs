//! Test for ThreadSanitizer, which detects unordered memory accesses. `ci/threads` builds it so; an ordinary
//! run checks the results only. With the argument `race` it makes a race that must be detected.

use std::cell::UnsafeCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use pong_threads::{Job, Outcome, Pool, Settings};

const BLOCKS: u32 = 12;

/// Plain memory, as an engine uses it: blocks read what the caller wrote, and the reverse.
struct Plain {
    input: UnsafeCell<u64>,
    outputs: Vec<UnsafeCell<u64>>,
    /// True if all blocks write the first output.
    race: bool,
    /// True if blocks of workers take longer than the worker timeout.
    slow: AtomicBool,
}

// SAFETY: each block writes its own output, and the caller accesses memory only when no block can run. This
// is the property under test.
unsafe impl Sync for Plain {}

impl Plain {
    fn new(race: bool) -> Arc<Plain> {
        let outputs = (0..BLOCKS).map(|_| UnsafeCell::new(0)).collect();
        Arc::new(Plain { input: UnsafeCell::new(0), outputs, race, slow: AtomicBool::new(false) })
    }

    fn set_input(&self, input: u64) {
        // SAFETY: called when no block can run.
        unsafe { *self.input.get() = input }
    }

    fn output(&self, block: u32) -> u64 {
        // SAFETY: called when no block can run.
        unsafe { *self.outputs[block as usize].get() }
    }
}

impl Job for Plain {
    fn run(&self, block: u32, thread: usize) {
        match thread {
            // Yields so that workers get their share, even of short blocks.
            0 => std::thread::yield_now(),
            _ if self.slow.load(Ordering::Relaxed) => std::thread::sleep(Duration::from_micros(300)),
            _ => {}
        }
        let place = if self.race { 0 } else { block as usize };
        // SAFETY: no other block writes there, unless the race is wanted.
        unsafe { *self.outputs[place].get() = *self.input.get() + u64::from(block) }
    }
}

fn phases(plain: &Arc<Plain>, workers: usize, worker_timeout: Duration) -> (u32, u32) {
    let settings = Settings { workers, oversubscribe: true, worker_timeout, ..Settings::default() };
    let mut pool = Pool::start(plain.clone(), &settings).unwrap();
    let (mut abandoned, mut of_workers) = (0, 0);
    for turn in 0..600 {
        prepare(&mut pool, turn);
        plain.set_input(turn);
        if pool.run(BLOCKS) == Outcome::Abandoned {
            abandoned += 1;
            while !pool.is_quiet() {
                std::thread::yield_now();
            }
        }
        for block in (0..BLOCKS).filter(|_| !plain.race) {
            assert_eq!(plain.output(block), turn + u64::from(block));
        }
        of_workers += pool.work().skip(1).map(|thread| thread.blocks).sum::<u32>();
    }
    (abandoned, of_workers)
}

fn prepare(pool: &mut Pool, turn: u64) {
    match turn % 5 {
        0 => pool.quiesce(),
        1 => std::thread::sleep(Duration::from_micros(turn)),
        2 => pool.prewake(Duration::from_micros(turn)),
        _ => {}
    }
}

fn main() {
    let race = std::env::args().any(|argument| argument == "race");
    for workers in [1, 2, 3] {
        let plain = Plain::new(race);
        let (_, of_workers) = phases(&plain, workers, Duration::from_secs(60));
        println!("{workers} workers ran {of_workers} of {} blocks", 600 * BLOCKS);
        plain.slow.store(true, Ordering::Relaxed);
        let (abandoned, _) = phases(&plain, workers, Duration::ZERO);
        println!("{workers} workers, a worker timeout of nothing: {abandoned} of 600 phases abandoned");
    }
}
