//! Workers: waking, sleeping, placement and shares of work.

use crate::failure::{Failure, Outcome};
use crate::guard::{get, with_world};
use crate::handle::{Inner, pong_world};
use crate::names::c_text;
use crate::report::by_work;
use crate::status::pong_status;
use crate::worker::Started;
pub use crate::worker::{
    PONG_GRANT_GRANTED, PONG_GRANT_NOT_ASKED, PONG_GRANT_REFUSED, pong_grant, pong_worker,
};
use pong_engine::{ThreadWork, WorkerStart};
use pong_threads::Grant;
use std::ffi::c_char;
use std::time::Duration;

/// Wakes the workers shortly before a frame (some 100 us): they look for its work until it comes or
/// `at_most_us`, us, have passed. For hosts whose frames are further apart than the workers' spin_us. Does
/// nothing without workers. After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_prewake(world: *mut pong_world, at_most_us: u64) -> pong_status {
    with_world(world, |inner| {
        inner.phase.frames_mut("wake the workers")?.prewake(Duration::from_micros(at_most_us));
        Ok(())
    })
}

/// Lets the workers sleep at once, as in a freeze. The next frame wakes them. Does nothing without workers.
/// After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_quiesce(world: *mut pong_world) -> pong_status {
    with_world(world, |inner| {
        inner.phase.frames_mut("let the workers sleep")?.quiesce();
        Ok(())
    })
}

/// Number of workers that were started, which may be fewer than the configuration requests. After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_worker_count(world: *const pong_world, count: *mut usize) -> pong_status {
    get(world, (count, "count"), |inner| {
        inner.phase.frames("count the workers")?;
        Ok(inner.workers.len())
    })
}

/// Copies the placement of a worker and its share of the last frame. `index` is 1 to pong_worker_count(), or 0
/// for the calling thread. After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_worker(
    world: *const pong_world,
    index: usize,
    worker: *mut pong_worker,
) -> pong_status {
    get(world, (worker, "worker"), |inner| {
        let world = inner.phase.frames("get a worker")?;
        let placement = if index == 0 { pong_worker::default() } else { inner.worker(index)?.placement };
        let ThreadWork { blocks, busy_ns } = world.thread_work().nth(index).unwrap_or_default();
        let work_ns = world.thread_times().nth(index).map_or([0; 4], |times| by_work(&times));
        Ok(pong_worker { blocks, busy_ns, work_ns, ..placement })
    })
}

/// Returns the placement of a worker in words: its core and priority, or why it does not have them. `index` is
/// 1 to pong_worker_count(). The text lives as long as the world. After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_worker_text(
    world: *const pong_world,
    index: usize,
    text: *mut *const c_char,
) -> pong_status {
    get(world, (text, "text"), |inner| Ok(inner.worker(index)?.text.as_ptr()))
}

impl Inner {
    fn worker(&self, index: usize) -> Outcome<&Started> {
        self.phase.frames("get a worker")?;
        let workers = &self.workers;
        let found = index.checked_sub(1).and_then(|index| workers.get(index));
        found.ok_or_else(|| {
            let message = format!(
                "worker {index}: there are {}, counted from 1; ask for the count first",
                workers.len()
            );
            Failure::new(pong_status::UnknownId, message)
        })
    }
}

impl From<&WorkerStart> for Started {
    fn from(start: &WorkerStart) -> Self {
        let (core_grant, core) = grant(&start.core, |core| core as u32);
        let (fifo_grant, fifo_priority) = grant(&start.fifo_priority, u32::from);
        let index = start.thread as u32;
        let placement =
            pong_worker { index, core_grant, core, fifo_grant, fifo_priority, ..pong_worker::default() };
        Self { placement, text: c_text(&start.to_string()) }
    }
}

/// A grant as PONG_GRANT_... and the value asked for.
fn grant<T: Copy>(grant: &Grant<T>, number: impl FnOnce(T) -> u32) -> (u32, u32) {
    match grant {
        Grant::NotAsked => (PONG_GRANT_NOT_ASKED, 0),
        Grant::Granted(asked) => (PONG_GRANT_GRANTED, number(*asked)),
        Grant::Refused { asked, .. } => (PONG_GRANT_REFUSED, number(*asked)),
    }
}
