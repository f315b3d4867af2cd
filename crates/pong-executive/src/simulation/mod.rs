//! The executive: bodies, loads and an integrator around a sealed world.

mod checkpoint;
mod divergence;
mod exchange;
mod linear;
mod reference;
mod setup;
mod start;
mod view;

use crate::body::BodyId;
use crate::energy::Powers;
use crate::error::{ExecutiveError, Result};
use crate::integrate::{
    Contact, Held, Integrator, LongFrames, Stages, euler, hold, long_frame_settings, runge_kutta,
};
use crate::state::FreeState;
use crate::system::System;
pub use linear::Linearised;
use pong_engine::{FrictionPreload, PairId, World};
use pong_geometry::Wrench;
use reference::Reference;

/// An observer of a running simulation.
pub trait Observer {
    /// Called with states, wrenches and contacts that belong to one instant.
    ///
    /// # Errors
    /// An error ends the run.
    fn observe(&mut self, simulation: &Simulation) -> Result<()>;
}

impl<F: FnMut(&Simulation)> Observer for F {
    fn observe(&mut self, simulation: &Simulation) -> Result<()> {
        self(simulation);
        Ok(())
    }
}

/// Bodies in motion under gravity, loads, springs and contact.
pub struct Simulation {
    system: System,
    states: Vec<FreeState>,
    /// States that an external integrator tries.
    trial: Vec<FreeState>,
    /// States of the step before.
    earlier: Vec<FreeState>,
    integrator: Integrator,
    step: f64,
    /// Time is `epoch + steps·step`, so that no rounding accumulates.
    epoch: f64,
    steps: u64,
    /// True if the world is evaluated and committed at the present states.
    settled: bool,
    stages: Stages,
    held: Held,
    long_frames: LongFrames,
    powers: Powers,
    spring_loss: f64,
    work_in: f64,
    /// Work of contact on the bodies, J, if contact is evaluated at stages.
    contact_work: Option<f64>,
    /// Reference energies of the motion; `None` until the next step after a change.
    reference: Option<Reference>,
}

impl Simulation {
    /// A simulation without bodies, from t = 0 with a step (s).
    ///
    /// # Errors
    /// A step that is not positive and finite; a zero-order hold without substeps.
    pub fn new(world: World, integrator: Integrator, step: f64) -> Result<Self> {
        check_step(step)?;
        if let Integrator::ZeroOrderHold { substeps: 0, .. } = integrator {
            let cure = "give at least one substep";
            return Err(ExecutiveError::invalid(
                "zero-order hold",
                "0 substeps leave nothing to integrate",
                cure,
            ));
        }
        if let Integrator::LongFrame { substeps_max, delay_frames } = integrator {
            // Refuses settings outside their ranges.
            LongFrames::default().prepare(&world, long_frame_settings(substeps_max, delay_frames))?;
        }
        Ok(Self {
            system: System::new(world),
            states: Vec::new(),
            trial: Vec::new(),
            earlier: Vec::new(),
            integrator,
            step,
            epoch: 0.0,
            steps: 0,
            settled: false,
            stages: Stages::default(),
            held: Held::default(),
            long_frames: LongFrames::default(),
            powers: Powers::default(),
            spring_loss: 0.0,
            work_in: 0.0,
            contact_work: (integrator == Integrator::RungeKutta4).then_some(0.0),
            reference: None,
        })
    }

    /// Evaluates and commits the present states if that has not been done: after set-up, so that contacts and
    /// wrenches can be read before the first step. [`step`](Self::step) does it by itself.
    ///
    /// # Errors
    /// A state that the world refuses; a frame whose forces leave the range of numbers.
    pub fn commit_initial_states(&mut self) -> Result<()> {
        if !self.settled {
            self.system.place(self.time(), &self.states);
            self.system.touch_and_commit(self.time())?;
            self.follow_copies()?;
            self.powers = self.system.powers(self.time());
            self.settled = true;
        }
        Ok(())
    }

    /// Replaces the wrenches of contact by those to hold over a long frame.
    fn follow_copies(&mut self) -> Result<()> {
        let Integrator::LongFrame { substeps_max, delay_frames } = self.integrator else { return Ok(()) };
        let settings = long_frame_settings(substeps_max, delay_frames);
        let times = (self.time(), self.step);
        self.long_frames.follow(&mut self.system, &self.states, settings, times)
    }

    /// Preloads friction between two paired Objects as they are placed now ([`World::preload_friction`]): before the first step.
    ///
    /// # Errors
    /// A pair of another world; states or forces that the world refuses.
    pub fn preload_friction(&mut self, pair: PairId, preload: &FrictionPreload) -> Result<usize> {
        let time = self.time();
        self.system.place(time, &self.states);
        let set = self.system.preload_friction(time, pair, preload)?;
        self.disturbed();
        Ok(set)
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// The engine's, a state that is no longer finite, or a motion with a hundred times the energy that all forces gave it
    /// ([`ExecutiveError::Diverged`]).
    pub fn step(&mut self) -> Result<()> {
        self.commit_initial_states()?;
        self.refer_to_present();
        let time = self.time();
        match self.advance().and_then(|()| self.refuse_divergence()) {
            Err(ExecutiveError::Diverged { body, what, .. }) => {
                let index = self.system.bodies.iter().position(|known| known.name == body);
                Err(self.divergence(index.unwrap_or_default(), &what, time))
            }
            ended => ended,
        }
    }

    /// One step from committed states.
    fn advance(&mut self) -> Result<()> {
        let (time, h) = (self.time(), self.step);
        self.earlier.clone_from(&self.states);
        self.stages.begin_step(self.system.bodies.len());
        let Self { system, states, stages, held, .. } = self;
        match self.integrator {
            Integrator::SemiImplicitEuler => euler(system, states, stages, time, h),
            Integrator::RungeKutta4 => runge_kutta(system, states, stages, &Contact::Fresh, time, h)?,
            Integrator::ZeroOrderHold { substeps, delay_frames } => {
                hold(system, states, (stages, held), (substeps, delay_frames), time, h)?;
            }
            Integrator::LongFrame { delay_frames, .. } => {
                system.contact = held.exchange(&system.contact, delay_frames);
                euler(system, states, stages, time, h);
            }
        }
        self.steps += 1;
        let before = self.powers;
        self.settled = false;
        self.commit_initial_states()?;
        self.spring_loss += 0.5 * h * (before.spring_heat + self.powers.spring_heat);
        self.work_in += 0.5 * h * (before.work_in + self.powers.work_in);
        match &mut self.contact_work {
            Some(work) => {
                let pushed = &self.stages.pushed;
                *work += self.system.contact_work(&self.earlier, &self.states, pushed, h);
                self.work_in -= pushed.work_on_led;
            }
            None => self.work_in -= 0.5 * h * (before.on_led + self.powers.on_led),
        }
        Ok(())
    }

    /// Turns on [`contact_impulse`](Self::contact_impulse) for the following steps.
    pub fn keep_contact_impulses(&mut self) {
        self.stages.contact_impulses.get_or_insert_default();
    }

    /// ∫ contact wrench dt on a body over the last step, with the integrator's weights: N·s, and N·m·s about
    /// the origin of its group, along the common axes. `None` before the first step, or unless [turned
    /// on](Self::keep_contact_impulses).
    pub fn contact_impulse(&self, body: BodyId) -> Option<Wrench> {
        self.stages.contact_impulses.as_ref()?.get(body.index()).copied()
    }

    /// Advances by the whole number of steps nearest to a duration (s).
    ///
    /// # Errors
    /// As a step: see [`commit_initial_states`](Self::commit_initial_states).
    pub fn run_for(&mut self, duration: f64) -> Result<()> {
        let steps = libm::round(duration / self.step).max(0.0) as u64;
        for _ in 0..steps {
            self.step()?;
        }
        Ok(())
    }

    /// Advances by a number of steps; the observer sees the first instant and every `every`-th after it.
    ///
    /// # Errors
    /// As a step: see [`commit_initial_states`](Self::commit_initial_states); also the observer's errors.
    pub fn observe(&mut self, steps: u64, every: u64, observer: &mut dyn Observer) -> Result<()> {
        self.commit_initial_states()?;
        observer.observe(self)?;
        for done in 1..=steps {
            self.step()?;
            if done % every.max(1) == 0 {
                observer.observe(self)?;
            }
        }
        Ok(())
    }
}

fn check_step(step: f64) -> Result<()> {
    if step > 0.0 && step.is_finite() {
        return Ok(());
    }
    Err(ExecutiveError::invalid("step", format!("it is {step} s"), "give a finite time above zero"))
}
