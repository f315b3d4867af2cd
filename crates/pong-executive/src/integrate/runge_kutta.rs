//! The classic Runge-Kutta method of fourth order:
//!
//! ```text
//! k₁ = f(t, x)   k₂ = f(t + h/2, x + h/2·k₁)   k₃ = f(t + h/2, x + h/2·k₂)   k₄ = f(t + h, x + h·k₃)
//! x' = x + h·(k₁ + 2k₂ + 2k₃ + k₄)/6
//! ```
//!
//! Orientations are integrated as rotation vectors since the start of the step (`state.rs`).

use super::Stages;
use crate::error::ExecutiveError;
use crate::state::{FreeState, Rates};
use crate::system::System;
use pong_geometry::Wrench;

/// Where a stage gets its contact wrench.
pub(crate) enum Contact<'a> {
    /// From the world, at every stage. The system holds that of the first.
    Fresh,
    /// Held over the step.
    Held(&'a [Wrench]),
}

/// Advances the states over a step. The system must be placed at the start.
pub(crate) fn runge_kutta(
    system: &mut System,
    states: &mut [FreeState],
    stages: &mut Stages,
    contact: &Contact<'_>,
    time: f64,
    h: f64,
) -> Result<(), ExecutiveError> {
    let mut trial = states.to_vec();
    rates(system, &trial, contact, time, &mut stages.0[0]);
    for (stage, share) in [(1, 0.5), (2, 0.5), (3, 1.0)] {
        for ((trial, state), rates) in trial.iter_mut().zip(&*states).zip(&stages.0[stage - 1]) {
            *trial = state.along(rates, share * h);
        }
        system.place(time + share * h, &trial);
        if let Contact::Fresh = contact {
            system.touch(time + share * h)?;
        }
        rates(system, &trial, contact, time + share * h, &mut stages.0[stage]);
    }
    let [a, b, c, d] = &stages.0;
    for (index, state) in states.iter_mut().enumerate() {
        let mean = Rates::runge_kutta_mean([&a[index], &b[index], &c[index], &d[index]]);
        *state = state.along(&mean, h).normalized();
    }
    Ok(())
}

fn rates(system: &mut System, states: &[FreeState], contact: &Contact<'_>, time: f64, out: &mut Vec<Rates>) {
    match contact {
        Contact::Held(wrenches) => system.rates(time, states, wrenches, out),
        Contact::Fresh => {
            let wrenches = std::mem::take(&mut system.contact);
            system.rates(time, states, &wrenches, out);
            system.contact = wrenches;
        }
    }
}
