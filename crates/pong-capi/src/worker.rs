//! A worker as C sees it.

use std::ffi::CString;

/// Outcome of a request to the system: PONG_GRANT_...
pub type pong_grant = u32;

/// Outcome of a request that the configuration does not make.
pub const PONG_GRANT_NOT_ASKED: pong_grant = 0;
/// Outcome: requested and granted.
pub const PONG_GRANT_GRANTED: pong_grant = 1;
/// Outcome: requested and refused; pong_worker_text() has the reason.
pub const PONG_GRANT_REFUSED: pong_grant = 2;

/// Placement of a worker, and its share of the last frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct pong_worker {
    /// Thread: 0 is the calling thread, 1 the first worker.
    pub index: u32,
    /// Outcome of binding it to a core: PONG_GRANT_...
    pub core_grant: pong_grant,
    /// The core that was requested; 0 if none was.
    pub core: u32,
    /// Outcome of requesting SCHED_FIFO: PONG_GRANT_...
    pub fifo_grant: pong_grant,
    /// The priority that was requested; 0 if none was.
    pub fifo_priority: u32,
    /// Blocks of work done in the last round of work that was shared out. A frame with too little work to
    /// share has none, and the number stays that of an earlier frame.
    pub blocks: u32,
    /// With report_times: time spent on them, ns; else 0.
    pub busy_ns: u64,
    /// With report_times: time of this thread in each part of the last frame's contacts, ns, at
    /// PONG_WORK_...; else 0. All rounds of the frame together; for the calling thread including what it did
    /// by itself.
    pub work_ns: [u64; 4],
}

/// Constant data of the workers, from their start.
pub(crate) struct Started {
    pub placement: pong_worker,
    pub text: CString,
}
