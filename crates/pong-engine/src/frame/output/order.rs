//! The contacts that count, in the order of every sum; where there are too many, the deepest.

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::buffers::Place;
use crate::frame::forces;
use crate::frame::forces::contact::FrameContact;
use crate::frame::input::EvaluationInput;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::worker_context::WorkerContext;
use crate::report::StatusBits;
use crate::scene::Scene;
use crate::sealed::Sealed;
use crate::state::{ContactRole, Records};
use pong_arena::Arena;

/// Puts the contacts in order, whoever found them.
pub(crate) fn put_in_order(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
    let EvaluationInput { scene, sealed, memory, .. } = *given;
    let mut pushing = list(&memory.records, frame);
    if sealed.rays_meet_groups {
        keep_first_ray_hits(scene, sealed, frame);
        pushing = frame.pushing().count();
    }
    let (capacity, spare) = (sealed.contact_capacity, sealed.record_capacity - sealed.contact_capacity);
    let mut kept = pushing;
    let found = (pushing as u64, (frame.order.len() - pushing) as u64);
    let demand = frame.caller.out.demand;
    let (pushing, remembered) = if demand.overflowed { (demand.pushing, demand.remembered) } else { found };
    frame.report.contacts_wanted = saturated(pushing);
    if demand.overflowed || pushing > capacity as u64 || remembered > spare as u64 {
        frame.report.status.set(StatusBits::CONTACT_LIMIT);
        // There is room to remember as many as there is for those that push, and for no fewer interferences at once.
        frame.report.contacts_wanted = saturated(pushing.max(remembered).max(demand.at_once));
        frame.caller.out.keep_deepest(capacity, spare);
        kept = list(&memory.records, frame);
        forces::recompute_forces(given, frame);
    }
    if demand.unshared {
        frame.report.status.set(StatusBits::LOAD_SHARING_LIMIT);
    }
    frame.report.contacts = kept as u32;
}

fn saturated(count: u64) -> u32 {
    count.try_into().unwrap_or(u32::MAX)
}

/// Contacts below this are simply sorted.
const WORTH_COUNTING: usize = 24;

/// Lists all contacts in order; how many of them push.
fn list(records: &Records, frame: &mut EvaluationBuffers) -> usize {
    frame.order.clear();
    let (mut pushing, mut lasting) = (0, 0);
    for (index, contact) in frame.caller.out.contacts.iter().enumerate() {
        pushing += usize::from(contact.found.role == ContactRole::Active);
        lasting += usize::from(contact.continues.is_some());
        let place = Place { head: contact.found.key.head(), index: index as u32 };
        frame.order.push(place).expect("as many places as contacts");
    }
    let count = frame.order.len();
    if count < WORTH_COUNTING || lasting * 2 < count {
        frame.order.sort_unstable_by_key(|place| place.head);
    } else {
        let EvaluationBuffers { caller, order, .. } = &mut *frame;
        put_where_they_were(records, &caller.out.contacts, order, &mut caller.scratch);
    }
    let contacts = &frame.caller.out.contacts;
    for ties in frame.order.chunk_by_mut(|a, b| a.head == b.head).filter(|ties| ties.len() > 1) {
        ties.sort_unstable_by_key(|place| contacts[place.index as usize].found.order());
    }
    pushing
}

/// Sorts the contacts by the heads of their keys: most continue a record, and the records stand in order.
///
/// Each is put where its record stands, or where one of its head would, and few that stand at one place are then moved.
fn put_where_they_were(
    records: &Records,
    contacts: &[FrameContact],
    order: &mut [Place],
    scratch: &mut Arena,
) {
    scratch.reset();
    let room = "sealing has sized the scratch";
    let starts = scratch.slice(records.len() + 2, 0_u32).expect(room);
    let ranks = scratch.slice(order.len(), (0_u32, 0_u64)).expect(room);
    for ((rank, place), contact) in ranks.iter_mut().zip(order.iter()).zip(contacts) {
        let place_of_head = || records.of_head(place.head).start as u32;
        *rank = (contact.continues.unwrap_or_else(place_of_head), place.head);
        starts[rank.0 as usize + 1] += 1;
    }
    let mut before = 0;
    for start in starts.iter_mut() {
        before += *start;
        *start = before;
    }
    for (index, &(rank, head)) in ranks.iter().enumerate() {
        let place = &mut starts[rank as usize];
        order[*place as usize] = Place { head, index: index as u32 };
        *place += 1;
    }
    for last in 1..order.len() {
        let mut at = last;
        while at > 0 && order[at - 1].head > order[at].head {
            order.swap(at - 1, at);
            at -= 1;
        }
    }
}

/// One contact per ray and opposing Object: the least distance, ties in the order of sums.
fn keep_first_ray_hits(scene: &Scene, sealed: &Sealed, frame: &mut EvaluationBuffers) {
    let EvaluationBuffers { caller, order, .. } = frame;
    let WorkerContext { scratch, out, .. } = caller;
    scratch.reset();
    // (body of A, ray, Object of B, place in the order): hits of one ray on one Object side by side, the first first.
    let mut hits = scratch.list(order.len()).expect("sealing has sized the scratch");
    for (place, found) in order.iter().map(|place| &out.contacts[place.index as usize].found).enumerate() {
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
            out.contacts[order[second.3].index as usize].found.status = CandidateStatus::Culled;
        }
    }
    order.retain(|place| out.contacts[place.index as usize].found.status != CandidateStatus::Culled);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::{ContactKey, ContactRecord};
    use pong_testkit::Random;

    /// Of random records some go on, some more than once, and new contacts come with heads of their own or of another's.
    #[test]
    fn contacts_stand_by_their_keys_whether_they_last_or_are_new() {
        let mut random = Random::new(7, 0, 0);
        for case in 0..200 {
            let mut heads: Vec<u32> = (0..40 + case % 40).map(|_| random.below(60) as u32).collect();
            heads.sort_unstable();
            let key = |primitive_a| ContactKey { primitive_a, ..ContactKey::default() };
            let mut records = Records::with_capacity(heads.len());
            for &head in &heads {
                let record = ContactRecord { key: key(head), ..ContactRecord::blank() };
                records.push_with(|slot| *slot = record).unwrap();
            }
            let contact = |head: u32, continues: Option<u32>| {
                let mut contact = FrameContact { continues, ..FrameContact::blank() };
                contact.found.key = key(head);
                contact
            };
            let count = 20 + random.below(80);
            let contacts: Vec<_> = (0..count)
                .map(|_| match random.below(4) {
                    0 => contact(random.below(64) as u32, None),
                    _ => {
                        let record = random.below(heads.len());
                        contact(heads[record], Some(record as u32))
                    }
                })
                .collect();
            let mut order: Vec<_> = contacts
                .iter()
                .enumerate()
                .map(|(index, contact)| Place { head: contact.found.key.head(), index: index as u32 })
                .collect();
            let mut scratch = Arena::with_capacity(64 * (order.len() + heads.len()));
            put_where_they_were(&records, &contacts, &mut order, &mut scratch);
            assert!(order.is_sorted_by_key(|place| place.head), "case {case}: {order:?}");
            let mut listed: Vec<_> = order.iter().map(|place| place.index).collect();
            listed.sort_unstable();
            assert!(listed.iter().copied().eq(0..contacts.len() as u32), "case {case}");
            for place in &order {
                assert_eq!(place.head, contacts[place.index as usize].found.key.head());
            }
        }
    }
}
