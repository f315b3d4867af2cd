//! How much memory the frames get.

/// Contacts that a worker's lane can hold at least, or as many as the caller's; and so many records it can write by itself.
const LEAST_WORKER_CONTACTS: usize = 4096;

/// How much memory the frames get.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Contacts that the calling thread can hold: all that a frame may keep, and room to find more before it has to
    /// choose.
    pub lane_contacts: usize,
    /// Whether each lane writes the records of what it finds, and not the commit those of all.
    pub lanes_write_records: bool,
    /// Interferences of one chunk of A before any is left out.
    pub found: usize,
    /// For the testers of a block, bytes.
    pub arena_bytes: usize,
    /// For solutions among contacts, the ledger and rays, bytes.
    pub scratch_bytes: usize,
}

impl Limits {
    /// Contacts that one of several lanes can hold. A lane that finds more than this leaves the frame to the caller
    /// alone: an uneven share of the work must be rare, not impossible.
    pub fn worker_contacts(&self, lanes: usize) -> usize {
        self.lane_contacts.min((2 * self.lane_contacts / lanes).max(LEAST_WORKER_CONTACTS))
    }

    /// Contacts that a worker's lane can hold at least, or as many as the caller's.
    pub fn least_worker_contacts(&self) -> usize {
        self.lane_contacts.min(LEAST_WORKER_CONTACTS)
    }

    /// Records that each lane, the caller's too, writes by itself. Where it finds more, the commit takes more than the way of a
    /// few lines from core to core.
    pub fn lane_records(&self) -> usize {
        if self.lanes_write_records { self.least_worker_contacts() } else { 0 }
    }
}
