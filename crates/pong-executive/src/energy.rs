//! Where the energy is, and where it went.
//!
//! ```text
//! kinetic + potential + springs + contacts + dissipated − work_in = constant
//! ```
//!
//! up to the order of the integrator. Contact terms are the engine's ledger: they are zero unless the world keeps it.

use crate::body::Motion;
use crate::simulation::Simulation;
use crate::state::FreeState;
use crate::system::System;
use pong_engine::{PairAccount, Verdict, WrenchUse};
use pong_geometry::{Twist, Wrench};

/// Energies, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Of the free bodies.
    pub kinetic: f64,
    /// Of the free bodies in uniform gravity; zero at the common origin.
    pub potential: f64,
    /// In springs, less what their preloads did.
    pub springs: f64,
    /// In contacts.
    pub contacts: f64,
    /// Lost in contacts since the start.
    pub contact_loss: f64,
    /// Made since the start by holding contact wrenches over steps: work that the forces would not have done as they follow
    /// the motion. The balance drifts by it. Zero unless the world keeps accounts.
    pub contact_made: f64,
    /// Lost in dampers of springs since the start.
    pub spring_loss: f64,
    /// Work since the start of loads on free bodies, and of prescribed bodies on what they push.
    pub work_in: f64,
}

impl Energy {
    /// Kinetic, potential and stored energy.
    pub fn mechanical(&self) -> f64 {
        self.kinetic + self.potential + self.springs + self.contacts
    }

    /// What stays constant.
    pub fn balance(&self) -> f64 {
        self.mechanical() + self.contact_loss + self.spring_loss - self.work_in
    }
}

/// Powers that cross the border of the system.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Powers {
    pub spring_heat: f64,
    pub work_in: f64,
}

fn power(wrench: &Wrench, twist: &Twist) -> f64 {
    wrench.force.dot(&twist.linear) + wrench.moment.dot(&twist.angular)
}

impl System {
    /// Powers at the instant last placed and touched.
    pub fn powers(&self, time: f64) -> Powers {
        let mut powers = Powers::default();
        let is_free = |index: usize| matches!(self.bodies[index].motion, Motion::Free(_));
        for load in self.loads.iter().filter(|load| is_free(load.body.index())) {
            let (pose, twist) = &self.motions[load.body.index()];
            powers.work_in += power(&load.wrench(time, pose), twist);
        }
        for spring in &self.springs {
            let action = self.spring_action(spring);
            powers.spring_heat += action.heat;
            for (end, wrench) in [(spring.first, action.on_first), (spring.second, action.on_second)] {
                if let Some(body) = end.body.filter(|body| !is_free(body.index())) {
                    powers.work_in -= power(&wrench, &self.motions[body.index()].1);
                }
            }
        }
        for index in (0..self.bodies.len()).filter(|index| !is_free(*index)) {
            powers.work_in -= power(&self.contact[index], &self.motions[index].1);
        }
        powers
    }

    /// Energies that the present instant has; losses and work are left at zero, those of contacts excepted.
    pub fn energy(&self, states: &[FreeState]) -> Energy {
        // Empty sums are −0; adding zero makes them 0.
        let ledger = self.world.ledger();
        let mut energy = Energy {
            contacts: ledger.stored + 0.0,
            contact_loss: ledger.dissipated,
            contact_made: self.world.account().made,
            ..Energy::default()
        };
        for ((_, inertia), state) in self.free.iter().zip(states) {
            let speed = state.velocity.value().norm_squared();
            energy.kinetic += 0.5 * (inertia.mass * speed + state.spin(inertia).dot(&state.momentum));
            energy.potential -= inertia.mass * self.gravity.dot(&state.position.value());
        }
        energy.springs =
            self.springs.iter().map(|spring| self.spring_action(spring).energy).sum::<f64>() + 0.0;
        energy
    }
}

impl Simulation {
    /// Warnings about pairs of bodies whose contact has returned more energy than it took, each with the remedy. Empty if none
    /// has, or if the world keeps no accounts ([`Integrator::wrench_use`](crate::Integrator::wrench_use)).
    pub fn energy_warnings(&self) -> Vec<String> {
        let pairs = self.world().pair_accounts().filter(PairAccount::makes_energy);
        pairs.map(|pair| self.energy_warning(&pair)).collect()
    }

    fn energy_warning(&self, pair: &PairAccount) -> String {
        let name = |interface| {
            let mut bodies = self.bodies().map(|(_, body)| body);
            bodies.find(|body| body.interface == Some(interface)).map_or("", |body| body.name.as_str())
        };
        let [first, second] = pair.interfaces.map(name);
        let mut text = format!("`{first}` and `{second}`: ");
        if pair.returned_more > 0 {
            text += &format!(
                "{} of {} touches returned more energy than they took, {:.3e} J in all and {:.3e} J at most; ",
                pair.returned_more, pair.touches, pair.excess, pair.worst_excess
            );
        }
        if pair.touch.verdict() == Verdict::ReturnedMore {
            text += &format!("the contact that lasts has returned {:.3e} J too much; ", pair.touch.excess());
        }
        text += &pair.remedy();
        if let (WrenchUse::Held { late }, Some((k, _))) = (pair.wrench_use, pair.stiffest) {
            let needed = k * self.step_length() * (0.5 + f64::from(late));
            text += &format!("; at this step c must exceed {needed:.3e} N·s/m");
        }
        text
    }
}
