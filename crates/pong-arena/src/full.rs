//! What is answered when something does not fit.

/// A request did not fit and was refused; whatever was there before is untouched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("asked for {asked} bytes where {free} of {capacity} are left; give it more when setting up")]
pub struct Full {
    /// What was asked for, bytes.
    pub asked: usize,
    /// What was left, bytes.
    pub free: usize,
    /// What there is in all, bytes.
    pub capacity: usize,
}
