//! Writes the records of a frame's contacts into the contact state at a commit, in key order.

use crate::energy::contact::ContactEnergyRef;
use crate::frame::buffers::EvaluationBuffers;
use crate::frame::forces::contact_ref::ContactRef;
use crate::state::{ContactMemory, RecordEntry};

/// Replaces all records by those of the frame's contacts.
#[inline]
pub(crate) fn write_records(frame: &EvaluationBuffers, next: &mut ContactMemory) {
    next.clear_records();
    next.records.size_hints(frame.order.len());
    let found = frame.found();
    for reference in frame.order.iter() {
        let (law_state, energy) = law_state_and_energy(frame, reference);
        let contact = found.contact(reference);
        let written = next.push_with(law_state, energy, |record| contact.write_record(record));
        written.expect("a frame keeps no more contacts than there is room for records");
    }
}

/// Records that a commit of the frame would write, in key order.
pub(crate) fn new_records(frame: &EvaluationBuffers) -> impl Iterator<Item = RecordEntry<'_>> + Clone {
    frame.order.iter().map(|reference| {
        let (law_state, energy) = law_state_and_energy(frame, reference);
        RecordEntry { record: frame.found().contact(reference).record(), law_state, energy }
    })
}

/// Friction-law state and energies of a contact. In a world that has any of them, all contacts are in the
/// caller's buffer, so the index of the contact is enough.
fn law_state_and_energy<'a>(
    frame: &'a EvaluationBuffers,
    reference: &ContactRef,
) -> (&'a [f64], Option<ContactEnergyRef<'a>>) {
    let index = reference.slot.index();
    (frame.caller.out.law_state_of(index), frame.energy.contacts.get(index))
}
