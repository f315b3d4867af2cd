//! A world and what the C side remembers with it.

use crate::clock;
use crate::config::pong_config;
use crate::frames::Counters;
use crate::guard::{Failure, guarded};
use crate::law_adapters::LawFaults;
use crate::memory;
use crate::names::Names;
use crate::pointers::{Out, one};
use crate::status::pong_status;
use crate::step_plan::Advice;
use crate::user_data::UserData;
use crate::workers::Started;
use pong_engine::{EngineError, InterfaceId, PairId, State, World};
use pong_record::{ModelSource, Recorder};
use std::ffi::CString;
use std::sync::{Mutex, PoisonError, TryLockError};

/// A contact world: models, Objects, pairs and everything remembered between frames. Opaque.
///
/// One thread at a time may call it, any thread; a second call meanwhile returns PONG_STATUS_BUSY. Different
/// worlds are independent.
pub struct pong_world {
    pub(crate) inner: Mutex<Inner>,
}

/// What the lock guards.
pub(crate) struct Inner {
    pub world: World,
    pub names: Names,
    pub user_data: UserData,
    pub advice: Advice,
    pub seal_warnings: Vec<CString>,
    pub seal_notes: Vec<CString>,
    /// What `pong_pair_remedy` gave out last.
    pub remedy: CString,
    /// The workers, once the world is sealed.
    pub workers: Option<Vec<Started>>,
    /// How many pairs of Objects there are.
    pub pair_count: usize,
    /// For `pong_set_states`: its memory stays.
    pub states: Vec<(InterfaceId, State)>,
    /// For `pong_commit_pairs`: its memory stays.
    pub pairs: Vec<PairId>,
    pub counters: Counters,
    pub law_faults: LawFaults,
    /// Names of the registered laws: of the normal force and of friction.
    pub law_names: [Vec<String>; 2],
    /// Where each model came from.
    pub sources: Vec<ModelSource>,
    pub log: Option<Recorder>,
}

impl Inner {
    /// For what the engine does not hear of and yet belongs before the seal.
    pub fn must_not_be_sealed(&self, call: &'static str) -> Result<(), EngineError> {
        match self.workers {
            None => Ok(()),
            Some(_) => Err(EngineError::WrongPhase { call, cure: "do it before the world is sealed" }),
        }
    }
}

/// Creates a world. It is the caller's: destroy it with pong_destroy_world(). On failure `world` gets NULL.
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
        memory::require_little()?;
        let mut world = World::new(wanted.engine);
        if wanted.times {
            world.set_clock(clock::now_ns);
        }
        let inner = Inner {
            world,
            names: Names::default(),
            user_data: UserData::default(),
            advice: Advice::default(),
            seal_warnings: Vec::new(),
            seal_notes: Vec::new(),
            remedy: CString::default(),
            workers: None,
            pair_count: 0,
            states: Vec::new(),
            pairs: Vec::new(),
            counters: Counters::default(),
            law_faults: LawFaults::default(),
            law_names: [Vec::new(), Vec::new()],
            sources: Vec::new(),
            log: None,
        };
        out.set(Box::into_raw(Box::new(pong_world { inner: Mutex::new(inner) })));
        Ok(())
    })
}

/// Destroys a world and everything it gave out: ids become stale, names, warnings and notes must not be read any more.
/// NULL is allowed and does nothing. No other call on the world may follow. PONG_STATUS_BUSY: a call on it is running, or
/// this is called from inside one of its laws; the world is as it was. PONG_STATUS_WORKER_LEFT: it is destroyed, but a worker
/// that the system does not run was left behind after a second. Closes a log that is running.
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
        match inner.world.end_workers() {
            0 => Ok(()),
            left => {
                let message = format!(
                    "the world is destroyed, but {left} of its workers had not ended in time: the system does not run \
                     them; keep what the laws' `user` pointers name, and the library, until they have ended"
                );
                Err(Failure::new(pong_status::WorkerLeft, message))
            }
        }
    })
}
