//! Detection of motion with energy from nowhere.
//!
//! Contacts and springs are passive: they return only energy that they received. So without errors of the
//! integrator
//!
//! ```text
//! made = Δ(kinetic + potential + springs) + heat of springs − work of loads and of prescribed bodies − stored in contacts ≤ 0
//! ```
//!
//! where Δ and work count from a reference instant, at which the contacts stored their share. An integrator
//! makes some energy, and without bound at a step that is too long. A run is stopped where both are true:
//!
//! * a body moves farther in one step than the whole scene is large, and
//! * energy was made, a hundred times the energy that was there, was put in or is released in a fall over the
//!   size of the scene: bodies are ten times as fast as any known force can have made them.
//!
//! No step resolves such a motion, and no true motion can have the energy. Normal laws of the host may be
//! active, so scenes with such contacts are left alone.

use super::Simulation;
use super::reference::Reference;
use crate::error::{ExecutiveError, Result};
use pong_advise::{StoredEnergy, stored_energy};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Element, Item, MovableGroup};

/// Ratio of the energy made to the energy available at which a run is stopped.
const FACTOR: f64 = 100.0;

impl Simulation {
    /// Notes that states, set-up or surfaces were changed from outside.
    pub(super) fn disturbed(&mut self) {
        self.settled = false;
        self.reference = None;
        // Copies begin anew at the bodies, in a clone of the world as it is then; those of a late host go on.
        self.long_frames.host = None;
    }

    /// Takes the present instant as the reference if there is none.
    pub(super) fn refer_to_present(&mut self) {
        if self.reference.is_none() {
            let known = |pair: &StoredEnergy| if pair.not_known > 0 { f64::INFINITY } else { pair.energy };
            let stored = stored_energy(self.world()).map_or(0.0, |pairs| pairs.iter().map(known).sum());
            self.reference = Some(Reference { energy: self.energy(), stored, size: self.size() });
        }
    }

    /// # Errors
    /// [`ExecutiveError::Diverged`] if the last step made energy from nothing.
    pub(super) fn refuse_divergence(&self) -> Result<()> {
        let Some(reference) = self.reference else { return Ok(()) };
        let reach = reference.size / self.step;
        let fast = self.states.iter().position(|state| state.velocity.value().norm_squared() > reach * reach);
        match fast {
            Some(slot) if self.made_energy(&reference) => {
                let body = self.system.bodies[self.system.free[slot].0].name.clone();
                let kinetic = self.energy().kinetic;
                let what = format!("it has {kinetic:.3e} J, more than a hundred times what all forces gave");
                Err(ExecutiveError::Diverged { body, what, time: self.time(), cure: String::new() })
            }
            _ => Ok(()),
        }
    }

    fn made_energy(&self, reference: &Reference) -> bool {
        let (now, then) = (self.energy(), &reference.energy);
        let falls = then.potential - now.potential;
        let relaxes = then.springs - now.springs;
        let worked = now.work_in - then.work_in;
        let heat = now.spring_loss - then.spring_loss;
        let made = now.kinetic - then.kinetic - falls - relaxes + heat - worked - reference.stored;
        let sources = [falls, relaxes, worked].map(|source| source.max(0.0));
        let masses = self.system.free.iter().map(|(_, inertia)| inertia.mass).sum::<f64>();
        let weight = masses * self.system.gravity.norm() * reference.size;
        let there =
            then.kinetic + reference.stored + then.springs.abs() + sources.iter().sum::<f64>() + weight;
        made > FACTOR * there && !self.has_laws_of_the_host()
    }

    fn has_laws_of_the_host(&self) -> bool {
        stored_energy(self.world()).is_ok_and(|pairs| pairs.iter().any(|pair| pair.not_known > 0))
    }

    /// Diameter of the box around all bodies and their primitives, m; planes have no size.
    fn size(&self) -> f64 {
        let scene = self.world().inspect();
        let from = self.system.motions.first().map_or_else(Vec3::zeros, |(pose, _)| pose.position);
        let (mut low, mut high) = (Vec3::zeros(), Vec3::zeros());
        for (body, (pose, _)) in self.system.bodies.iter().zip(&self.system.motions) {
            let reach = body.interface.map_or(0.0, |interface| reach(scene.body(interface.index())));
            let place = pose.position - from;
            low = low.inf(&place.add_scalar(-reach));
            high = high.sup(&place.add_scalar(reach));
        }
        (high - low).norm()
    }

    /// The error of a body in a step that began at `from` (s), with the contact or spring that pushed it
    /// then.
    pub(super) fn divergence(&mut self, index: usize, what: &str, from: f64) -> ExecutiveError {
        let body = self.system.bodies[index].name.clone();
        let (time, plan) = (self.time(), self.step_plan());
        let pusher = self.pusher_within(index, from);
        let stable =
            self.acting_report(&plan).ok().filter(|_| pusher.is_some()).map(|acting| acting.stable_step);
        let maker =
            pusher.or_else(|| self.puller(index)).map_or_else(String::new, |maker| format!(", by {maker},"));
        // The states of the failed step stay the present ones.
        self.system.place(time, &self.states);
        self.settled = false;
        let cure = match stable.filter(|step| *step > 0.0 && *step < self.step) {
            Some(step) => format!("below {step:.3e} s"),
            None => String::new(),
        };
        ExecutiveError::Diverged { body, what: format!("{what}{maker}"), time, cure }
    }

    /// The contact that pushed a body within a step that began at `from` (s): at its start, or later, with
    /// the bodies moved on by their velocities.
    fn pusher_within(&mut self, index: usize, from: f64) -> Option<String> {
        [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().find_map(|part| {
            self.system.place(from, &self.earlier);
            for (pose, twist) in &mut self.system.motions {
                pose.position += part * self.step * twist.linear;
            }
            self.system.touch(from).ok()?;
            self.pusher(index)
        })
    }

    /// The pair of bodies with the largest contact force on a body in the last frame.
    fn pusher(&self, index: usize) -> Option<String> {
        let own = self.system.bodies[index].interface?;
        let contacts = self.world().contacts().into_iter();
        let on_it = contacts.filter(|contact| [contact.a.interface, contact.b.interface].contains(&own));
        let strongest = on_it.max_by(|x, y| x.normal_force.total_cmp(&y.normal_force))?;
        let [a, b] = [strongest.a.interface, strongest.b.interface].map(|interface| {
            let mut bodies = self.system.bodies.iter();
            bodies.find(|body| body.interface == Some(interface)).map_or("", |body| body.name.as_str())
        });
        Some(format!("the contact of `{a}` and `{b}`, {:.3e} m deep", strongest.depth))
    }

    /// The spring on a body with the most energy.
    fn puller(&self, index: usize) -> Option<String> {
        let springs = self.system.springs.iter();
        let on_it = springs.filter(|spring| {
            [spring.first, spring.second].iter().any(|end| end.body.is_some_and(|body| body.index() == index))
        });
        let energy = |spring: &crate::spring::Spring| self.system.spring_action(spring).energy;
        let strongest = on_it.max_by(|x, y| energy(x).total_cmp(&energy(y)))?;
        let [a, b] = [strongest.first, strongest.second]
            .map(|end| end.body.map_or("the ground", |body| self.system.bodies[body.index()].name.as_str()));
        Some(format!("the spring of `{a}` and `{b}`"))
    }
}

/// Radius about the group's origin of all primitives of finite size, m.
fn reach(body: &MovableGroup) -> f64 {
    let mut most = 0.0_f64;
    for (index, info) in
        body.primitives.iter().enumerate().filter(|(_, info)| info.kind != PrimitiveKind::Plane)
    {
        for element in info.elements.clone() {
            let (low, high) = Element::new(body, Item { primitive: index as u32, element }).extent();
            let far = low.abs().sup(&high.abs()).norm();
            most = if far.is_finite() { most.max(far) } else { most };
        }
    }
    most
}
