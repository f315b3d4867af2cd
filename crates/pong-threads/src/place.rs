//! Core and priority of a worker. Each worker requests its own. A refusal is reported, but is no error.

use std::fmt;

use core_affinity::CoreId;

use crate::{MAX_WORKERS, Settings};

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
    let listed = core_affinity::get_core_ids().unwrap_or_default();
    if !listed.is_empty() {
        return listed.iter().map(|core| core.id).collect();
    }
    (0..std::thread::available_parallelism().map_or(1, usize::from)).collect()
}

/// Binds the calling thread to `core` and sets its priority, each if requested. Returns what the system
/// granted.
pub fn settle(thread: usize, core: Option<usize>, fifo_priority: Option<u8>) -> WorkerStart {
    WorkerStart {
        thread,
        core: core.map_or(Grant::NotAsked, bind),
        fifo_priority: fifo_priority.map_or(Grant::NotAsked, raise),
    }
}

fn bind(core: usize) -> Grant<usize> {
    if core_affinity::set_for_current(CoreId { id: core }) {
        return Grant::Granted(core);
    }
    Grant::Refused { asked: core, why: "the system does not let this thread run there".to_owned() }
}

#[cfg(unix)]
fn raise(priority: u8) -> Grant<u8> {
    // SAFETY: an all-zero sched_param is valid on every system that has one, and the call reads it only.
    let refusal = unsafe {
        let mut parameters: libc::sched_param = std::mem::zeroed();
        parameters.sched_priority = libc::c_int::from(priority);
        libc::pthread_setschedparam(libc::pthread_self(), libc::SCHED_FIFO, &parameters)
    };
    match refusal {
        0 => Grant::Granted(priority),
        number => {
            Grant::Refused { asked: priority, why: std::io::Error::from_raw_os_error(number).to_string() }
        }
    }
}

#[cfg(not(unix))]
fn raise(priority: u8) -> Grant<u8> {
    Grant::Refused { asked: priority, why: "this system has no SCHED_FIFO".to_owned() }
}
