//! Core and priority of a worker. Each worker requests its own. A refusal is reported, but is no error.

use std::fmt;

use crate::{MAX_WORKERS, Settings, system};

/// Answer of the system to a request in the settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Grant<T> {
    /// Not requested by the settings.
    NotAsked,
    /// Requested and in effect.
    Granted(T),
    /// Requested, but not in effect.
    Refused {
        /// Requested value.
        asked: T,
        /// Reason, in the system's words where it gives any.
        why: String,
    },
}

/// Start report of one worker: the core and the priority that it got.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorkerStart {
    /// Index of the worker, from 1.
    pub thread: usize,
    /// Core the worker is bound to.
    pub core: Grant<usize>,
    /// SCHED_FIFO priority of the worker.
    pub fifo_priority: Grant<u8>,
}

impl<T: fmt::Display> fmt::Display for Grant<T> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Grant::NotAsked => write!(out, "not asked for"),
            Grant::Granted(what) => write!(out, "{what}"),
            Grant::Refused { asked, why } => write!(out, "{asked} refused: {why}"),
        }
    }
}

impl fmt::Display for WorkerStart {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "worker {}: core {}, SCHED_FIFO priority {}", self.thread, self.core, self.fifo_priority)
    }
}

impl Settings {
    /// Returns the number of workers that a pool with these settings would have if started from the calling
    /// thread.
    pub fn workers_granted(&self) -> usize {
        cores_of_workers(self).len()
    }
}

/// Returns one entry per worker to start: the core to which it is to be bound; `None` if it is not to be
/// bound.
pub fn cores_of_workers(settings: &Settings) -> Vec<Option<usize>> {
    let (cores, room) = room_for_workers(settings);
    let asked = settings.workers.min(MAX_WORKERS);
    let workers = if settings.oversubscribe { asked } else { asked.min(room) };
    (0..workers).map(|worker| settings.pin.then(|| cores[worker % cores.len()])).collect()
}

/// Returns the cores in the order in which workers use them, and the number of workers that fit beside the
/// caller.
fn room_for_workers(settings: &Settings) -> (Vec<usize>, usize) {
    if settings.pin && !settings.cores.is_empty() {
        return (settings.cores.clone(), settings.cores.len());
    }
    let mut cores = cores_of_mask();
    let room = cores.len() - 1;
    // The caller keeps the first core of the mask; workers use it last.
    cores.rotate_left(1);
    (cores, room)
}

/// Returns the cores of the affinity mask: at least one, even if the system reports none.
fn cores_of_mask() -> Vec<usize> {
    match system::cores() {
        none if none.is_empty() => (0..std::thread::available_parallelism().map_or(1, usize::from)).collect(),
        cores => cores,
    }
}

/// Binds the calling thread to `core` and sets its priority, each if requested. Returns what the system
/// granted.
pub fn settle(thread: usize, core: Option<usize>, fifo_priority: Option<u8>) -> WorkerStart {
    WorkerStart {
        thread,
        core: core.map_or(Grant::NotAsked, |core| granted(core, system::bind(core))),
        fifo_priority: fifo_priority
            .map_or(Grant::NotAsked, |priority| granted(priority, system::raise_priority(priority))),
    }
}

fn granted<T>(asked: T, answer: Result<(), String>) -> Grant<T> {
    match answer {
        Ok(()) => Grant::Granted(asked),
        Err(why) => Grant::Refused { asked, why },
    }
}
