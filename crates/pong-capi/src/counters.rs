//! Counters and times of the C interface.

use pong_engine::FrameReport;

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
