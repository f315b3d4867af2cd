//! Sums the forces of all contacts into wrenches, in key order, about and along each movable group's own frame.

use super::Frame;
use crate::sealed::Sealed;
use crate::state::Role;
use pong_geometry::Wrench;

/// Adds every contact to both of its movable groups.
pub(super) fn sum(sealed: &Sealed, frame: &mut Frame) {
    let Frame { input, lane, order, wrenches, .. } = frame;
    for place in order.iter() {
        let contact = &lane.out.contacts[place.index as usize];
        if contact.found.role != Role::Pushes {
            continue;
        }
        let key = &contact.found.key;
        let (body_a, body_b) = sealed.bodies_of(key);
        let x_ba = &input.motions[key.group_pair as usize][key.flipped as usize].x_ba;
        let force_b = contact.force();
        let force_a = x_ba.rotation.tr_mul(&force_b);
        let arm_a = x_ba.rotation.tr_mul(&(contact.point - x_ba.translation));
        wrenches[body_a] += Wrench::of_force_at(force_a, &arm_a);
        wrenches[body_b] += Wrench::of_force_at(-force_b, &contact.point);
    }
}
