//! Energies of a pair of movable groups between two commits.

use crate::energy::account::EnergyAccount;

/// Energies of a pair of movable groups since the last commit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Interval {
    /// Sum of its contacts, without `work_in` and `work_out`.
    pub sum: EnergyAccount,
    /// Work of the wrench as the host applies it, J.
    pub as_used: f64,
    /// Work of forces that follow the motion, J.
    pub along_motion: f64,
    pub pushes: bool,
}
