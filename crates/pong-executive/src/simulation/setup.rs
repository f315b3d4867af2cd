//! Set-up of bodies, loads and springs, and their changes between steps.

use super::{Simulation, check_step};
use crate::body::{BodyId, Motion, RigidBody};
use crate::error::{ExecutiveError, Result};
use crate::integrate::Held;
use crate::load::Load;
use crate::mass::MassProperties;
use crate::path::Path;
use crate::spring::Spring;
use crate::state::{FreeState, Inertia};
use pong_geometry::{Pose, Twist, Vec3};

impl Simulation {
    /// Adds a body. All bodies with an Interface must be added before the first step.
    ///
    /// # Errors
    /// An Interface of another world, or one that already has a body; mass properties that no body can have.
    pub fn add_body(&mut self, mut body: RigidBody) -> Result<BodyId> {
        let what = format!("body `{}`", body.name);
        if let Some(interface) = body.interface {
            if self.system.bodies.iter().any(|other| other.interface == Some(interface)) {
                let cure = "give each movable group one body";
                return Err(ExecutiveError::invalid(what, "its Interface already has a body", cure));
            }
            self.system.world.scene().interface_path(interface)?;
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
        self.disturbed();
        Ok(BodyId(self.system.bodies.len() - 1))
    }

    /// Adds a load.
    ///
    /// # Errors
    /// A body that is not there; a value that is not finite.
    pub fn add_load(&mut self, load: Load) -> Result<()> {
        self.check_body("load", load.body)?;
        if let Some(cause) = load.history.fault() {
            return Err(fault("load", &cause));
        }
        self.system.loads.push(load);
        self.powers = self.system.powers(self.time());
        Ok(())
    }

    /// Adds a spring.
    ///
    /// # Errors
    /// A body that is not there; stiffness or damping below zero or not finite.
    pub fn add_spring(&mut self, spring: Spring) -> Result<()> {
        for body in [spring.first.body, spring.second.body].into_iter().flatten() {
            self.check_body("spring", body)?;
        }
        if let Some(cause) = spring.fault() {
            return Err(fault("spring", &cause));
        }
        self.system.springs.push(spring);
        self.reference = None;
        self.powers = self.system.powers(self.time());
        Ok(())
    }

    /// Removes all loads, as for a release.
    pub fn clear_loads(&mut self) {
        self.system.loads.clear();
        self.powers = self.system.powers(self.time());
    }

    /// Removes all springs.
    pub fn clear_springs(&mut self) {
        self.system.springs.clear();
        self.reference = None;
        self.powers = self.system.powers(self.time());
    }

    /// Replaces a spring, given by its index in the order in which springs were added: other values, or other
    /// ends.
    ///
    /// # Errors
    /// An index that no spring has; as [`add_spring`](Self::add_spring). The spring is then unchanged.
    pub fn set_spring(&mut self, number: usize, spring: Spring) -> Result<()> {
        let what = format!("spring {number}");
        let count = self.system.springs.len();
        if number >= count {
            let cause = format!("there are {count} springs, counted from 0");
            return Err(ExecutiveError::invalid(what, cause, "give the number of one of them"));
        }
        for body in [spring.first.body, spring.second.body].into_iter().flatten() {
            self.check_body(&what, body)?;
        }
        if let Some(cause) = spring.fault() {
            return Err(fault(&what, &cause));
        }
        self.system.springs[number] = spring;
        self.reference = None;
        self.powers = self.system.powers(self.time());
        Ok(())
    }

    /// Gives a free body other mass properties. Its group frame keeps its pose and twist, so that momentum
    /// and energy change.
    ///
    /// # Errors
    /// A body that does not exist or is not free; mass properties that no body can have. The body is then
    /// unchanged.
    pub fn set_mass(&mut self, body: BodyId, mass: MassProperties) -> Result<()> {
        self.check_body("set_mass", body)?;
        let index = body.index();
        let name = &self.system.bodies[index].name;
        mass.check(name)?;
        let slot = self.system.free.iter().position(|(free, _)| *free == index);
        // The check refuses every tensor that has no inverse.
        let (Some(slot), Some(inertia)) = (slot, Inertia::new(&mass)) else {
            let cause = "it is not free, so that no mass has an effect on its motion";
            return Err(ExecutiveError::invalid(format!("body `{name}`"), cause, "name a free body"));
        };
        let (pose, twist) = &self.system.motions[index];
        self.states[slot] = FreeState::of_motion(&inertia, pose, twist);
        self.system.free[slot].1 = inertia;
        self.system.bodies[index].motion = Motion::Free(mass);
        self.disturbed();
        Ok(())
    }

    /// Sets uniform gravity, m/s², along the common axes.
    pub fn set_gravity(&mut self, gravity: Vec3) {
        self.system.gravity = gravity;
        self.reference = None;
    }

    /// Sets the pose and twist of a free or fixed body. The contact history stays; to drop it call
    /// [`clear_contact_history`](Self::clear_contact_history).
    ///
    /// # Errors
    /// A body that does not exist or is on a prescribed path; a pose or twist that is not finite.
    pub fn set_motion(&mut self, body: BodyId, pose: Pose, twist: Twist) -> Result<()> {
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
        self.disturbed();
        Ok(())
    }

    /// Drops the contact history of all bodies, and the wrenches that a zero-order hold still delays: for a new
    /// start, after the bodies are moved to other states. Time, states, masses and surfaces stay.
    ///
    /// # Errors
    /// None that the caller can cause.
    pub fn clear_contact_history(&mut self) -> Result<()> {
        let objects: Vec<_> = self.system.world.scene().objects().collect();
        for object in objects {
            self.system.world.clear_contact_history(object)?;
        }
        self.held = Held::default();
        self.long_frames.begin_anew(None);
        self.disturbed();
        Ok(())
    }

    /// Moves a body from outside: it has this pose at a time (s) and moves on with this twist, whatever the
    /// forces, until the next call. A free body is no longer free.
    ///
    /// # Errors
    /// A body that does not exist; a time, pose or twist that is not finite.
    pub fn lead(&mut self, body: BodyId, since: f64, pose: Pose, twist: Twist) -> Result<()> {
        self.check_body("lead", body)?;
        let index = body.index();
        let values = [pose.position, twist.linear, twist.angular, pose.orientation.imag()];
        if !since.is_finite() || values.iter().flatten().any(|x| !x.is_finite()) {
            let what = format!("body `{}`", self.system.bodies[index].name);
            let cause = "it is led to a time, pose or twist that is not finite";
            return Err(ExecutiveError::invalid(what, cause, "give finite numbers"));
        }
        if let Some(slot) = self.system.free.iter().position(|(free, _)| *free == index) {
            self.system.free.remove(slot);
            self.states.remove(slot);
            self.reference = None;
        }
        self.system.bodies[index].motion = Motion::Prescribed(Path::Led { since, pose, twist });
        self.system.motions[index] = (pose, twist);
        self.settled = false;
        Ok(())
    }

    /// Changes the step, s.
    ///
    /// # Errors
    /// A step that is not positive and finite.
    pub fn set_step(&mut self, step: f64) -> Result<()> {
        check_step(step)?;
        (self.epoch, self.steps) = (self.time(), 0);
        self.step = step;
        Ok(())
    }

    pub(super) fn check_body(&self, what: &str, body: BodyId) -> Result<()> {
        if body.index() < self.system.bodies.len() {
            return Ok(());
        }
        let cause = format!("there is no body {}", body.index());
        Err(ExecutiveError::invalid(what, cause, "use an id that this simulation returned"))
    }
}

/// An error from a line with cause and cure.
fn fault(what: &str, line: &str) -> ExecutiveError {
    let (cause, cure) = line.split_once("; ").unwrap_or((line, "correct it"));
    ExecutiveError::invalid(what, cause, cure)
}
