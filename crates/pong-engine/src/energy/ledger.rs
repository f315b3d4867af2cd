//! Work and dissipation of a frame, or of all frames since the world began.

/// Work and dissipation of all contacts, or of those of one pair of movable groups.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LedgerEntry {
    /// Work done on the bodies, J.
    pub work: f64,
    /// Energy dissipated or dropped, J.
    pub dissipated: f64,
}

impl LedgerEntry {
    pub fn add(&mut self, other: &Self) {
        self.work += other.work;
        self.dissipated += other.dissipated;
    }
}
