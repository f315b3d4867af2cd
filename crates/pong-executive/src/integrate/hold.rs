//! Zero-order hold: one contact wrench a frame, held until the next, with or without delay.

use super::runge_kutta::{Contact, runge_kutta};
use super::stages::Stages;
use crate::error::Result;
use crate::state::FreeState;
use crate::system::System;
use pong_geometry::Wrench;
use std::collections::VecDeque;

/// Queue of delayed wrenches between the contact engine and the bodies.
#[derive(Debug, Default)]
pub(crate) struct Held {
    pub waiting: VecDeque<Vec<Wrench>>,
}

impl Held {
    /// Queues the wrenches of this frame and returns those of `delay_frames` ago; zero before the first.
    pub fn exchange(&mut self, fresh: &[Wrench], delay_frames: u32) -> Vec<Wrench> {
        self.waiting.push_back(fresh.to_vec());
        if self.waiting.len() <= delay_frames as usize {
            return vec![Wrench::zero(); fresh.len()];
        }
        self.waiting.pop_front().unwrap_or_default()
    }
}

/// Advances the states over a frame.
pub(crate) fn hold(
    system: &mut System,
    states: &mut [FreeState],
    (stages, held): (&mut Stages, &mut Held),
    (substeps, delay_frames): (u32, u32),
    time: f64,
    frame: f64,
) -> Result<()> {
    let wrenches = held.exchange(&system.contact, delay_frames);
    let h = frame / f64::from(substeps);
    for substep in 0..substeps {
        let start = time + h * f64::from(substep);
        system.place(start, states);
        runge_kutta(system, states, stages, &Contact::Held(&wrenches), start, h)?;
    }
    Ok(())
}
