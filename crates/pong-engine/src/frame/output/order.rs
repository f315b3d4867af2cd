//! The contacts that count, in the order of every sum; where there are too many, the deepest.

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::buffers::Place;
use crate::frame::forces;
use crate::frame::input::EvaluationInput;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::worker_context::WorkerContext;
use crate::report::StatusBits;
use crate::scene::Scene;
use crate::sealed::Sealed;
use crate::state::{ContactRole, Records};

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
        put_where_they_were(records, frame);
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
fn put_where_they_were(records: &Records, frame: &mut EvaluationBuffers) {
    let EvaluationBuffers { caller, order, .. } = frame;
    let WorkerContext { scratch, out, .. } = caller;
    scratch.reset();
    let room = "sealing has sized the scratch";
    let starts = scratch.slice(records.len() + 2, 0_u32).expect(room);
    let ranks = scratch.slice(order.len(), (0_u32, 0_u64)).expect(room);
    for ((rank, place), contact) in ranks.iter_mut().zip(order.iter()).zip(out.contacts.iter()) {
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
