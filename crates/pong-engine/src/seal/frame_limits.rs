//! Capacities of the buffers of a frame.

/// Minimum capacity in contacts of a worker's buffer, unless the caller's is smaller.
const LEAST_WORKER_CONTACTS: usize = 4096;

/// Capacities of the buffers of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Capacity in contacts of the calling thread: all that a frame may keep, plus a reserve from which the
    /// deepest are selected.
    pub thread_contacts: usize,
    /// Capacity in candidates of one chunk of A.
    pub found: usize,
    /// Most nodes and batches together in the tree of a movable group.
    pub tree_parts: usize,
    /// Arena for the broad phase of a block, bytes.
    pub arena_bytes: usize,
    /// Scratch memory for load sharing, ledger and rays, bytes.
    pub scratch_bytes: usize,
    /// Most facets of a part of a solid, and most planes of a field.
    pub facets: usize,
    pub faces: usize,
}

impl Limits {
    /// Capacity in contacts of one of several threads: twice an even share, but at least
    /// [`LEAST_WORKER_CONTACTS`]. A thread that finds more leaves the round to the caller alone, so this must
    /// be rare but is allowed.
    pub fn worker_contacts(&self, threads: usize) -> usize {
        self.thread_contacts.min((2 * self.thread_contacts / threads).max(LEAST_WORKER_CONTACTS))
    }

    /// Minimum capacity in contacts of a worker.
    pub fn least_worker_contacts(&self) -> usize {
        self.thread_contacts.min(LEAST_WORKER_CONTACTS)
    }
}
