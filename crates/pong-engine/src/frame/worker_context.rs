//! What the calling thread or a worker writes while it works.

use crate::frame::broad_phase::candidate_pairs::CandidatePairs;
use crate::frame::broad_phase::chunk::ChunkSpace;
use crate::frame::broad_phase::lone_element::{LONE_MAX, LoneElement};
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::load_sharing::solver::SharedContact;
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::frame::narrow_phase::element_pair::DeferredPairs;
use crate::sealed::Sealed;
use pong_arena::{Arena, Table};
use std::fmt::Debug;

/// The memory of the calling thread or of a worker.
///
/// What a block fills one chunk after another stands in tables: they are there before it begins.
#[derive(Debug)]
pub(crate) struct WorkerContext {
    /// The broad phase at work: gone with the block.
    pub arena: Arena,
    /// For one solution among contacts of one key.
    pub scratch: Arena,
    pub(crate) candidates: CandidatePairs,
    /// The ways of elements by themselves that go down trees together. Boxed, as what follows: a context is made on the stack.
    pub(crate) lone: Box<[LoneElement; LONE_MAX]>,
    /// Each of them in B's frame.
    pub(crate) lone_carried: Box<[ChunkSpace; LONE_MAX]>,
    /// A chunk of A in B's frame. Not boxed: of all that a block asks for it is asked most often.
    pub(crate) carried: ChunkSpace,
    pub(crate) deferred: DeferredPairs,
    /// What contact testers find for a chunk.
    pub(crate) found: Table<ContactCandidate>,
    /// Those that share a spring.
    pub(crate) shared: Table<SharedContact>,
    pub out: ContactBuffer,
}

impl WorkerContext {
    /// Bytes of what does not grow with the contacts of a frame, the arenas aside: with room for so many interferences of one
    /// chunk.
    pub fn table_bytes(found: usize) -> usize {
        let lone = size_of::<LoneElement>() + size_of::<ChunkSpace>() + ChunkSpace::BYTES;
        LONE_MAX * lone + ChunkSpace::BYTES + found * Self::BYTES_PER_FOUND
    }

    /// Bytes of one interference of a chunk.
    pub const BYTES_PER_FOUND: usize = size_of::<ContactCandidate>() + size_of::<SharedContact>();

    /// The context of a lane, 0 for the caller's, with room for so many contacts.
    pub fn new(sealed: &Sealed, lane: usize, contacts: usize) -> Self {
        Self {
            arena: Arena::with_capacity(sealed.limits.arena_bytes),
            scratch: Arena::with_capacity(sealed.limits.scratch_bytes),
            candidates: CandidatePairs::new(),
            lone: boxed(|| LoneElement::NONE),
            lone_carried: boxed(ChunkSpace::new),
            carried: ChunkSpace::new(),
            deferred: DeferredPairs::default(),
            found: Table::with_capacity(sealed.limits.found, ContactCandidate::NOTHING),
            shared: Table::with_capacity(sealed.limits.found, SharedContact::NOTHING),
            out: Self::buffer(sealed, lane, contacts),
        }
    }

    /// For what a lane finds.
    pub fn buffer(sealed: &Sealed, lane: usize, contacts: usize) -> ContactBuffer {
        ContactBuffer::new(lane, sealed.law_state_len, contacts, sealed.limits.lane_records())
    }
}

/// As many as an array has, without an array on the stack.
fn boxed<T: Debug, const N: usize>(make: impl FnMut() -> T) -> Box<[T; N]> {
    let made: Box<[T]> = std::iter::repeat_with(make).take(N).collect();
    made.try_into().expect("so many were made")
}
