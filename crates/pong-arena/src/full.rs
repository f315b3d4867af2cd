//! What is answered when something does not fit.

/// A request did not fit and was refused; whatever was there before is untouched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Full {
    /// What was asked for, bytes.
    pub asked: usize,
    /// What was left, bytes.
    pub free: usize,
    /// What there is in all, bytes.
    pub capacity: usize,
}

impl std::fmt::Display for Full {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { asked, free, capacity } = self;
        write!(f, "asked for {asked} bytes where {free} of {capacity} are left; give it more when setting up")
    }
}

impl std::error::Error for Full {}
