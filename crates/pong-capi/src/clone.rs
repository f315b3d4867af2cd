//! Cloning of a sealed world.

use crate::failure::Outcome;
use crate::guard::get;
use crate::handle::{Counters, Inner, pong_world};
use crate::law_adapters::{Callback, LawFaults};
use crate::memory;
use crate::phase::Phase;
use crate::pointers::Out;
use crate::status::pong_status;
use pong_engine::World;
use std::ffi::CString;
use std::sync::Mutex;

/// Clones a sealed world as it stands: with its states, pairs, surfaces, contact state and user data, and the
/// same ids. It takes a fraction of the time of loading and sealing again. From here on both are independent;
/// given the same calls, they give the same bits. The clone has memory and workers of its own; it has computed
/// no frame yet and has no log and no monitor. Both call the same laws: the `user` data of a law must live as
/// long as either. The clone is the caller's: destroy it with pong_destroy_world(). On failure `clone` gets
/// NULL. After sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_clone_world(
    world: *const pong_world,
    clone: *mut *mut pong_world,
) -> pong_status {
    if let Ok(out) = Out::new(clone, "clone") {
        out.set(std::ptr::null_mut());
    }
    get(world, (clone, "clone"), |inner| {
        let made = inner.try_clone()?;
        Ok(Box::into_raw(Box::new(pong_world { inner: Mutex::new(made) })))
    })
}

impl Inner {
    /// Clone of the engine's world, with its laws. They have fault flags of their own: a law that fails in one world
    /// does not fail a frame of the other.
    pub(crate) fn clone_engine(&self, call: &'static str) -> Outcome<(World, LawFaults, Vec<Callback>)> {
        let world = self.phase.frames(call)?;
        memory::require_for_object(self.names.interface_count())?;
        let mut law_faults = LawFaults::default();
        let (callbacks, laws) = law_faults.watch_again(&self.callbacks);
        let world =
            if callbacks.is_empty() { world.try_clone()? } else { world.try_clone_with_laws(laws)? };
        Ok((world, law_faults, callbacks))
    }

    fn try_clone(&self) -> Outcome<Self> {
        let (world, law_faults, callbacks) = self.clone_engine("clone the world")?;
        let contact_capacity = self.counters.contact_capacity;
        Ok(Self {
            workers: world.worker_starts().iter().map(Into::into).collect(),
            phase: Phase::Frames(world),
            names: self.names.clone(),
            user_data: self.user_data.clone(),
            advice: self.advice.clone(),
            seal_warnings: self.seal_warnings.clone(),
            seal_notes: self.seal_notes.clone(),
            remedy: CString::default(),
            pair_count: self.pair_count,
            states: Vec::with_capacity(self.names.interface_count()),
            surface_motions: Vec::with_capacity(self.names.interface_count()),
            pairs: Vec::with_capacity(self.pair_count),
            counters: Counters { contact_capacity, ..Counters::default() },
            law_faults,
            callbacks,
            sources: self.sources.clone(),
            log: None,
            monitor: None,
        })
    }
}
