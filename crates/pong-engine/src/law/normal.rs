//! Normal force laws that a user adds.

use std::fmt::Debug;

/// What a registered normal law is given.
#[derive(Clone, Copy, Debug)]
pub struct NormalInput<'a> {
    /// Depth δ > 0, m.
    pub depth: f64,
    /// Depth rate δ', m/s, positive while closing.
    pub rate: f64,
    /// Stiffness k of the pair: N/m.
    pub stiffness: f64,
    /// The law's parameters as the model gives them.
    pub parameters: &'a [f64],
}

/// A normal force law added by the user. It must be pure: the same input gives the same output, from any thread.
pub trait NormalForce: Debug + Send + Sync {
    /// Force of a whole contact (weight 1), N. Negative values are taken as 0: a contact never pulls.
    fn force(&self, input: &NormalInput<'_>) -> f64;

    /// Energy stored at this depth by a whole contact, J: the integral of the elastic part. Used by the ledger.
    fn stored(&self, input: &NormalInput<'_>) -> f64;
}
