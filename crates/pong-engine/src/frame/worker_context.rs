//! Buffers that the calling thread or a worker writes while it works.

use crate::frame::broad_phase::chunk::ChunkSpace;
use crate::frame::broad_phase::element_search::{ElementSearch, SEARCHES_MAX};
use crate::frame::broad_phase::group_search::GroupSearch;
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::load_sharing::solver::SharedContact;
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::frame::narrow_phase::element_pair::DeferredPairs;
use crate::frame::solids::SolidScratch;
use crate::seal::Sealed;
use pong_arena::{Arena, Table};
use std::fmt::Debug;

/// Working memory of the calling thread or of a worker.
#[derive(Debug)]
pub(crate) struct WorkerContext {
    /// Broad-phase memory; reset for each block.
    pub arena: Arena,
    /// Scratch memory: for one load-sharing problem, and on the calling thread also for ray hits, ledger and
    /// ended contacts.
    pub scratch: Arena,
    pub(crate) group_search: GroupSearch,
    /// Searches for single elements of A. Boxed, because a context is built on the stack and this array is
    /// large.
    pub(crate) searches: Box<[ElementSearch; SEARCHES_MAX]>,
    /// Elements of these searches, in B's frame. Boxed for the same reason.
    pub(crate) spaces: Box<[ChunkSpace; SEARCHES_MAX]>,
    /// A chunk of A in B's frame. Not boxed: a block uses no buffer more often, and a box would cost a load
    /// each time.
    pub(crate) carried: ChunkSpace,
    pub(crate) deferred: DeferredPairs,
    /// Candidates that the contact testers find for one chunk.
    pub(crate) found: Table<ContactCandidate>,
    /// Contacts that share a spring.
    pub(crate) shared: Table<SharedContact>,
    /// Working memory for solids.
    pub(crate) solids: SolidScratch,
    pub out: ContactBuffer,
}

impl WorkerContext {
    /// Bytes of the tables of a context, without arenas and contact buffers; `found` is the number of
    /// candidates per chunk.
    pub fn table_bytes(found: usize) -> usize {
        let search = size_of::<ElementSearch>() + size_of::<ChunkSpace>() + ChunkSpace::BYTES;
        SEARCHES_MAX * search + ChunkSpace::BYTES + found * Self::BYTES_PER_FOUND
    }

    /// Bytes per candidate of a chunk.
    pub const BYTES_PER_FOUND: usize = size_of::<ContactCandidate>() + size_of::<SharedContact>();

    /// Context of thread number `thread` (0: the caller) with room for this many contacts.
    pub fn new(sealed: &Sealed, thread: usize, contacts: usize) -> Self {
        Self {
            arena: Arena::with_capacity(sealed.limits.arena_bytes),
            scratch: Arena::with_capacity(sealed.limits.scratch_bytes),
            group_search: GroupSearch::new(),
            searches: boxed(|| ElementSearch::IDLE),
            spaces: boxed(ChunkSpace::new),
            carried: ChunkSpace::new(),
            deferred: DeferredPairs::default(),
            found: Table::with_capacity(sealed.limits.found, ContactCandidate::NOTHING),
            shared: Table::with_capacity(sealed.limits.found, SharedContact::NOTHING),
            solids: SolidScratch::with_capacity(sealed.limits.facets, sealed.limits.faces),
            out: Self::buffer(sealed, thread, contacts),
        }
    }

    /// Output buffer of thread number `thread`, with room for this many contacts.
    pub fn buffer(sealed: &Sealed, thread: usize, contacts: usize) -> ContactBuffer {
        ContactBuffer::new(thread, sealed.law_state_len, contacts)
    }
}

/// Builds a boxed array without a temporary on the stack.
fn boxed<T: Debug, const N: usize>(make: impl FnMut() -> T) -> Box<[T; N]> {
    let made: Box<[T]> = std::iter::repeat_with(make).take(N).collect();
    made.try_into().expect("so many were made")
}
