//! Semi-implicit Euler:  p' = p + h·F(x, v),  x' = x + h·v(p').

use super::stages::Stages;
use crate::state::FreeState;
use crate::system::System;

/// Advances the states over a step under the contact wrench that the system holds.
pub(crate) fn euler(system: &mut System, states: &mut [FreeState], stages: &mut Stages, time: f64, h: f64) {
    let contact = std::mem::take(&mut system.contact);
    system.rates(time, states, &contact, &mut stages.rates[0]);
    system.contact = contact;
    stages.add_contact(&system.contact, h);
    for (((_, inertia), state), rates) in system.free.iter().zip(states).zip(&stages.rates[0]) {
        *state = state.semi_implicit(inertia, rates, h);
    }
}
