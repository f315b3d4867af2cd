//! Creation and destruction of a world.

use crate::advice::Advice;
use crate::clock;
use crate::config::pong_config;
use crate::failure::{Failure, Outcome};
use crate::guard::guarded;
pub use crate::handle::pong_world;
use crate::handle::{Counters, Inner, UserData};
use crate::instructions;
use crate::law_adapters::LawFaults;
use crate::memory;
use crate::names::Names;
use crate::phase::Phase;
use crate::pointers::{Out, one};
use crate::status::pong_status;
use pong_engine::{World, WorldBuilder};
use std::ffi::CString;
use std::sync::{Mutex, PoisonError, TryLockError};

/// Creates a world. It is the caller's: destroy it with pong_destroy_world(). On failure `world` gets NULL. The first call
/// of a process reads the environment variable PONG_SIMD (docs/c_api.md).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_create_world(
    config: *const pong_config,
    world: *mut *mut pong_world,
) -> pong_status {
    guarded(|| {
        // SAFETY: see "Safety of all entries" in lib.rs.
        let out = unsafe { Out::new(world, "world")? };
        out.set(std::ptr::null_mut());
        // SAFETY: as above.
        let config = unsafe { one(config, "config")? };
        let wanted = config.check()?;
        memory::require_small()?;
        instructions::apply_environment()?;
        let mut builder = WorldBuilder::new(wanted.engine);
        if wanted.times {
            builder.set_clock(clock::now_ns);
        }
        let inner = Inner {
            phase: Phase::SetUp(builder),
            names: Names::default(),
            user_data: UserData::default(),
            advice: Advice::default(),
            seal_warnings: Vec::new(),
            seal_notes: Vec::new(),
            remedy: CString::default(),
            workers: Vec::new(),
            pair_count: 0,
            states: Vec::new(),
            surface_motions: Vec::new(),
            pairs: Vec::new(),
            counters: Counters::default(),
            law_faults: LawFaults::default(),
            callbacks: Vec::new(),
            sources: Vec::new(),
            log: None,
            monitor: None,
        };
        out.set(Box::into_raw(Box::new(pong_world { inner: Mutex::new(inner) })));
        Ok(())
    })
}

/// Destroys a world and everything it gave out: ids become stale; names, warnings and notes must not be read
/// any more. NULL is allowed and does nothing. No other call on the world may follow. PONG_STATUS_BUSY: a
/// call on it is running, or this is called from inside one of its laws; the world is as it was.
/// PONG_STATUS_WORKER_LEFT: it is destroyed, but a worker that the system does not run was left behind after
/// a second. Closes a log that is running.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_destroy_world(world: *mut pong_world) -> pong_status {
    guarded(|| {
        // SAFETY: see "Safety of all entries" in lib.rs.
        let Some(held) = (unsafe { world.as_ref() }) else { return Ok(()) };
        if let Err(TryLockError::WouldBlock) = held.inner.try_lock() {
            let message = "the world is in another call; destroy it when that has returned, and never from inside a law";
            return Err(Failure::new(pong_status::Busy, message));
        }
        // SAFETY: `pong_create_world` made it by `Box::into_raw`, and the caller destroys it once.
        let world = unsafe { Box::from_raw(world) };
        let mut inner = world.inner.into_inner().unwrap_or_else(PoisonError::into_inner);
        let Phase::Frames(world) = &mut inner.phase else { return Ok(()) };
        end_workers(world, "world")
    })
}

/// Ends the workers of a world that is being destroyed. `noun` names what had it.
pub(crate) fn end_workers(world: &mut World, noun: &str) -> Outcome {
    match world.end_workers() {
        0 => Ok(()),
        left => {
            let message = format!(
                "the {noun} is destroyed, but {left} of its workers had not ended in time: the system does not run \
                 them; keep the `user` data of the laws and the library until they have ended"
            );
            Err(Failure::new(pong_status::WorkerLeft, message))
        }
    }
}
