//! Normal force laws added by the host.

use std::fmt::Debug;

/// Input of a registered normal law.
#[derive(Clone, Copy, Debug)]
pub struct NormalInput<'a> {
    /// Depth δ > 0, m.
    pub depth: f64,
    /// Depth rate δ', m/s, positive while closing.
    pub rate: f64,
    /// Stiffness k of the pair, N/m.
    pub stiffness: f64,
    /// The law's parameters as the model gives them.
    pub parameters: &'a [f64],
}

/// A normal force law added by the host. It must be pure: equal inputs give equal outputs, from any thread.
pub trait NormalForce: Debug + Send + Sync {
    /// Force for weight 1, N. Negative values are treated as 0: a contact never pulls.
    fn force(&self, input: &NormalInput<'_>) -> f64;

    /// Energy stored at this depth for weight 1, J: the integral of the elastic part. Used by the ledger.
    fn stored(&self, input: &NormalInput<'_>) -> f64;
}
