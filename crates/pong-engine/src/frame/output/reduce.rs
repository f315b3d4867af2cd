//! Sums the wrenches of all contacts, in key order, about and along each movable group's own frame.

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::forces::contact::FrameContact;
use crate::sealed::Sealed;
use crate::state::ContactRole;
use pong_geometry::Wrench;

/// Adds every contact to both of its movable groups.
pub(crate) fn sum(sealed: &Sealed, frame: &mut EvaluationBuffers) {
    let EvaluationBuffers { caller, order, wrenches, .. } = frame;
    for place in order.iter() {
        let contact = &caller.out.contacts[place.index as usize];
        if contact.found.role == ContactRole::Active {
            let (body_a, body_b) = sealed.bodies_of(contact.found.key.direction());
            wrenches[body_a] += contact.wrenches[0];
            wrenches[body_b] += contact.wrenches[1];
        }
    }
}

/// What the turn to the axes of another frame must not carry out of the range of numbers.
const LARGEST: f64 = f64::MAX / 16.0;

impl EvaluationBuffers {
    /// A movable group whose numbers have left the range of numbers, if any: a product or sum of finite ones can.
    pub fn overflows(&self, sealed: &Sealed) -> Option<usize> {
        // False for what is not a number, too.
        let holds = |sum: f64| sum <= LARGEST;
        let of_wrench = |wrench: &Wrench| wrench.force.abs().sum() + wrench.moment.abs().sum();
        // Those that meet nobody have no wrench.
        let mut bodies = sealed.paired_bodies.iter().copied();
        let body = bodies.find(|&body| !holds(of_wrench(&self.wrenches[body])));
        body.or_else(|| {
            // Forces that cancel each other, and energies.
            let of_contact = |contact: &FrameContact| {
                contact.normal_force + contact.friction_force_b.abs().sum() + contact.stored.abs()
            };
            let mut contacts = self.order.iter().map(|place| &self.caller.out.contacts[place.index as usize]);
            let bad = contacts.find(|contact| !holds(of_contact(contact)));
            let ledger = !holds(self.energy.work.abs() + self.energy.dissipated.abs());
            // Energies are nobody's: the first group stands for all.
            bad.map(|contact| sealed.bodies_of(contact.found.key.direction()).0).or(ledger.then_some(0))
        })
    }
}
