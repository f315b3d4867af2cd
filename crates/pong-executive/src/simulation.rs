//! The executive: bodies, loads and an integrator around a sealed world.

use crate::body::{BodyId, Motion, RigidBody};
use crate::energy::{Energy, Powers};
use crate::error::ExecutiveError;
use crate::integrate::{Contact, Held, Integrator, Stages, euler, hold, runge_kutta};
use crate::load::Load;
use crate::spring::Spring;
use crate::state::{FreeState, Inertia};
use crate::system::System;
use pong_engine::World;
use pong_geometry::{Pose, Twist, Vec3, Wrench};

/// Something that looks at a running simulation.
pub trait Observer {
    /// Called with states, wrenches and contacts that belong to one instant.
    ///
    /// # Errors
    /// An error ends the run.
    fn observe(&mut self, simulation: &Simulation) -> Result<(), ExecutiveError>;
}

impl<F: FnMut(&Simulation)> Observer for F {
    fn observe(&mut self, simulation: &Simulation) -> Result<(), ExecutiveError> {
        self(simulation);
        Ok(())
    }
}

/// Bodies in motion under gravity, loads, springs and contact.
pub struct Simulation {
    system: System,
    states: Vec<FreeState>,
    integrator: Integrator,
    step: f64,
    /// Time is `epoch + steps·step`: no rounding piles up.
    epoch: f64,
    steps: u64,
    /// Whether the world is evaluated and committed at the present states.
    settled: bool,
    stages: Stages,
    held: Held,
    powers: Powers,
    spring_loss: f64,
    work_in: f64,
}

impl Simulation {
    /// A simulation without bodies, from t = 0 with a step (s).
    pub fn new(world: World, integrator: Integrator, step: f64) -> Result<Self, ExecutiveError> {
        check_step(step)?;
        if let Integrator::ZeroOrderHold { substeps: 0, .. } = integrator {
            let cure = "give at least one substep";
            return Err(ExecutiveError::invalid(
                "zero-order hold",
                "0 substeps leave nothing to integrate",
                cure,
            ));
        }
        Ok(Self {
            system: System::new(world),
            states: Vec::new(),
            integrator,
            step,
            epoch: 0.0,
            steps: 0,
            settled: false,
            stages: Stages::default(),
            held: Held::default(),
            powers: Powers::default(),
            spring_loss: 0.0,
            work_in: 0.0,
        })
    }

    /// Adds a body. All bodies with an Interface must be there before the first step.
    pub fn add_body(&mut self, mut body: RigidBody) -> Result<BodyId, ExecutiveError> {
        let what = format!("body `{}`", body.name);
        if let Some(interface) = body.interface {
            if self.system.bodies.iter().any(|other| other.interface == Some(interface)) {
                let cure = "give each movable group one body";
                return Err(ExecutiveError::invalid(what, "its Interface already has a body", cure));
            }
            self.system.world.interface_path(interface)?;
        }
        let mut inertia = None;
        match &body.motion {
            Motion::Free(mass) => {
                mass.check(&body.name)?;
                inertia = Inertia::new(mass);
            }
            Motion::Fixed => body.twist = Twist::zero(),
            Motion::Prescribed(path) => (body.pose, body.twist) = path.at(self.time()),
        }
        if let Some(inertia) = &inertia {
            self.states.push(FreeState::of_motion(inertia, &body.pose, &body.twist));
        }
        self.system.push(body, inertia);
        self.settled = false;
        Ok(BodyId(self.system.bodies.len() - 1))
    }

    /// Adds a load.
    pub fn add_load(&mut self, load: Load) -> Result<(), ExecutiveError> {
        self.check_body("load", load.body)?;
        if let Some(cause) = load.history.fault() {
            return Err(fault("load", &cause));
        }
        self.system.loads.push(load);
        self.settled = false;
        Ok(())
    }

    /// Adds a spring.
    pub fn add_spring(&mut self, spring: Spring) -> Result<(), ExecutiveError> {
        for body in [spring.first.body, spring.second.body].into_iter().flatten() {
            self.check_body("spring", body)?;
        }
        if let Some(cause) = spring.fault() {
            return Err(fault("spring", &cause));
        }
        self.system.springs.push(spring);
        self.settled = false;
        Ok(())
    }

    /// Removes all loads: a release.
    pub fn clear_loads(&mut self) {
        self.system.loads.clear();
        self.settled = false;
    }

    /// Removes all springs.
    pub fn clear_springs(&mut self) {
        self.system.springs.clear();
        self.settled = false;
    }

    /// Sets uniform gravity, m/s², along the common axes.
    pub fn set_gravity(&mut self, gravity: Vec3) {
        self.system.gravity = gravity;
    }

    /// Puts a free or fixed body elsewhere. The contacts' past stays: call [`World::forget`] if it should not.
    pub fn set_motion(&mut self, body: BodyId, pose: Pose, twist: Twist) -> Result<(), ExecutiveError> {
        self.check_body("set_motion", body)?;
        let index = body.index();
        let name = &self.system.bodies[index].name;
        match &self.system.bodies[index].motion {
            Motion::Fixed => self.system.motions[index] = (pose, Twist::zero()),
            Motion::Free(_) => {
                let slot = self.system.free.iter().position(|(free, _)| *free == index);
                let slot = slot.expect("every free body is listed");
                self.states[slot] = FreeState::of_motion(&self.system.free[slot].1, &pose, &twist);
                self.system.motions[index] = (pose, twist);
            }
            Motion::Prescribed(_) => {
                let what = format!("body `{name}`");
                return Err(ExecutiveError::invalid(
                    what,
                    "its motion is prescribed",
                    "change its path instead",
                ));
            }
        }
        self.settled = false;
        Ok(())
    }

    /// Changes the step, s.
    pub fn set_step(&mut self, step: f64) -> Result<(), ExecutiveError> {
        check_step(step)?;
        (self.epoch, self.steps) = (self.time(), 0);
        self.step = step;
        Ok(())
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.epoch + self.steps as f64 * self.step
    }

    /// The step, s.
    pub fn step_length(&self) -> f64 {
        self.step
    }

    /// The integrator.
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// Evaluates and commits the present states if that has not been done: after set-up, so that contacts and
    /// wrenches can be read before the first step. [`step`](Self::step) does it by itself.
    pub fn settle(&mut self) -> Result<(), ExecutiveError> {
        if !self.settled {
            self.system.place(self.time(), &self.states);
            self.system.touch_and_commit(self.time())?;
            self.powers = self.system.powers(self.time());
            self.settled = true;
        }
        Ok(())
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// The engine's, or a state that is no longer finite.
    pub fn step(&mut self) -> Result<(), ExecutiveError> {
        self.settle()?;
        let (time, h) = (self.time(), self.step);
        let Self { system, states, stages, held, .. } = self;
        match self.integrator {
            Integrator::SemiImplicitEuler => euler(system, states, stages, time, h),
            Integrator::RungeKutta4 => runge_kutta(system, states, stages, &Contact::Fresh, time, h)?,
            Integrator::ZeroOrderHold { substeps, delay } => {
                hold(system, states, (stages, held), (substeps, delay), time, h)?;
            }
        }
        self.steps += 1;
        self.check_finite()?;
        let before = self.powers;
        self.settled = false;
        self.settle()?;
        self.spring_loss += 0.5 * h * (before.spring_heat + self.powers.spring_heat);
        self.work_in += 0.5 * h * (before.work_in + self.powers.work_in);
        Ok(())
    }

    /// Advances by the whole number of steps nearest to a duration (s).
    pub fn run_for(&mut self, duration: f64) -> Result<(), ExecutiveError> {
        let steps = libm::round(duration / self.step).max(0.0) as u64;
        for _ in 0..steps {
            self.step()?;
        }
        Ok(())
    }

    /// Advances by a number of steps; the observer sees the first instant and every `every`-th after it.
    pub fn observe(
        &mut self,
        steps: u64,
        every: u64,
        observer: &mut dyn Observer,
    ) -> Result<(), ExecutiveError> {
        self.settle()?;
        observer.observe(self)?;
        for done in 1..=steps {
            self.step()?;
            if done % every.max(1) == 0 {
                observer.observe(self)?;
            }
        }
        Ok(())
    }

    /// The world: contacts, wrenches and counts of the present instant.
    pub fn world(&self) -> &World {
        &self.system.world
    }

    /// The world, to forget, switch pairs or change surfaces between steps.
    pub fn world_mut(&mut self) -> &mut World {
        self.settled = false;
        &mut self.system.world
    }

    /// All bodies in the order in which they were added.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = (BodyId, &RigidBody)> {
        self.system.bodies.iter().enumerate().map(|(index, body)| (BodyId(index), body))
    }

    /// Pose of a body's group frame.
    pub fn pose(&self, body: BodyId) -> Pose {
        self.system.motions[body.index()].0
    }

    /// Twist of a body's group frame.
    pub fn twist(&self, body: BodyId) -> Twist {
        self.system.motions[body.index()].1
    }

    /// Contact wrench on a body about its group's origin, along the common axes.
    pub fn contact_wrench(&self, body: BodyId) -> Wrench {
        self.system.contact[body.index()]
    }

    /// Mass centre of a free body and its velocity, in the common frame.
    pub fn mass_center(&self, body: BodyId) -> Option<(Vec3, Vec3)> {
        self.free_state(body).map(|state| (state.position.value(), state.velocity.value()))
    }

    /// Angular momentum of a free body about its mass centre, along the common axes.
    pub fn angular_momentum(&self, body: BodyId) -> Option<Vec3> {
        self.free_state(body).map(|state| state.momentum)
    }

    /// Energies of the present instant.
    pub fn energy(&self) -> Energy {
        let mut energy = self.system.energy(&self.states);
        energy.spring_loss = self.spring_loss;
        energy.work_in = self.work_in;
        energy
    }

    fn free_state(&self, body: BodyId) -> Option<&FreeState> {
        let slot = self.system.free.iter().position(|(index, _)| *index == body.index())?;
        self.states.get(slot)
    }

    fn check_body(&self, what: &str, body: BodyId) -> Result<(), ExecutiveError> {
        if body.index() < self.system.bodies.len() {
            return Ok(());
        }
        let cause = format!("there is no body {}", body.index());
        Err(ExecutiveError::invalid(what, cause, "use an id that this simulation returned"))
    }

    fn check_finite(&self) -> Result<(), ExecutiveError> {
        match self.states.iter().position(|state| !state.is_finite()) {
            None => Ok(()),
            Some(slot) => {
                let body = self.system.bodies[self.system.free[slot].0].name.clone();
                Err(ExecutiveError::Diverged { body, time: self.time() })
            }
        }
    }
}

fn check_step(step: f64) -> Result<(), ExecutiveError> {
    if step > 0.0 && step.is_finite() {
        return Ok(());
    }
    Err(ExecutiveError::invalid("step", format!("it is {step} s"), "give a finite time above zero"))
}

/// An error from a line that holds cause and cure.
fn fault(what: &str, line: &str) -> ExecutiveError {
    let (cause, cure) = line.split_once("; ").unwrap_or((line, "correct it"));
    ExecutiveError::invalid(what, cause, cure)
}
