//! When a frame has more contacts than the world's capacity, the deepest are kept.

use super::Frame;
use super::buffers::FrameContact;
use crate::contact::StatusBits;
use crate::sealed::Sealed;
use crate::state::Role;

/// Keeps the K largest by (depth, then key) of the contacts that push, and of those only remembered.
pub(super) fn keep_deepest(sealed: &Sealed, frame: &mut Frame) {
    let wanted = frame.listed();
    frame.report.contacts_wanted = wanted as u32;
    let capacity = sealed.contact_capacity;
    if wanted > capacity {
        frame.report.status.set(StatusBits::CONTACT_LIMIT);
        keep(&mut frame.contacts, capacity, |contact| contact.role == Role::Pushes);
    }
    let spare = sealed.record_capacity - capacity;
    if frame.contacts.len() - frame.listed() > spare {
        frame.report.status.set(StatusBits::CONTACT_LIMIT);
        keep(&mut frame.contacts, spare, |contact| contact.role != Role::Pushes);
    }
    frame.report.contacts = frame.listed() as u32;
}

/// Of the contacts that `among` names, keeps the `count` deepest, ties in key order; the rest stay in place.
fn keep(contacts: &mut Vec<FrameContact>, count: usize, among: impl Fn(&FrameContact) -> bool) {
    let mut by_depth: Vec<usize> = (0..contacts.len()).filter(|&i| among(&contacts[i])).collect();
    by_depth.sort_by(|&i, &j| contacts[j].depth.total_cmp(&contacts[i].depth).then(i.cmp(&j)));
    let mut dropped = vec![false; contacts.len()];
    by_depth[count..].iter().for_each(|&i| dropped[i] = true);
    let mut index = 0;
    contacts.retain(|_| {
        index += 1;
        !dropped[index - 1]
    });
}
