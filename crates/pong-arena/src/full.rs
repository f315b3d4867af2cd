//! Error of a request that does not fit into its memory.

/// Error of a request that does not fit. Everything handed out before is untouched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("asked for {asked} bytes where {free} of {capacity} are left; give it more when setting up")]
pub struct Full {
    /// Size of the request, bytes.
    pub asked: usize,
    /// Bytes left.
    pub free: usize,
    /// Capacity in all, bytes.
    pub capacity: usize,
}
