//! Energy balance.
//!
//! ```text
//! kinetic + potential + springs + contacts + dissipated − work_in = constant
//! ```
//!
//! up to the order of the integrator. Contact terms are the engine's ledger: they are zero unless the world keeps it.
//!
//! The engine knows the states at commits alone, and takes the work in between by the trapezoid rule. Where
//! contact is evaluated at stages, the executive computes it more accurately: impulse and angular impulse of
//! the stages on each free body, times the mean of its velocity and spin before and after the step, give the
//! change of its kinetic energy,
//!
//! ```text
//! W = Σ h·b_i·F_i·½(v + v') + Σ h·b_i·M_i·½(ω + ω')
//! ```
//!
//! in translation to rounding, in rotation to third order of the step. Where contact begins or ends within a
//! step, the final position of the stages is not that of the mean velocity; the work of gravity over the
//! difference is counted with the contact that made it.

use crate::body::Motion;
use crate::integrate::Pushed;
use crate::state::FreeState;
use crate::system::System;
use pong_geometry::{Twist, Wrench};

/// Energies, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy of the free bodies, J.
    pub kinetic: f64,
    /// Potential energy of the free bodies in uniform gravity, J; zero at the common origin.
    pub potential: f64,
    /// Energy in springs, less the work of their preloads, J.
    pub springs: f64,
    /// Energy stored in contacts, J.
    pub contacts: f64,
    /// Energy lost in contacts since the start, including the integrator's loss in them, J; negative if they
    /// gained energy.
    pub contact_loss: f64,
    /// Energy gained since the start by holding contact wrenches over steps, J: their work less that of
    /// forces that follow the motion. The balance drifts by it. Zero unless the world keeps energy accounts.
    pub contact_made: f64,
    /// Energy lost in dampers of springs since the start, J.
    pub spring_loss: f64,
    /// Work since the start of loads on free bodies, and of prescribed bodies on others, J.
    pub work_in: f64,
}

impl Energy {
    /// Kinetic, potential and stored energy.
    pub fn mechanical(&self) -> f64 {
        self.kinetic + self.potential + self.springs + self.contacts
    }

    /// Energy balance; constant up to the order of the integrator.
    pub fn balance(&self) -> f64 {
        self.mechanical() + self.contact_loss + self.spring_loss - self.work_in
    }
}

/// Powers across the boundary of the system, W.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Powers {
    /// Turned into heat by springs; never negative.
    pub spring_heat: f64,
    /// Power of loads and of prescribed bodies on the free bodies; positive into the system.
    pub work_in: f64,
    /// Power of contact on prescribed and fixed bodies.
    pub on_led: f64,
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
        for (index, wrench) in self.external.iter().enumerate().filter(|(index, _)| is_free(*index)) {
            powers.work_in += power(wrench, &self.motions[index].1);
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
        powers.on_led = self.power_on_led();
        powers
    }

    /// Power of contact on the bodies that are not free, at the instant last placed and touched.
    pub fn power_on_led(&self) -> f64 {
        let led = self.bodies.iter().zip(self.contact.iter().zip(&self.motions));
        let led = led.filter(|(body, _)| !matches!(body.motion, Motion::Free(_)));
        led.map(|(_, (wrench, (_, twist)))| power(wrench, twist)).sum()
    }

    /// Work of contact on the bodies over a step of length `h` (s) with the impulses `pushed`.
    pub fn contact_work(&self, before: &[FreeState], after: &[FreeState], pushed: &Pushed, h: f64) -> f64 {
        let mut work = pushed.work_on_led;
        let states = before.iter().zip(after).zip(&self.free);
        for (((before, after), (_, inertia)), impulse) in states.zip(&pushed.impulses) {
            if *impulse == Wrench::zero() {
                continue;
            }
            let velocity = 0.5 * (before.velocity.value() + after.velocity.value());
            let spin = 0.5 * (before.spin(inertia) + after.spin(inertia));
            let displacement = after.position.plus(&-before.position.value()).value();
            work += impulse.force.dot(&velocity) + impulse.moment.dot(&spin);
            work += inertia.mass * self.gravity.dot(&(velocity * h - displacement));
        }
        work
    }

    /// Energies of the present instant; losses and work are left zero, except those of contacts.
    pub fn energy(&self, states: &[FreeState]) -> Energy {
        // Empty sums are −0; adding zero makes them 0.
        let ledger = self.world.ledger();
        let mut energy = Energy {
            contacts: ledger.stored + 0.0,
            contact_loss: ledger.dissipated,
            contact_made: self.world.account().hold_error,
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
