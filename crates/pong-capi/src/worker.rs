//! A worker as C sees it.

use std::ffi::CString;

/// What became of a worker, and what it did last.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct pong_worker {
    /// 0 is the calling thread, 1 the first worker.
    pub index: u32,
    /// Whether it is bound to a core: PONG_GRANT_...
    pub core_grant: u32,
    /// The core that was asked for; 0 if none was.
    pub core: u32,
    /// Whether it runs under SCHED_FIFO as asked: PONG_GRANT_...
    pub fifo_grant: u32,
    /// The priority that was asked for; 0 if none was.
    pub fifo_priority: u32,
    /// Blocks of work that it did in the last round of work that was shared out. A frame with too little work to share
    /// has none, and the number stays that of an earlier frame.
    pub blocks: u32,
    /// With report_times: time in them, ns; else 0.
    pub busy_ns: u64,
    /// With report_times: where the time of the last frame's contacts went on this thread, ns, at PONG_WORK_...; else 0. All
    /// rounds of the frame together; of the calling thread also what it did by itself.
    pub work_ns: [u64; 4],
}

/// Workers as they were started: what does not change.
pub(crate) struct Started {
    pub asked: pong_worker,
    pub text: CString,
}
