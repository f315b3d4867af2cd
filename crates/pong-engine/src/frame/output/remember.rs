//! Writes a frame's contacts into the contact state at a commit.
//!
//! In a frame with workers, each thread also writes the records of the contacts that it finds. If these are
//! complete, the commit takes the tables over as they are and only indexes the records in key order; no
//! record moves, and in the next frame most are read by the core that wrote them. Otherwise all records are
//! written anew.

use crate::energy::contact::ContactEnergyRef;
use crate::frame::buffers::EvaluationBuffers;
use crate::frame::forces::contact_ref::ContactRef;
use crate::state::{ContactMemory, Remembered};

/// Replaces all records by those of the frame's contacts.
#[inline]
pub(crate) fn remember(frame: &mut EvaluationBuffers, next: &mut ContactMemory) {
    next.clear_records();
    next.records.expect(frame.order.len());
    if adopt(frame, next) {
        return;
    }
    for place in frame.order.iter() {
        let contact = frame.found().contact(place);
        let (law_state, energy) = beside(frame, place);
        let remembered = next.push_with(law_state, energy, |slot| contact.write_record(slot));
        remembered.expect("a frame keeps no more contacts than there is room to remember");
    }
}

/// Takes over the threads' record tables if every contact has its record; returns false otherwise.
#[inline]
fn adopt(frame: &mut EvaluationBuffers, next: &mut ContactMemory) -> bool {
    let EvaluationBuffers { caller, workers, order, .. } = frame;
    if !caller.out.remembers_all() || !workers.iter().all(|worker| worker.remembers_all()) {
        return false;
    }
    let written = order.iter().map(|place| (place.head, place.slot));
    if !next.records.adopt(written) {
        return false;
    }
    let threads = std::iter::once(&mut caller.out).chain(workers.iter_mut());
    for (thread, out) in threads.enumerate() {
        std::mem::swap(&mut out.records, next.records.thread_mut(thread));
        out.records.clear();
    }
    true
}

/// Friction-law state and energies of a contact. If there are any, all contacts are in the caller's buffer.
fn beside<'a>(frame: &'a EvaluationBuffers, place: &ContactRef) -> (&'a [f64], Option<ContactEnergyRef<'a>>) {
    let law_state = frame.caller.out.law_state_of(place.slot.index());
    (law_state, frame.energy.contacts.get(place.slot.index()))
}

/// Records that a commit of the frame would write, in order.
pub(crate) fn fresh(frame: &EvaluationBuffers) -> impl Iterator<Item = Remembered<'_>> + Clone {
    frame.order.iter().map(|place| {
        let (law_state, energy) = beside(frame, place);
        Remembered { record: frame.found().contact(place).record(), law_state, energy }
    })
}
