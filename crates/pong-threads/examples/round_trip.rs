//! Round trip of one phase between two cores, compared with the lower bound: one word passed between two
//! threads.
//!
//!     cargo run --release -p pong-threads --example round_trip
//!
//! All cases take turns in one run. The times are wall-clock nanoseconds including the clock; the ratios
//! exclude it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use core_affinity::CoreId;
use crossbeam_utils::CachePadded;
use pong_threads::{Job, Outcome, Pool, Settings};

const TURNS: usize = 40;
const SAMPLES: usize = 5_000;

fn main() {
    println!("on all cores");
    crowded();
    let Some((here, there)) = two_cores() else {
        println!("one core only: nothing to measure");
        return;
    };
    hot(here, there);
    parked(there);
    println!("\nall on one core");
    crowded();
}

/// Binds this thread to the first core of the mask; returns it and the second.
fn two_cores() -> Option<(usize, usize)> {
    let cores = core_affinity::get_core_ids()?;
    let (first, second) = (cores.first()?.id, cores.get(1)?.id);
    core_affinity::set_for_current(CoreId { id: first });
    Some((first, second))
}

fn pinned(there: usize) -> Settings {
    Settings { workers: 1, pin: true, cores: vec![there], ..Settings::default() }
}

// ---- a worker that is awake

fn hot(here: usize, there: usize) {
    let mut times = [const { Vec::new() }; 5];
    let mut ratios = Vec::new();
    let mut ball = PingPong::start(there);
    let meet = Arc::new(Meet::default());
    let mut meet_pool = Pool::start(meet.clone(), &pinned(there)).unwrap();
    let mut empty_pool = Pool::start(Arc::new(Empty), &pinned(there)).unwrap();
    println!("\ncaller on core {here}, {}", meet_pool.start_report()[0]);

    for turn in 0..TURNS {
        sample(&mut times[0], || {});
        ball.play(|ball| sample(&mut times[1], || ball.round_trip()));
        awake(&mut meet_pool, |pool| sample(&mut times[2], || complete(pool, 2)));
        awake(&mut empty_pool, |pool| {
            sample(&mut times[3], || complete(pool, 2));
            sample(&mut times[4], || complete(pool, 16));
        });
        let of_turn = |of: usize| Percentiles::new(times[of][turn * SAMPLES..].to_vec()).p50;
        ratios.push((of_turn(2) - of_turn(0)) / (of_turn(1) - of_turn(0)));
    }
    assert_eq!(meet.met.load(Ordering::Relaxed), meet.waited.load(Ordering::Relaxed), "one block each");
    println!("{}", Percentiles::HEAD);
    let names = [
        "the clock itself",
        "ping-pong of one word",
        "phase, one block each",
        "phase, 2 empty blocks",
        "phase, 16 empty blocks",
    ];
    let rows: Vec<Percentiles> = times.into_iter().map(Percentiles::new).collect();
    for (name, row) in names.iter().zip(&rows) {
        row.print(name);
    }
    print_ratios(&mut ratios);
}

fn print_ratios(ratios: &mut [f64]) {
    ratios.sort_by(f64::total_cmp);
    let (least, middle, most) = (ratios[0], ratios[ratios.len() / 2], ratios[ratios.len() - 1]);
    println!(
        "phase with one block each over ping-pong, medians of a turn without the clock, {} turns: {middle:.2} \
         [{least:.2}..{most:.2}]",
        ratios.len()
    );
}

/// Runs `measure` with the workers of `pool` awake, and lets them sleep afterwards.
fn awake(pool: &mut Pool, measure: impl FnOnce(&mut Pool)) {
    pool.prewake(Duration::from_millis(100));
    thread::sleep(Duration::from_micros(300));
    measure(pool);
    pool.quiesce();
    thread::sleep(Duration::from_micros(300));
}

fn complete(pool: &mut Pool, blocks: u32) {
    while pool.run(blocks) == Outcome::Abandoned {
        // Another thread has the worker's core: its block must end before the next phase can be measured.
        while !pool.is_quiet() {
            thread::yield_now();
        }
    }
}

/// Job whose block on the caller ends when the worker has begun its own, so neither can run both.
#[derive(Default)]
struct Meet {
    met: CachePadded<AtomicU64>,
    waited: CachePadded<AtomicU64>,
}

impl Job for Meet {
    fn run(&self, _block: u32, thread: usize) {
        if thread == 1 {
            self.met.store(self.met.load(Ordering::Relaxed) + 1, Ordering::Release);
            return;
        }
        let waited = self.waited.load(Ordering::Relaxed) + 1;
        while self.met.load(Ordering::Acquire) < waited {
            std::hint::spin_loop();
        }
        self.waited.store(waited, Ordering::Relaxed);
    }
}

struct Empty;

impl Job for Empty {
    fn run(&self, _block: u32, _lane: usize) {}
}

/// Word that goes to another thread and back.
struct PingPong {
    shared: Arc<Ball>,
    thread: Option<JoinHandle<()>>,
    sent: u64,
}

#[derive(Default)]
struct Ball {
    word: CachePadded<AtomicU64>,
    playing: CachePadded<AtomicBool>,
    over: AtomicBool,
}

impl PingPong {
    fn start(core: usize) -> PingPong {
        let shared = Arc::new(Ball::default());
        let theirs = shared.clone();
        let thread = thread::spawn(move || {
            core_affinity::set_for_current(CoreId { id: core });
            theirs.answer();
        });
        PingPong { shared, thread: Some(thread), sent: 0 }
    }

    fn play(&mut self, measure: impl FnOnce(&mut PingPong)) {
        self.shared.playing.store(true, Ordering::Release);
        self.thread.as_ref().unwrap().thread().unpark();
        self.round_trip();
        measure(self);
        self.shared.playing.store(false, Ordering::Release);
    }

    fn round_trip(&mut self) {
        self.sent += 2;
        self.shared.word.store(self.sent - 1, Ordering::Release);
        while self.shared.word.load(Ordering::Acquire) != self.sent {
            std::hint::spin_loop();
        }
    }
}

impl Ball {
    fn answer(&self) {
        while !self.over.load(Ordering::Acquire) {
            while self.playing.load(Ordering::Acquire) {
                self.answer_some();
            }
            thread::park();
        }
    }

    fn answer_some(&self) {
        for _ in 0..64 {
            let word = self.word.load(Ordering::Acquire);
            if word % 2 == 1 {
                self.word.store(word + 1, Ordering::Release);
            }
            std::hint::spin_loop();
        }
    }
}

impl Drop for PingPong {
    fn drop(&mut self) {
        self.shared.over.store(true, Ordering::Release);
        let thread = self.thread.take().unwrap();
        thread.thread().unpark();
        thread.join().unwrap();
    }
}

// ---- a worker that sleeps

fn parked(there: usize) {
    let mut pool = Pool::start(Arc::new(Empty), &pinned(there)).unwrap();
    let mut times = Vec::new();
    for _ in 0..2_000 {
        thread::sleep(Duration::from_millis(1));
        let started = Instant::now();
        complete(&mut pool, 16);
        times.push(started.elapsed().as_nanos() as u64);
    }
    Percentiles::new(times).print("16 empty, worker parked");
}

// ---- more threads than cores

/// Blocks of some microseconds each.
struct Work;

impl Job for Work {
    fn run(&self, block: u32, _lane: usize) {
        let mut x = u64::from(block);
        for _ in 0..5_000 {
            x = std::hint::black_box(x.wrapping_mul(6364136223846793005).wrapping_add(1));
        }
    }
}

fn crowded() {
    println!("32 blocks of work; abandoned phases are not repeated\n{}", Percentiles::HEAD);
    for workers in [0, 1, 3, 8, 16] {
        let settings = Settings { workers, oversubscribe: true, ..Settings::default() };
        let mut pool = Pool::start(Arc::new(Work), &settings).unwrap();
        let (mut times, mut abandoned) = (Vec::new(), 0);
        for _ in 0..2_000 {
            let started = Instant::now();
            abandoned += u32::from(pool.run(32) == Outcome::Abandoned);
            times.push(started.elapsed().as_nanos() as u64);
        }
        Percentiles::new(times).print(&format!("{workers} workers, {abandoned} abandoned"));
    }
}

// ---- figures

fn sample(times: &mut Vec<u64>, mut what: impl FnMut()) {
    for _ in 0..SAMPLES {
        let started = Instant::now();
        what();
        times.push(started.elapsed().as_nanos() as u64);
    }
}

struct Percentiles {
    min: f64,
    p50: f64,
    p99: f64,
    p999: f64,
    max: f64,
}

impl Percentiles {
    const HEAD: &str = "ns                              min       p50       p99     p99.9       max";

    fn new(mut times: Vec<u64>) -> Percentiles {
        times.sort_unstable();
        let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize] as f64;
        Percentiles { min: at(0.0), p50: at(0.5), p99: at(0.99), p999: at(0.999), max: at(1.0) }
    }

    fn print(&self, name: &str) {
        let Percentiles { min, p50, p99, p999, max } = self;
        println!("{name:<25}{min:>10}{p50:>10}{p99:>10}{p999:>10}{max:>10}");
    }
}
