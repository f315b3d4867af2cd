//! Wake-up latency of threads, measured under the present load of the machine.

use pong_threads::{Grant, Job, Outcome, Pool, Settings};
use serde::Serialize;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Upper bounds of the bins of a histogram, in µs; one more bin has the rest.
pub const BIN_BOUNDS_US: [u64; 10] = [10, 20, 50, 100, 200, 500, 1_000, 2_000, 5_000, 10_000];
/// Sleep time of a frame at 1 kHz.
const PERIOD: Duration = Duration::from_millis(1);
/// Time after which a worker is of no use in a frame of 1 ms.
const LONGEST_WAIT: Duration = Duration::from_millis(5);
/// Priority above everything that is not real-time, and below threaded interrupts (50).
const FIFO_PRIORITY: u8 = 40;

/// The two kinds of sleep that are measured: without and with a real-time priority.
const SLEEPS: [&str; 2] = if cfg!(target_os = "linux") {
    ["clock_nanosleep", "clock_nanosleep, SCHED_FIFO"]
} else {
    ["sleep", "sleep, SCHED_FIFO"]
};

/// Times from the moment at which a thread should run to the moment at which it did.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Latency {
    /// The kind of wake-up.
    pub what: &'static str,
    /// Number of samples.
    pub samples: usize,
    /// Number of times that the thread did not come within 5 ms.
    pub missed: usize,
    /// Median, µs.
    pub median_us: f64,
    /// 99th percentile, µs.
    pub p99_us: f64,
    /// Maximum, µs.
    pub largest_us: f64,
    /// Number of samples from the previous bound up to, but not including, each of [`BIN_BOUNDS_US`]; the
    /// last bin has the rest.
    pub bins: [usize; BIN_BOUNDS_US.len() + 1],
}

impl Latency {
    /// Statistics of samples in ns.
    fn of(what: &'static str, mut samples: Vec<u64>, missed: usize) -> Self {
        samples.sort_unstable();
        let quantile = |part: f64| {
            // The smallest sample that is not below this share of all (nearest rank).
            let rank = (part * samples.len() as f64).ceil() as usize;
            samples.get(rank.saturating_sub(1)).map_or(0.0, |ns| *ns as f64 / 1e3)
        };
        let mut bins = [0; BIN_BOUNDS_US.len() + 1];
        for ns in &samples {
            bins[BIN_BOUNDS_US.partition_point(|bound| *ns >= bound * 1000)] += 1;
        }
        Self {
            what,
            samples: samples.len(),
            missed,
            median_us: quantile(0.5),
            p99_us: quantile(0.99),
            largest_us: quantile(1.0),
            bins,
        }
    }
}

/// Checks that the system lets a thread have SCHED_FIFO, by a thread that ends at once.
///
/// # Errors
/// The reason of the system.
pub fn try_fifo() -> Result<(), String> {
    let pool =
        Pool::start(Arc::new(Idle), &one_worker(Some(FIFO_PRIORITY))).map_err(|error| error.to_string())?;
    match pool.start_report().first().map(|worker| &worker.fifo_priority) {
        Some(Grant::Granted(_)) => Ok(()),
        Some(Grant::Refused { why, .. }) => Err(why.clone()),
        Some(Grant::NotAsked) | None => Err("no thread was started".to_owned()),
    }
}

/// Measures each kind of wake-up for `duration`; the kinds with SCHED_FIFO only if it is granted.
///
/// # Errors
/// Fails if the system starts no thread.
pub fn measure(duration: Duration, fifo_is_granted: bool) -> Result<Vec<Latency>, String> {
    let mut latencies = vec![
        sleeping(SLEEPS[0], duration, None)?,
        waking("parked worker", duration, None, Workers::Parked)?,
        waking("spinning worker", duration, None, Workers::Spinning)?,
    ];
    if fifo_is_granted {
        let fifo = Some(FIFO_PRIORITY);
        latencies.push(sleeping(SLEEPS[1], duration, fifo)?);
        latencies.push(waking("parked worker, SCHED_FIFO", duration, fifo, Workers::Parked)?);
    }
    Ok(latencies)
}

fn one_worker(fifo_priority: Option<u8>) -> Settings {
    Settings { workers: 1, oversubscribe: true, fifo_priority, ..Settings::default() }
}

/// A job that does nothing.
struct Idle;

impl Job for Idle {
    fn run(&self, _block: u32, _thread: usize) {}
}

/// A job whose worker sleeps again and again; the caller's block ends once the worker has begun.
struct Sleeper {
    duration: Duration,
    late_ns: Mutex<Vec<u64>>,
    has_begun: AtomicBool,
}

impl Job for Sleeper {
    fn run(&self, _block: u32, lane: usize) {
        if lane == 0 {
            while !self.has_begun.load(Ordering::Acquire) {
                std::thread::sleep(PERIOD);
            }
        } else if !self.has_begun.swap(true, Ordering::AcqRel) {
            let late = sleep_again_and_again(self.duration);
            *self.late_ns.lock().unwrap_or_else(PoisonError::into_inner) = late;
        }
    }
}

/// Latency of the wake-ups of a thread with this priority from its sleeps.
fn sleeping(what: &'static str, duration: Duration, fifo_priority: Option<u8>) -> Result<Latency, String> {
    // The sleeps run on a worker, because pools set the priority of their workers.
    let sleeper =
        Arc::new(Sleeper { duration, late_ns: Mutex::default(), has_begun: AtomicBool::new(false) });
    // Longer than any delay of a running machine.
    let worker_timeout = duration + Duration::from_secs(60);
    let settings = Settings { worker_timeout, ..one_worker(fifo_priority) };
    let mut pool = Pool::start(sleeper.clone(), &settings).map_err(|error| error.to_string())?;
    if pool.run(2) == Outcome::Abandoned {
        return Err(format!("{what}: the thread was not run for a minute; measure when less is running"));
    }
    let late = std::mem::take(&mut *sleeper.late_ns.lock().unwrap_or_else(PoisonError::into_inner));
    Ok(Latency::of(what, late, 0))
}

/// Delays at the end of each of a series of sleeps, ns.
fn sleep_again_and_again(duration: Duration) -> Vec<u64> {
    let times = duration.as_nanos() / PERIOD.as_nanos();
    (0..times).map(|_| in_ns(late_after_sleep())).collect()
}

/// Sleeps for a period until an absolute time, as an executive does; returns the delay.
#[cfg(target_os = "linux")]
fn late_after_sleep() -> Duration {
    use rustix::thread::clock_nanosleep_absolute;
    use rustix::time::{ClockId, Timespec, clock_gettime};

    // The clock starts at boot: it has no negative times.
    let now = || {
        let Timespec { tv_sec, tv_nsec } = clock_gettime(ClockId::Monotonic);
        Duration::new(tv_sec as u64, tv_nsec as u32)
    };
    let release = now() + PERIOD;
    let until = Timespec { tv_sec: release.as_secs() as _, tv_nsec: release.subsec_nanos() as _ };
    // A signal ends a sleep early; the loop sleeps for the rest.
    while clock_nanosleep_absolute(ClockId::Monotonic, &until).is_err() && now() < release {}
    now().saturating_sub(release)
}

#[cfg(not(target_os = "linux"))]
fn late_after_sleep() -> Duration {
    let release = Instant::now() + PERIOD;
    std::thread::sleep(PERIOD);
    release.elapsed()
}

/// A job whose worker records when it runs; the caller waits in its own block until then.
struct Waker {
    origin: Instant,
    /// Time since the origin, ns; 0 before the worker has run.
    ran_at_ns: AtomicU64,
}

impl Job for Waker {
    fn run(&self, _block: u32, lane: usize) {
        if lane > 0 {
            let now = in_ns(self.origin.elapsed()).max(1);
            let _ = self.ran_at_ns.compare_exchange(0, now, Ordering::AcqRel, Ordering::Acquire);
            return;
        }
        let began = Instant::now();
        while self.ran_at_ns.load(Ordering::Acquire) == 0 && began.elapsed() < LONGEST_WAIT {
            std::hint::spin_loop();
        }
    }
}

/// State of the workers before a phase.
#[derive(Clone, Copy)]
enum Workers {
    Parked,
    Spinning,
}

/// Latency from the call of a phase to the worker's first instruction in it.
fn waking(
    what: &'static str,
    duration: Duration,
    fifo_priority: Option<u8>,
    workers: Workers,
) -> Result<Latency, String> {
    let waker = Arc::new(Waker { origin: Instant::now(), ran_at_ns: AtomicU64::new(0) });
    let settings = Settings { worker_timeout: LONGEST_WAIT, ..one_worker(fifo_priority) };
    let mut pool = Pool::start(waker.clone(), &settings).map_err(|error| error.to_string())?;
    let (mut late, mut missed) = (Vec::new(), 0);
    let until = Instant::now() + duration;
    while Instant::now() < until {
        match workers {
            Workers::Parked => {
                pool.quiesce();
                std::thread::sleep(PERIOD);
            }
            // A host prewakes its workers ahead of a frame.
            Workers::Spinning => {
                pool.prewake(PERIOD);
                spin_for(PERIOD / 10);
            }
        }
        waker.ran_at_ns.store(0, Ordering::Release);
        let called_at = in_ns(waker.origin.elapsed());
        let outcome = pool.run(2);
        match waker.ran_at_ns.load(Ordering::Acquire) {
            ran_at if ran_at > 0 && outcome == Outcome::Complete => {
                late.push(ran_at.saturating_sub(called_at))
            }
            _ => missed += 1,
        }
    }
    Ok(Latency::of(what, late, missed))
}

fn spin_for(duration: Duration) {
    let began = Instant::now();
    while began.elapsed() < duration {
        std::hint::spin_loop();
    }
}

fn in_ns(duration: Duration) -> u64 {
    u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_and_bins_are_those_of_the_samples() {
        // 1, 2, …, 100 µs: the median is the 50th, and the 99th percentile is the 99th.
        let latency = Latency::of("test", (1..=100).rev().map(|us| us * 1000).collect(), 3);
        assert_eq!((latency.samples, latency.missed), (100, 3));
        assert_eq!((latency.median_us, latency.p99_us, latency.largest_us), (50.0, 99.0, 100.0));
        // A sample on a bound is in the bin above it: 1…9, 10…19, 20…49, 50…99, 100.
        assert_eq!(latency.bins[..5], [9, 10, 30, 50, 1]);
        assert_eq!(latency.bins.iter().sum::<usize>(), 100);
    }

    #[test]
    fn no_samples_are_no_error() {
        let latency = Latency::of("test", Vec::new(), 1);
        assert_eq!((latency.samples, latency.median_us, latency.largest_us), (0, 0.0, 0.0));
    }

    #[test]
    fn a_short_measurement_has_samples_or_says_what_it_missed() {
        for latency in measure(Duration::from_millis(20), false).unwrap() {
            assert!(latency.samples + latency.missed > 0, "{latency:?}");
            assert_eq!(latency.bins.iter().sum::<usize>(), latency.samples);
        }
    }
}
