//! Sorts the contacts into summation order and applies the limits: first hit per ray, and the deepest if
//! there are too many.

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
use pong_arena::Arena;

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

/// Fewer contacts than this are sorted by comparison.
const WORTH_DIGITS: usize = 24;

/// Lists all contacts in order.
#[inline]
fn list(frame: &mut EvaluationBuffers) {
    let EvaluationBuffers { caller, workers, order, .. } = &mut *frame;
    let WorkerContext { scratch, out, .. } = &mut **caller;
    let found = FoundContacts { caller: out, workers };
    order.clear();
    for thread in found.threads() {
        order.extend_from_slice(&thread.places).expect("as many places as contacts");
    }
    if order.len() < WORTH_DIGITS {
        order.sort_unstable_by_key(|place| place.head);
    } else {
        sort_by_digits(order.as_mut_slice(), scratch);
    }
    for ties in order.chunk_by_mut(|a, b| a.head == b.head).filter(|ties| ties.len() > 1) {
        ties.sort_unstable_by_key(|place| found.contact(place).found.order());
    }
}

/// Radix sort of contacts by the high words of their keys, lowest digit first (D. E. Knuth, The Art of
/// Computer Programming, vol. 3, 5.2.5). Contacts come in tree order, so comparisons would be mispredicted; a
/// radix sort has none.
#[inline(never)]
fn sort_by_digits(places: &mut [Place], scratch: &mut Arena) {
    let first = places[0].head;
    let mut differing = places.iter().fold(0, |bits, place| bits | (place.head ^ first));
    // Digits of equal length, short enough that there are few counters compared with the contacts.
    let digits = differing.count_ones().div_ceil(DIGIT_BITS).max(1);
    let bits = differing.count_ones().div_ceil(digits);
    let mask = (1 << bits) - 1;
    scratch.reset();
    let mut from = places;
    let mut to = scratch.slice(from.len(), Place::NOWHERE).expect("sealing has sized the scratch");
    let mut is_in_scratch = false;
    while differing != 0 {
        let shift = differing.trailing_zeros();
        place_by_digit((from, to), shift, mask);
        (from, to) = (to, from);
        is_in_scratch = !is_in_scratch;
        differing &= !(mask << shift);
    }
    if is_in_scratch {
        to.copy_from_slice(from);
    }
}

/// Maximum bits of a digit.
const DIGIT_BITS: u32 = 8;

/// Copies the references in the order of one digit of their high words; stable.
fn place_by_digit((from, to): (&[Place], &mut [Place]), shift: u32, mask: u64) {
    let digit = |place: &Place| (place.head >> shift & mask) as usize;
    let mut ends = [0_u32; 1 << DIGIT_BITS];
    let ends = &mut ends[..=mask as usize];
    for place in from {
        ends[digit(place)] += 1;
    }
    let mut count = 0;
    for end in ends.iter_mut() {
        (*end, count) = (count, count + *end);
    }
    for place in from {
        let next = &mut ends[digit(place)];
        to[*next as usize] = *place;
        *next += 1;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::Slot;
    use pong_testkit::Random;

    /// High words of few and of many contacts, with few and many directions; equal words keep their order.
    #[test]
    fn digits_put_contacts_in_the_order_of_their_heads() {
        let mut random = Random::new(7, 0, 0);
        for case in 0..300 {
            let count = WORTH_DIGITS + random.below(if case % 10 == 0 { 2000 } else { 60 });
            let [directions, primitives] = [1 << random.below(22), 1 << random.below(31)];
            let mut places: Vec<Place> = (0..count)
                .map(|index| {
                    let head = (random.below(directions) as u64) << 32 | random.below(primitives) as u64;
                    Place::new(head, Slot::new(index % 3, index), index % 2 == 0, Some(index as u32))
                })
                .collect();
            let mut expected = places.clone();
            expected.sort_by_key(|place| place.head);
            let mut scratch = Arena::with_capacity(16 + count * size_of::<Place>());
            sort_by_digits(&mut places, &mut scratch);
            let told = |place: &Place| (place.head, place.slot, place.continues());
            assert!(places.iter().map(told).eq(expected.iter().map(told)), "case {case}");
        }
    }

    /// High words that differ only in the highest or lowest bit, or not at all.
    #[test]
    fn digits_at_the_ends_of_the_heads_count() {
        for bit in [0, 1, 32, 55, 56, 62, 63] {
            let heads = [1_u64 << bit, 0, u64::MAX, !(1 << bit), 1 << bit];
            let place = |(index, &head): (usize, &u64)| Place::new(head, Slot::new(0, index), true, None);
            let mut places: Vec<Place> = heads.iter().enumerate().map(place).collect();
            sort_by_digits(&mut places, &mut Arena::with_capacity(1024));
            assert!(places.is_sorted_by_key(|place| place.head), "{bit}: {places:?}");
            places.fill(Place::new(1 << bit, Slot::new(0, 1), true, None));
            sort_by_digits(&mut places, &mut Arena::with_capacity(1024));
            assert!(places.iter().all(|place| place.head == 1 << bit));
        }
    }
}
