//! For external integrators: the states of the free bodies as numbers, and their rates at any states that
//! such an integrator tries. Only states that it accepts are committed.
//!
//! Under an external integrator, poses, twists and wrenches are those of the last states tried or accepted.

use super::Simulation;
use crate::body::BodyId;
use crate::error::{ExecutiveError, Result};
use crate::state::{FreeState, STATE_NUMBERS};
use pong_geometry::Wrench;

impl Simulation {
    /// Number of values in the state of one free body, in this order: position of the mass centre (3, m), its
    /// velocity (3, m/s), orientation (4: w, x, y, z), angular momentum about the mass centre (3, kg·m²/s),
    /// all along the common axes.
    pub const STATE_NUMBERS: usize = STATE_NUMBERS;

    /// The free bodies, in the order of their states.
    pub fn free_bodies(&self) -> impl ExactSizeIterator<Item = BodyId> + '_ {
        self.system.free.iter().map(|(index, _)| BodyId(*index))
    }

    /// The states of all free bodies at the present instant, [`STATE_NUMBERS`](Self::STATE_NUMBERS) for each.
    pub fn state_numbers(&self) -> Vec<f64> {
        self.states.iter().flat_map(FreeState::numbers).collect()
    }

    /// Evaluates contact at states that an integrator tries at a time (s), and returns their rates. Nothing
    /// is remembered. Quaternions are normalised internally; their rates are those of the quaternions as
    /// given.
    ///
    /// # Errors
    /// A number of values other than that of the free bodies; states that no engine accepts: shorten the
    /// step.
    pub fn try_states(&mut self, time: f64, numbers: &[f64], rates: &mut [f64]) -> Result<()> {
        self.place_trial(time, numbers, rates.len())?;
        self.system.touch(time)?;
        self.write_rates(time, numbers, rates);
        Ok(())
    }

    /// As [`try_states`](Self::try_states), and commits the states: once for every step that the integrator
    /// accepts. From here on they are the present instant.
    ///
    /// # Errors
    /// As [`try_states`](Self::try_states); the instant before stays the present one.
    pub fn accept_states(&mut self, time: f64, numbers: &[f64], rates: &mut [f64]) -> Result<()> {
        self.place_trial(time, numbers, rates.len())?;
        self.system.commit(time)?;
        self.states.clone_from(&self.trial);
        (self.epoch, self.steps) = (time, 0);
        self.powers = self.system.powers(time);
        self.settled = true;
        self.write_rates(time, numbers, rates);
        Ok(())
    }

    /// Sets the present time, s, which loads and paths follow.
    ///
    /// # Errors
    /// A time that is not finite.
    pub fn set_time(&mut self, time: f64) -> Result<()> {
        if !time.is_finite() {
            return Err(ExecutiveError::invalid("time", format!("it is {time} s"), "give a finite time"));
        }
        (self.epoch, self.steps) = (time, 0);
        self.settled = false;
        Ok(())
    }

    /// Sets the external wrench of the host on a body, added to the loads of the scene, about its group's
    /// origin along the common axes. It stays until it is set again.
    ///
    /// # Errors
    /// A body that does not exist; a value that is not finite.
    pub fn set_external_wrench(&mut self, body: BodyId, wrench: Wrench) -> Result<()> {
        self.check_body("external wrench", body)?;
        if !wrench.force.iter().chain(&wrench.moment).all(|x| x.is_finite()) {
            let what = format!("external wrench on `{}`", self.system.bodies[body.index()].name);
            let cause = "it holds a value that is not finite";
            return Err(ExecutiveError::invalid(what, cause, "give finite forces and moments"));
        }
        self.system.external[body.index()] = wrench;
        self.powers = self.system.powers(self.time());
        Ok(())
    }

    /// Moves the bodies to states given as numbers; these are the trial from here on.
    fn place_trial(&mut self, time: f64, numbers: &[f64], rates: usize) -> Result<()> {
        let wanted = STATE_NUMBERS * self.states.len();
        if numbers.len() != wanted || rates != wanted {
            let cause = format!(
                "{} states and room for {rates} rates were given where the free bodies have {wanted}",
                numbers.len()
            );
            let cure = format!("give {STATE_NUMBERS} for each free body");
            return Err(ExecutiveError::invalid("states of the free bodies", cause, cure));
        }
        self.trial.clear();
        for (numbers, (index, _)) in numbers.as_chunks().0.iter().zip(&self.system.free) {
            let Some(state) = FreeState::of_numbers(numbers) else {
                return Err(ExecutiveError::no_longer_finite(&self.system.bodies[*index].name, time));
            };
            self.trial.push(state);
        }
        self.settled = false;
        self.system.place(time, &self.trial);
        Ok(())
    }

    fn write_rates(&mut self, time: f64, numbers: &[f64], out: &mut [f64]) {
        let Self { system, trial, stages, .. } = self;
        let contact = std::mem::take(&mut system.contact);
        system.rates(time, trial, &contact, &mut stages.rates[0]);
        system.contact = contact;
        let given = numbers.as_chunks().0.iter().zip(out.as_chunks_mut().0);
        for ((state, rates), (numbers, out)) in trial.iter().zip(&stages.rates[0]).zip(given) {
            *out = state.rate_numbers(numbers, rates);
        }
    }
}
