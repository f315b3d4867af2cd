//! Sorts the contacts into summation order and applies the limits: first hit per ray, and the deepest if
//! there are too many.

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::forces;
use crate::frame::forces::contact_buffer::CapacityDemand;
use crate::frame::forces::found::FoundContacts;
use crate::frame::input::EvaluationInput;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::worker_context::WorkerContext;
use crate::report::StatusBits;
use crate::scene::Scene;
use crate::seal::Sealed;

/// Sorts the contacts of all threads.
#[inline]
pub(crate) fn put_in_order(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
    let EvaluationInput { scene, sealed, .. } = *given;
    let mut demand = frame.caller.out.demand;
    list(frame);
    if sealed.rays_meet_groups {
        keep_first_ray_hits(scene, sealed, frame);
        if !demand.overflowed {
            demand.pushing = frame.pushing().count() as u64;
            demand.remembered = frame.order.len() as u64 - demand.pushing;
        }
    }
    let (capacity, spare) = (sealed.contact_capacity, sealed.record_capacity - sealed.contact_capacity);
    let CapacityDemand { pushing, remembered, .. } = demand;
    frame.report.contacts = pushing as u32;
    frame.report.contacts_wanted = saturated(pushing);
    if demand.overflowed || pushing > capacity as u64 || remembered > spare as u64 {
        frame.report.status.set(StatusBits::CONTACT_LIMIT);
        // Contacts only remembered have the same capacity as those that push, and chunk candidates at least
        // that, so the largest of the three is enough.
        frame.report.contacts_wanted = saturated(pushing.max(remembered).max(demand.at_once));
        frame.caller.out.keep_deepest(capacity, spare);
        list(frame);
        frame.report.contacts = frame.pushing().count() as u32;
        forces::recompute_forces(given, frame);
    }
    if demand.unshared {
        frame.report.status.set(StatusBits::LOAD_SHARING_LIMIT);
    }
}

fn saturated(count: u64) -> u32 {
    count.try_into().unwrap_or(u32::MAX)
}

/// Lists all contacts in order.
#[inline]
fn list(frame: &mut EvaluationBuffers) {
    let EvaluationBuffers { caller, workers, order, .. } = frame;
    let found = FoundContacts { caller: &caller.out, workers };
    order.clear();
    for thread in found.threads() {
        order.extend_from_slice(&thread.places).expect("as many places as contacts");
    }
    // Contacts under one high word are few; only these are compared whole.
    order.sort_unstable_by_key(|place| place.head);
    for ties in order.chunk_by_mut(|a, b| a.head == b.head).filter(|ties| ties.len() > 1) {
        ties.sort_unstable_by_key(|place| found.contact(place).found.order());
    }
}

/// Keeps one contact per ray and opposing Object: the nearest, ties by summation order.
fn keep_first_ray_hits(scene: &Scene, sealed: &Sealed, frame: &mut EvaluationBuffers) {
    let EvaluationBuffers { caller, order, .. } = frame;
    let WorkerContext { scratch, out, .. } = &mut **caller;
    scratch.reset();
    // (body of A, ray, Object of B, index in the order), sorted by these and distance, so that the first of
    // each ray and Object is the nearest.
    let mut hits = scratch.list(order.len()).expect("sealing has sized the scratch");
    for (place, found) in order.iter().map(|place| &out.contacts[place.slot.index()].found).enumerate() {
        if found.ray_distance < f64::INFINITY {
            let (a, b) = sealed.bodies_of(found.key.direction());
            let hit = (a, found.key.primitive_a, scene.bodies[b].object, place);
            hits.push((hit, found.ray_distance)).expect("as much room as contacts");
        }
    }
    hits.sort_unstable_by(|((a, ray, object, place), distance), (other, further)| {
        (a, ray, object)
            .cmp(&(&other.0, &other.1, &other.2))
            .then(distance.total_cmp(further))
            .then(place.cmp(&other.3))
    });
    for later in hits.windows(2) {
        let [(first, _), (second, _)] = [later[0], later[1]];
        if (first.0, first.1, first.2) == (second.0, second.1, second.2) {
            out.contacts[order[second.3].slot.index()].found.status = CandidateStatus::Culled;
        }
    }
    order.retain(|place| out.contacts[place.slot.index()].found.status != CandidateStatus::Culled);
}
