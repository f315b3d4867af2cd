//! What happened to a pair of movable groups between two commits.

use crate::energy::account::Account;

/// A pair of movable groups since the last commit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Interval {
    /// All but what was taken and returned.
    pub sum: Account,
    /// Work of the wrench as the host uses it, and as it would have followed the motion.
    pub done: f64,
    pub followed: f64,
    pub pushes: bool,
}
