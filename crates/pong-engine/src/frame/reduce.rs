//! Sums the wrenches of all contacts, in key order, about and along each movable group's own frame.

use super::Frame;
use crate::sealed::Sealed;
use crate::state::Role;

/// Adds every contact to both of its movable groups.
pub(super) fn sum(sealed: &Sealed, frame: &mut Frame) {
    let Frame { lane, order, wrenches, .. } = frame;
    for place in order.iter() {
        let contact = &lane.out.contacts[place.index as usize];
        if contact.found.role == Role::Pushes {
            let (body_a, body_b) = sealed.bodies_of(&contact.found.key);
            wrenches[body_a] += contact.wrenches[0];
            wrenches[body_b] += contact.wrenches[1];
        }
    }
}
