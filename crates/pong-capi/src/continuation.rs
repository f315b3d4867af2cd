//! Continuation of a run in a world of more or fewer Objects.

use crate::advice::Advice;
use crate::failure::{Failure, Outcome};
use crate::guard::{get, lock, setting_up};
use crate::handle::{Counters, Inner, pong_world};
use crate::law_adapters::LawFaults;
use crate::memory;
use crate::phase::Phase;
use crate::pointers::Out;
use crate::status::pong_status;
use pong_engine::{Continuation, WorldBuilder};
use std::ffi::CString;
use std::sync::Mutex;

/// Objects, pairs and contacts that pong_continue_from() took over, and those left in the other world.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_continuation {
    /// Objects in both worlds.
    pub objects: u64,
    /// Pairs of them that continue.
    pub pairs: u64,
    /// Pushing contacts that continue.
    pub contacts: u64,
    /// Objects of the other world alone.
    pub objects_left: u64,
    /// Pairs of those, left behind with their contact state and energy accounts.
    pub pairs_left: u64,
    /// Pushing contacts of those pairs.
    pub contacts_left: u64,
    /// Energy stored in them, J. The ledger counts it as dissipated.
    pub energy_left: f64,
    /// Zero in this version.
    pub reserved: [u64; 4],
}

/// Makes a world in set-up with everything that a sealed one was made of, and with the states, pairs, surface
/// values and user data that it has now: load and create what arrives, pair it, seal, and call
/// pong_continue_from(). Models are shared, not loaded again. Ids of the sealed world are ids of this one; ids of
/// what is added belong to this one alone, and must not be used in another world extended from the same one. The
/// sealed world may run on meanwhile. Both call the same laws: the `user` data of a law must live as long as
/// either. Masses and step plan are taken over. The world is the caller's: destroy it with pong_destroy_world().
/// On failure `extended` gets NULL. PONG_STATUS_WRONG_PHASE before the seal.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_extend_world(
    world: *const pong_world,
    extended: *mut *mut pong_world,
) -> pong_status {
    if let Ok(out) = Out::new(extended, "extended") {
        out.set(std::ptr::null_mut());
    }
    get(world, (extended, "extended"), |inner| {
        let made = inner.extended()?;
        Ok(Box::into_raw(Box::new(pong_world { inner: Mutex::new(made) })))
    })
}

/// Continues the run of another world, `from`, in `world`; both are sealed. Common Objects (those of equal name)
/// and their pairs take over states, switched pairs, surface values and contact state. Contacts between them
/// continue as if no Object had been added or removed: their wrenches are bit-identical, as long as nothing else
/// touches these Objects. So do the totals of the ledger and the energy accounts of these pairs. Objects that
/// only `world` has keep their states, pairs and surfaces, and their contacts start without history. Objects
/// that only `from` has are left behind; `continuation`, which may be NULL, counts them. All earlier contact
/// state of `world` is dropped, and it has no results before its next frame. `from` is unchanged. Allocates:
/// call it between frames.
///
/// PONG_STATUS_BAD_VALUE if contacts would not continue unchanged: an Object of the same name has another model,
/// Objects were created or paired in another order, a pair is missing, filters differ, energies are kept
/// otherwise, or there is too little room. PONG_STATUS_WRONG_PHASE: a frame of either world was evaluated and
/// not committed, or `world` has a log. `world` is unchanged then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_continue_from(
    world: *mut pong_world,
    from: *const pong_world,
    continuation: *mut pong_continuation,
) -> pong_status {
    setting_up(world, |inner| {
        let out = Out::optional(continuation, "continuation")?;
        if std::ptr::eq(world, from) {
            let message = "`from` is the world itself; give the world whose run goes on";
            return Err(Failure::new(pong_status::BadValue, message));
        }
        memory::require_for_object(inner.names.interface_count())?;
        if inner.log.is_some() {
            let message = "continue from another world: a log of this one is running, and the run of the other is not in it; \
                           stop it with pong_stop_log() first, and begin another one afterwards";
            return Err(Failure::new(pong_status::WrongPhase, message));
        }
        let call = "continue from another world";
        let engine = inner.phase.frames_mut(call)?;
        let other = lock(from, "from")?;
        out.set((&engine.continue_from(other.phase.frames(call)?)?).into());
        Ok(())
    })
}

impl Inner {
    fn extended(&self) -> Outcome<Self> {
        let world = self.phase.frames("extend the world")?;
        memory::require_for_object(self.names.interface_count())?;
        let mut builder = WorldBuilder::extending(world);
        // Separate fault flags: a law that fails in one world does not fail a frame of the other.
        let mut law_faults = LawFaults::default();
        let (callbacks, laws) = law_faults.watch_again(&self.callbacks);
        *builder.laws_mut() = laws;
        Ok(Self {
            phase: Phase::SetUp(builder),
            names: self.names.clone(),
            user_data: self.user_data.clone(),
            advice: Advice::clone(&self.advice),
            seal_warnings: Vec::new(),
            seal_notes: Vec::new(),
            remedy: CString::default(),
            workers: Vec::new(),
            pair_count: self.pair_count,
            states: Vec::new(),
            surface_motions: Vec::new(),
            pairs: Vec::new(),
            counters: Counters::default(),
            law_faults,
            callbacks,
            sources: self.sources.clone(),
            log: None,
            monitor: None,
        })
    }
}

impl From<&Continuation> for pong_continuation {
    fn from(of: &Continuation) -> Self {
        Self {
            objects: of.objects as u64,
            pairs: of.pairs as u64,
            contacts: of.contacts as u64,
            objects_left: of.objects_left as u64,
            pairs_left: of.pairs_left as u64,
            contacts_left: of.contacts_left as u64,
            energy_left: of.energy_left,
            reserved: [0; 4],
        }
    }
}
