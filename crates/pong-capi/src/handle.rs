//! A world as C holds it, and what the C side remembers with it.

use crate::advice::Advice;
use crate::counters::Counters;
use crate::host_data::UserData;
use crate::law_adapters::LawFaults;
use crate::names::Names;
use crate::worker::Started;
use pong_engine::{EngineError, InterfaceId, PairId, State, World};
use pong_record::{ModelSource, Recorder};
use std::ffi::CString;
use std::sync::Mutex;

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
