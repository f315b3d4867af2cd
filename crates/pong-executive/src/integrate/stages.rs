//! Derivatives and integrals of the stages of a step.

use crate::state::Rates;
use pong_geometry::Wrench;

/// Buffers of derivatives, kept from step to step.
#[derive(Debug, Default)]
pub(crate) struct Stages {
    pub rates: [Vec<Rates>; 4],
    /// Impulses and work of contact in the last step, if it was evaluated at stages.
    pub pushed: Pushed,
    /// ∫ contact wrench dt on every body over the last step, N·s and N·m·s about the origins of their groups,
    /// with the weights of the integrator; `None` unless a host wants them.
    pub contact_impulses: Option<Vec<Wrench>>,
}

impl Stages {
    /// Begins the integrals of a step.
    pub fn begin_step(&mut self, bodies: usize) {
        if let Some(impulses) = &mut self.contact_impulses {
            impulses.clear();
            impulses.resize(bodies, Wrench::zero());
        }
    }

    /// Adds the wrenches of a stage with its weight (s).
    pub fn add_contact(&mut self, wrenches: &[Wrench], weight: f64) {
        let Some(impulses) = &mut self.contact_impulses else { return };
        for (impulse, wrench) in impulses.iter_mut().zip(wrenches) {
            impulse.force += wrench.force * weight;
            impulse.moment += wrench.moment * weight;
        }
    }
}

/// Impulses and work of contact on the bodies over a step, with the weights of the stages.
#[derive(Debug, Default)]
pub(crate) struct Pushed {
    /// Impulse on every free body (N·s), and its moment about the mass centre (N·m·s).
    pub impulses: Vec<Wrench>,
    /// Work on prescribed and fixed bodies, J.
    pub work_on_led: f64,
}
