//! What happened to a pair of movable groups between two commits.

use crate::energy::account::EnergyAccount;

/// A pair of movable groups since the last commit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Interval {
    /// All but what was taken and returned.
    pub sum: EnergyAccount,
    /// Work of the wrench as the host uses it, J.
    pub as_used: f64,
    /// Work of the wrench as it would have followed the motion, J.
    pub along_motion: f64,
    pub pushes: bool,
}
