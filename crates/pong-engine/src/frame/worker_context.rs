//! What the calling thread or a worker writes while it works.

use crate::frame::broad_phase::candidate_pairs::CandidatePairs;
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::narrow_phase::element_pair::DeferredPairs;
use crate::sealed::Sealed;
use pong_arena::Arena;

/// The memory of the calling thread or of a worker.
#[derive(Debug)]
pub(crate) struct WorkerContext {
    /// Contact testers at work: gone with the block.
    pub arena: Arena,
    /// For one solution among contacts of one key.
    pub scratch: Arena,
    pub(crate) candidates: CandidatePairs,
    pub(crate) deferred: DeferredPairs,
    pub out: ContactBuffer,
}

impl WorkerContext {
    /// A context with room for so many contacts, and to rank them if it is to keep the deepest by itself.
    pub fn new(sealed: &Sealed, contacts: usize, ranks: bool) -> Self {
        Self {
            arena: Arena::with_capacity(sealed.limits.arena_bytes),
            scratch: Arena::with_capacity(sealed.limits.scratch_bytes),
            candidates: CandidatePairs::new(),
            deferred: DeferredPairs::default(),
            out: ContactBuffer::new(sealed.law_state_len, contacts, ranks),
        }
    }
}
