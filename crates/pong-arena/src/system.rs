//! Memory of the system, checked before it is taken.
//!
//! Rust's collections abort the process where the system has no memory for them. A library that must return
//! an error instead adds up what its set-up will need and first requests it in one block. Another thread may
//! take the memory in between; that is not detected.

/// Refusal of memory by the system.
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

/// Requests this many bytes in one block and frees them.
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

/// Makes the allocator keep some free small blocks. The address space that threads reserve when they start
/// may leave no room for new ones.
pub fn keep_small_blocks_free() {
    const PIECES: usize = 64;
    const PIECE: usize = 1 << 10;
    let pieces: [Vec<u8>; PIECES] = std::array::from_fn(|_| Vec::with_capacity(PIECE));
    std::hint::black_box(&pieces);
}
