//! Sorts the contacts into summation order and applies the limits: first hit per ray, and the deepest if
//! there are too many.

use crate::frame::forces::contact::FrameContact;
use crate::frame::forces::contact_buffer::{CapacityDemand, ContactBuffer};
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::forces::found::FoundContacts;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::worker_context::WorkerContext;
use crate::report::{FrameReport, StatusBits};
use crate::scene::Scene;
use crate::seal::Sealed;
use pong_arena::Table;

/// Contacts of a frame in summation order.
#[derive(Clone, Copy)]
pub(crate) struct OrderedContacts<'a> {
    /// References to the contacts, in summation order.
    pub order: &'a [ContactRef],
    /// Buffers that hold the contacts.
    pub found: FoundContacts<'a>,
}

impl<'a> OrderedContacts<'a> {
    pub fn new(order: &'a [ContactRef], caller: &'a ContactBuffer, workers: &'a [ContactBuffer]) -> Self {
        Self { order, found: FoundContacts { caller, workers } }
    }

    /// Contacts that push.
    pub fn pushing(&self) -> impl Iterator<Item = &'a FrameContact> + use<'a> {
        let found = self.found;
        self.order
            .iter()
            .filter(|reference| reference.pushes())
            .map(move |reference| found.contact(reference))
    }

    /// References to the contacts whose keys have this high word.
    pub fn with_head(&self, head: u64) -> impl Iterator<Item = &'a ContactRef> + use<'a> {
        let first = self.order.partition_point(|reference| reference.head < head);
        self.order[first..].iter().take_while(move |reference| reference.head == head)
    }
}

/// Lists the contacts of all threads in summation order.
#[inline]
pub(crate) fn list(found: FoundContacts<'_>, order: &mut Table<ContactRef>) {
    order.clear();
    for thread in found.threads() {
        order.extend_from_slice(&thread.refs).expect("as many references as contacts");
    }
    // Few contacts have the same high word, so only these are compared by their whole order.
    order.sort_unstable_by_key(|reference| reference.head);
    for ties in order.chunk_by_mut(|a, b| a.head == b.head).filter(|ties| ties.len() > 1) {
        ties.sort_unstable_by_key(|reference| found.contact(reference).found.order());
    }
}

/// Applies the contact capacity of the world, and reports the demand. If there are too many contacts, drops
/// all but the deepest and returns true; the forces must then be recomputed, because the remaining contacts
/// take over the tangential springs of those dropped. It need not look at the workers' buffers: they are in
/// use only if all contacts are within the capacity.
#[inline]
pub(crate) fn keep_deepest(
    sealed: &Sealed,
    out: &mut ContactBuffer,
    order: &mut Table<ContactRef>,
    report: &mut FrameReport,
) -> bool {
    let (capacity, spare) = (sealed.contact_capacity, sealed.record_capacity - sealed.contact_capacity);
    let CapacityDemand { pushing, remembered, at_once, overflowed, unshared, .. } = out.demand;
    report.contacts = pushing as u32;
    report.contacts_wanted = saturated(pushing);
    if unshared {
        report.status.set(StatusBits::LOAD_SHARING_LIMIT);
    }
    if !overflowed && pushing <= capacity as u64 && remembered <= spare as u64 {
        return false;
    }
    report.status.set(StatusBits::CONTACT_LIMIT);
    // There is room for as many remembered contacts as for pushing ones, and for at least as many candidates
    // of a chunk. So a contact capacity of the largest of the three counts would be enough.
    report.contacts_wanted = saturated(pushing.max(remembered).max(at_once));
    out.keep_deepest(capacity, spare);
    list(FoundContacts { caller: out, workers: &[] }, order);
    report.contacts = count_pushing(order) as u32;
    true
}

fn count_pushing(order: &[ContactRef]) -> u64 {
    order.iter().filter(|reference| reference.pushes()).count() as u64
}

fn saturated(count: u64) -> u32 {
    count.try_into().unwrap_or(u32::MAX)
}

/// Keeps one contact per ray and opposing Object: the nearest, or the first in summation order of equally
/// near ones. All contacts must be in the caller's buffer.
pub(crate) fn keep_first_ray_hits(
    scene: &Scene,
    sealed: &Sealed,
    caller: &mut WorkerContext,
    order: &mut Table<ContactRef>,
) {
    let WorkerContext { scratch, out, .. } = caller;
    scratch.reset();
    // Each hit is (movable group of A, ray, Object of B, index in `order`) with its distance. They are sorted
    // by group, ray and Object, then by distance, so that the first hit of each ray and Object is the
    // nearest.
    let mut hits = scratch.list(order.len()).expect("sealing has sized the scratch");
    for (index, found) in
        order.iter().map(|reference| &out.contacts[reference.slot.index()].found).enumerate()
    {
        if found.ray_distance < f64::INFINITY {
            let (a, b) = sealed.bodies_of(found.key.direction());
            let hit = (a, found.key.primitive_a, scene.bodies[b].object, index);
            hits.push((hit, found.ray_distance)).expect("as much room as contacts");
        }
    }
    hits.sort_unstable_by(|((a, ray, object, index), distance), (other, further)| {
        (a, ray, object)
            .cmp(&(&other.0, &other.1, &other.2))
            .then(distance.total_cmp(further))
            .then(index.cmp(&other.3))
    });
    for later in hits.windows(2) {
        let [(first, _), (second, _)] = [later[0], later[1]];
        if (first.0, first.1, first.2) == (second.0, second.1, second.2) {
            out.contacts[order[second.3].slot.index()].found.status = CandidateStatus::Culled;
        }
    }
    order.retain(|reference| out.contacts[reference.slot.index()].found.status != CandidateStatus::Culled);
    if !out.demand.overflowed {
        out.demand.pushing = count_pushing(order);
        out.demand.remembered = order.len() as u64 - out.demand.pushing;
    }
}
