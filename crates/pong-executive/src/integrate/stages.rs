//! What the stages of a step leave behind.

use crate::state::Rates;
use pong_geometry::Wrench;

/// Room for derivatives, kept from step to step.
#[derive(Debug, Default)]
pub(crate) struct Stages {
    pub rates: [Vec<Rates>; 4],
    /// What contact did to the bodies in the last step, if it was evaluated at stages.
    pub pushed: Pushed,
}

/// What contact did to the bodies over a step, with the weights of the stages.
#[derive(Debug, Default)]
pub(crate) struct Pushed {
    /// On every free body, of the force (N·s) and of its moment about the mass centre (N·m·s).
    pub impulses: Vec<Wrench>,
    /// Work on the bodies that are led or fixed, J.
    pub work_on_led: f64,
}
