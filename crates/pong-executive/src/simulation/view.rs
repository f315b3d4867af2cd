//! What a simulation shows.

use super::Simulation;
use crate::body::{BodyId, RigidBody};
use crate::energy::Energy;
use crate::integrate::Integrator;
use crate::stability::longest_stable_step;
use crate::state::FreeState;
use pong_engine::{StiffestContact, World};
use pong_geometry::{Pose, Twist, Vec3, Wrench};

impl Simulation {
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

    /// Warnings about contacts for which the step is too long, each with the longest stable one (see
    /// [`longest_stable_step`]). Empty if none is certain; Hertz contacts and registered laws are not judged.
    pub fn step_warnings(&self) -> Vec<String> {
        let Ok(stiffest) = self.world().stiffest_contacts() else { return Vec::new() };
        stiffest.iter().filter_map(|contact| self.step_warning(contact)).collect()
    }

    fn step_warning(&self, contact: &StiffestContact) -> Option<String> {
        let touching =
            |interface| self.bodies().map(|(_, body)| body).find(|b| b.interface == Some(interface));
        let bodies = [touching(contact.interfaces[0])?, touching(contact.interfaces[1])?];
        // Fixed and prescribed bodies have no mass: they do not yield.
        let inverse: f64 = bodies.iter().filter_map(|body| body.mass()).map(|mass| 1.0 / mass.mass).sum();
        if inverse == 0.0 {
            return None;
        }
        let (k, c) = (contact.stiffness, contact.damping);
        let longest = longest_stable_step(self.integrator, k, c, 1.0 / inverse);
        // An undamped wrench held over a frame gains a little at any step; short ones are the user's choice.
        let held_undamped = longest == 0.0 && self.step * (k * inverse).sqrt() < 0.1;
        if self.step < longest || held_undamped {
            return None;
        }
        let cure = if longest > 0.0 {
            format!("the longest stable step is {longest:.3e} s, less where several touch at once")
        } else {
            "no step is stable without damping; give the surfaces some".to_owned()
        };
        Some(format!(
            "`{}` and `{}`: a contact of {k:.3e} N/m and {c:.3e} N·s/m on {:.3e} kg gains energy at a step of {:.3e} s; {cure}",
            bodies[0].name,
            bodies[1].name,
            1.0 / inverse,
            self.step
        ))
    }

    /// The world: contacts, wrenches and counts of the present instant.
    pub fn world(&self) -> &World {
        &self.system.world
    }

    /// The world, to forget, switch pairs or change surfaces between steps. The present states are evaluated and
    /// committed again before the next step.
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
}
