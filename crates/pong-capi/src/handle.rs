//! Handle of a world, and the data of the C interface for it.

use crate::advice::Advice;
use crate::counters::Counters;
use crate::host_data::UserData;
use crate::law_adapters::{Callback, LawFaults};
use crate::names::Names;
use crate::phase::Phase;
use crate::worker::Started;
use pong_engine::{InterfaceId, PairId, PairMonitor, State};
use pong_record::{ModelSource, Recorder};
use std::ffi::CString;
use std::sync::Mutex;

/// A contact world: models, Objects, pairs and contact state. Opaque.
///
/// Any thread may call it, one at a time; a second call meanwhile returns PONG_STATUS_BUSY. Different worlds
/// are independent.
pub struct pong_world {
    pub(crate) inner: Mutex<Inner>,
}

/// Data guarded by the lock.
pub(crate) struct Inner {
    pub phase: Phase,
    pub names: Names,
    pub user_data: UserData,
    pub advice: Advice,
    pub seal_warnings: Vec<CString>,
    pub seal_notes: Vec<CString>,
    /// Text last returned by `pong_pair_remedy`.
    pub remedy: CString,
    /// The workers; none before the world is sealed.
    pub workers: Vec<Started>,
    /// Number of pairs of Objects.
    pub pair_count: usize,
    /// Scratch for `pong_set_states`, kept to avoid allocation.
    pub states: Vec<(InterfaceId, State)>,
    /// Scratch for `pong_commit_pairs`, kept to avoid allocation.
    pub pairs: Vec<PairId>,
    pub counters: Counters,
    pub law_faults: LawFaults,
    /// The registered laws.
    pub callbacks: Vec<Callback>,
    /// Source of each model.
    pub sources: Vec<ModelSource>,
    pub log: Option<Recorder>,
    pub monitor: Option<PairMonitor>,
}
