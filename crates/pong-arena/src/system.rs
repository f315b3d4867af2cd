//! Check that the system has enough memory, before memory is taken.
//!
//! Rust's collections abort the process if the system has no memory for them. A library that must return an
//! error instead adds up the memory that its set-up will need, and first requests all of it in one block. If
//! another thread takes the memory in between, this is not detected.

/// Error: the system refused to give memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: the system does not give {bytes} bytes of memory; {cure}")]
pub struct OutOfMemory {
    /// Purpose of the memory.
    pub what: &'static str,
    /// Size of the request, bytes.
    pub bytes: usize,
    /// Suggested remedy.
    pub cure: &'static str,
}

/// Tests whether the system gives this many bytes: requests them in one block and frees them.
///
/// ```
/// let refused = pong_arena::require_memory("table", usize::MAX / 2, "give it fewer rows").unwrap_err();
/// assert!(refused.to_string().starts_with("table: the system does not give"));
/// ```
///
/// # Errors
/// [`OutOfMemory`] if the system refuses. Creating the error does not allocate.
pub fn require_memory(what: &'static str, bytes: usize, cure: &'static str) -> Result<(), OutOfMemory> {
    let mut block = Vec::<u8>::new();
    let outcome = block.try_reserve_exact(bytes);
    // Keeps the compiler from removing the unused allocation.
    std::hint::black_box(block.as_mut_ptr());
    outcome.map_err(|_| OutOfMemory { what, bytes, cure })
}

/// Makes the allocator keep some small blocks free. This is needed because the address space that threads
/// reserve when they start may leave no room for new blocks.
pub fn keep_small_blocks_free() {
    const PIECES: usize = 64;
    const PIECE: usize = 1 << 10;
    let pieces: [Vec<u8>; PIECES] = std::array::from_fn(|_| Vec::with_capacity(PIECE));
    std::hint::black_box(&pieces);
}
