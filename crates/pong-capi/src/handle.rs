//! Handle of a world, and the data of the C interface for it.

use crate::advice::Advice;
use crate::law_adapters::{Callback, LawFaults};
use crate::names::Names;
use crate::phase::Phase;
use crate::worker::Started;
use pong_engine::{FrameReport, InterfaceId, PairId, PairMonitor, State, SurfaceMotion};
use pong_record::{ModelSource, Recorder};
use std::collections::HashMap;
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
    /// Scratch for `pong_set_surface_motions`, kept to avoid allocation.
    pub surface_motions: Vec<(InterfaceId, SurfaceMotion)>,
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

/// User data of Objects and primitives that were set; all others are 0.
#[derive(Clone, Default)]
pub(crate) struct UserData {
    pub objects: HashMap<u64, u64>,
    pub primitives: HashMap<(u64, u32), u64>,
}

/// Counters and times of the C interface.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counters {
    /// Most contacts of a frame, fixed when the world is sealed.
    pub contact_capacity: u64,
    pub evaluations: u64,
    pub commits: u64,
    pub peak_contacts_wanted: u32,
    pub evaluate_ns: u64,
    pub commit_ns: u64,
}

impl Counters {
    pub fn note_wanted(&mut self, report: &FrameReport) {
        self.peak_contacts_wanted = self.peak_contacts_wanted.max(report.contacts_wanted);
    }
}
