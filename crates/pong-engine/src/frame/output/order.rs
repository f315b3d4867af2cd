//! The contacts that count, in the order of every sum; where there are too many, the deepest.

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::forces;
use crate::frame::forces::contact_buffer::CapacityDemand;
use crate::frame::forces::found::FoundContacts;
use crate::frame::forces::place::Place;
use crate::frame::input::EvaluationInput;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::worker_context::WorkerContext;
use crate::report::StatusBits;
use crate::scene::Scene;
use crate::sealed::Sealed;
use pong_arena::{Arena, Table};

/// Puts the contacts in order, whoever found them.
#[inline]
pub(crate) fn put_in_order(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
    let EvaluationInput { scene, sealed, memory, .. } = *given;
    let mut demand = frame.caller.out.demand;
    list(memory.records.len(), frame);
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
        // There is room to remember as many as there is for those that push, and for no fewer interferences at once.
        frame.report.contacts_wanted = saturated(pushing.max(remembered).max(demand.at_once));
        frame.caller.out.keep_deepest(capacity, spare);
        list(memory.records.len(), frame);
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

/// Contacts below this are simply sorted.
const WORTH_PLACING: usize = 24;

/// Lists all contacts in order.
#[inline]
fn list(records: usize, frame: &mut EvaluationBuffers) {
    let EvaluationBuffers { caller, workers, order, .. } = &mut *frame;
    let WorkerContext { scratch, out, .. } = caller;
    let found = FoundContacts { caller: out, workers };
    order.clear();
    let count = found.count();
    let lasting = || found.places().filter(|place| place.continues().is_some()).count();
    if count < WORTH_PLACING || lasting() * 2 < count {
        for lane in found.lanes() {
            order.extend_from_slice(&lane.places).expect("as many places as contacts");
        }
        order.sort_unstable_by_key(|place| place.head);
    } else {
        put_where_they_were(records, (count, found.places()), order, scratch);
    }
    for ties in order.chunk_by_mut(|a, b| a.head == b.head).filter(|ties| ties.len() > 1) {
        ties.sort_unstable_by_key(|place| found.contact(place).found.order());
    }
}

/// Sorts the contacts by the heads of their keys: most continue one of so many records, and the records stand in order. The
/// first that continues a record stands in its place; the others, sorted by themselves, come in between.
fn put_where_they_were<'a>(
    records: usize,
    (count, contacts): (usize, impl Iterator<Item = &'a Place>),
    order: &mut Table<Place>,
    scratch: &mut Arena,
) {
    scratch.reset();
    let room = "sealing has sized the scratch";
    let lasting = scratch.slice(records, Place::NOWHERE).expect(room);
    let mut others = scratch.list(count).expect(room);
    for contact in contacts {
        match contact.continues() {
            Some(record) if lasting[record].is_nowhere() => lasting[record] = *contact,
            _ => others.push(*contact).expect(room),
        }
    }
    others.sort_unstable_by_key(|place| place.head);
    let mut others = others.iter().peekable();
    let room = "as many places as contacts";
    for contact in lasting.iter().filter(|contact| !contact.is_nowhere()) {
        while let Some(other) = others.next_if(|other| other.head < contact.head) {
            order.push(*other).expect(room);
        }
        order.push(*contact).expect(room);
    }
    others.for_each(|other| order.push(*other).expect(room));
}

/// One contact per ray and opposing Object: the least distance, ties in the order of sums.
fn keep_first_ray_hits(scene: &Scene, sealed: &Sealed, frame: &mut EvaluationBuffers) {
    let EvaluationBuffers { caller, order, .. } = frame;
    let WorkerContext { scratch, out, .. } = caller;
    scratch.reset();
    // (body of A, ray, Object of B, place in the order): hits of one ray on one Object side by side, the first first.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::Slot;
    use pong_testkit::Random;

    /// Of random records some go on, some more than once, and new contacts come with heads of their own or of another's.
    #[test]
    fn contacts_stand_by_their_keys_whether_they_last_or_are_new() {
        let mut random = Random::new(7, 0, 0);
        for case in 0..200 {
            let mut heads: Vec<u32> = (0..40 + case % 40).map(|_| random.below(60) as u32).collect();
            heads.sort_unstable();
            let count = 20 + random.below(80);
            let contacts: Vec<Place> = (0..count)
                .map(|index| match random.below(4) {
                    0 => Place::new(random.below(64) as u64, Slot::new(index % 3, index), true, None),
                    _ => {
                        let record = random.below(heads.len());
                        Place::new(
                            u64::from(heads[record]),
                            Slot::new(index % 3, index),
                            true,
                            Some(record as u32),
                        )
                    }
                })
                .collect();
            let mut order = Table::with_capacity(count, Place::NOWHERE);
            let mut scratch = Arena::with_capacity(64 * (count + heads.len()));
            put_where_they_were(heads.len(), (count, contacts.iter()), &mut order, &mut scratch);
            assert!(order.is_sorted_by_key(|place| place.head), "case {case}: {order:?}");
            let mut listed: Vec<_> = order.iter().map(|place| place.slot.index()).collect();
            listed.sort_unstable();
            assert!(listed.iter().copied().eq(0..contacts.len()), "case {case}");
            for place in order.iter() {
                let contact = &contacts[place.slot.index()];
                assert_eq!((place.head, place.slot.lane()), (contact.head, contact.slot.lane()));
            }
        }
    }
}
