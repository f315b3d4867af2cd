//! The classic Runge-Kutta method of fourth order:
//!
//! ```text
//! k₁ = f(t, x)   k₂ = f(t + h/2, x + h/2·k₁)   k₃ = f(t + h/2, x + h/2·k₂)   k₄ = f(t + h, x + h·k₃)
//! x' = x + h·(k₁ + 2k₂ + 2k₃ + k₄)/6
//! ```
//!
//! Orientations are integrated as rotation vectors since the start of the step (`state.rs`).

use super::stages::{Pushed, Stages};
use crate::error::Result;
use crate::state::{FreeState, Rates};
use crate::system::System;
use pong_geometry::Wrench;

/// Source of a stage's contact wrench.
pub(crate) enum Contact<'a> {
    /// Evaluated by the world at every stage. The system holds the wrenches of the first.
    Fresh,
    /// Held over the step.
    Held(&'a [Wrench]),
}

impl Contact<'_> {
    /// The wrenches of a stage.
    fn wrenches<'s>(&'s self, system: &'s System) -> &'s [Wrench] {
        match self {
            Self::Fresh => &system.contact,
            Self::Held(wrenches) => wrenches,
        }
    }
}

/// Advances the states over a step. The bodies of the system must be placed at its start.
pub(crate) fn runge_kutta(
    system: &mut System,
    states: &mut [FreeState],
    stages: &mut Stages,
    contact: &Contact<'_>,
    time: f64,
    h: f64,
) -> Result<()> {
    let mut trial = states.to_vec();
    stages.pushed.begin(states.len());
    rates(system, &trial, contact, time, &mut stages.rates[0]);
    stages.pushed.add(system, &trial, contact, h / 6.0);
    stages.add_contact(contact.wrenches(system), h / 6.0);
    for (stage, share) in [(1, 0.5), (2, 0.5), (3, 1.0)] {
        for ((trial, state), rates) in trial.iter_mut().zip(&*states).zip(&stages.rates[stage - 1]) {
            *trial = state.along(rates, share * h);
        }
        system.place(time + share * h, &trial);
        if let Contact::Fresh = contact {
            system.touch(time + share * h)?;
        }
        rates(system, &trial, contact, time + share * h, &mut stages.rates[stage]);
        let weight = h / if stage == 3 { 6.0 } else { 3.0 };
        stages.pushed.add(system, &trial, contact, weight);
        stages.add_contact(contact.wrenches(system), weight);
    }
    let [a, b, c, d] = &stages.rates;
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

impl Pushed {
    fn begin(&mut self, bodies: usize) {
        self.impulses.clear();
        self.impulses.resize(bodies, Wrench::zero());
        self.work_on_led = 0.0;
    }

    /// Adds a stage with its weight (s). The engine itself accounts for held wrenches.
    fn add(&mut self, system: &System, states: &[FreeState], contact: &Contact<'_>, weight: f64) {
        let Contact::Fresh = contact else { return };
        for (((index, inertia), state), impulse) in system.free.iter().zip(states).zip(&mut self.impulses) {
            let wrench = &system.contact[*index];
            let arm = state.orientation * inertia.mass_center;
            impulse.force += wrench.force * weight;
            impulse.moment += (wrench.moment - arm.cross(&wrench.force)) * weight;
        }
        self.work_on_led += weight * system.power_on_led();
    }
}
