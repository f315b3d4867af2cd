//! Contributions of a frame to the totals of work and dissipation.

/// Contribution of a frame to the ledger.
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
