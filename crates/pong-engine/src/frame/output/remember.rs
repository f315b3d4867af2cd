//! What a commit remembers of a frame's contacts.
//!
//! In a frame that workers share every lane, the caller's first, writes the records of the contacts that it finds. Where those
//! are all, a commit takes over their tables as they are and only counts the records in the order of their keys: no record is
//! moved, and most are read in the next frame by the core that has written them. Else it writes all of them anew.

use crate::energy::contact::ContactEnergyRef;
use crate::frame::buffers::EvaluationBuffers;
use crate::frame::forces::place::Place;
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

/// Takes over what the lanes have written, if each contact of the frame has its record; whether so.
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
    let lanes = std::iter::once(&mut caller.out).chain(workers.iter_mut());
    for (lane, out) in lanes.enumerate() {
        std::mem::swap(&mut out.records, next.records.lane_mut(lane));
        out.records.clear();
    }
    true
}

/// Numbers of a registered law and energies of a contact. Where there are any, all contacts stand in the caller's buffer.
fn beside<'a>(frame: &'a EvaluationBuffers, place: &Place) -> (&'a [f64], Option<ContactEnergyRef<'a>>) {
    let law_state = frame.caller.out.law_state_of(place.slot.index());
    (law_state, frame.energy.contacts.get(place.slot.index()))
}

/// What a commit would remember of the frame's contacts, in order.
pub(crate) fn fresh(frame: &EvaluationBuffers) -> impl Iterator<Item = Remembered<'_>> + Clone {
    frame.order.iter().map(|place| {
        let (law_state, energy) = beside(frame, place);
        Remembered { record: frame.found().contact(place).record(), law_state, energy }
    })
}
