//! Contacts as they are found, in no order, with room for so many and the demand for more.

use super::bristles::WaitingBristles;
use crate::frame::forces::contact::FrameContact;
use crate::frame::forces::place::Place;
use crate::frame::forces::term::Term;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::law::FrictionProps;
use crate::law::friction::{FrictionInput, FrictionOutput, friction_alone};
use crate::report::{FrameCounts, WorkTimes};
use crate::sealed::Sealed;
use crate::state::{ContactRecord, ContactRole, Slot};
use pong_arena::Table;
use std::mem::swap;

/// Contacts with their forces, and what was counted and timed while they were found.
#[derive(Debug)]
pub(crate) struct ContactBuffer {
    /// The lane that finds them: 0 is the caller.
    lane: usize,
    /// The phase that the contents belong to, or [`Self::NO_PHASE`].
    pub phase: u64,
    /// Contacts, in no order.
    pub contacts: Table<FrameContact>,
    /// Where they stand, as many.
    pub places: Table<Place>,
    /// The same once more, written when a claim is done: what the caller asks of. In a worker's buffer alone.
    told_places: Table<Place>,
    /// What those that have a record add to the wrenches; none in the caller's buffer.
    pub terms: Table<Term>,
    /// What a commit is to remember of the first so many of them, each written as soon as its contact is whole: while others find
    /// contacts for the same frame, as far as there is room.
    pub records: Table<ContactRecord>,
    /// Those of them whose friction is still to be worked out.
    pub(super) bristles: WaitingBristles,
    /// Numbers of registered friction laws, as many for every contact.
    pub law_state: Table<f64>,
    pub law_state_len: usize,
    /// Room for ranking the contacts; only the caller's has some.
    ranked: Table<u32>,
    /// Whether others find contacts for the same frame just now. What finds no room then is lost, and all is done again.
    pub shares: bool,
    pub demand: CapacityDemand,
    pub counts: FrameCounts,
    /// Where the time went; zero without a clock.
    pub times: WorkTimes,
}

/// What a frame would need room for, found or not.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CapacityDemand {
    /// Contacts that push.
    pub pushing: u64,
    /// Contacts that are only remembered.
    pub remembered: u64,
    /// Interferences of one chunk of A, where they found no room: the most.
    pub at_once: u64,
    /// Whether anything found no room.
    pub overflowed: bool,
    /// Whether contacts of one ball with one surface were too many to be shared exactly.
    pub unshared: bool,
}

impl CapacityDemand {
    /// One contact more.
    #[inline]
    pub fn count(&mut self, role: ContactRole) {
        *(if role == ContactRole::Active { &mut self.pushing } else { &mut self.remembered }) += 1;
    }

    pub fn add(&mut self, other: &Self) {
        self.pushing += other.pushing;
        self.remembered += other.remembered;
        self.at_once = self.at_once.max(other.at_once);
        self.overflowed |= other.overflowed;
        self.unshared |= other.unshared;
    }
}

/// How far a buffer had got.
pub(crate) struct Checkpoint {
    contacts: usize,
    demand: CapacityDemand,
    counts: FrameCounts,
}

impl ContactBuffer {
    /// Of a buffer that holds nothing yet.
    pub const NO_PHASE: u64 = 0;

    /// Room for so many contacts and records that a lane finds, and, in the caller's, to rank the contacts if only the deepest
    /// are to be kept.
    pub fn new(lane: usize, law_state_len: usize, contacts: usize, records: usize) -> Self {
        Self {
            lane,
            phase: Self::NO_PHASE,
            contacts: Table::with_capacity(contacts, FrameContact::blank()),
            places: Table::with_capacity(contacts, Place::NOWHERE),
            told_places: Table::with_capacity(if lane > 0 { contacts } else { 0 }, Place::NOWHERE),
            terms: Table::with_capacity(if lane > 0 { records } else { 0 }, Term::nothing()),
            records: Table::with_capacity(records, ContactRecord::blank()),
            bristles: WaitingBristles::new(),
            law_state: Table::with_capacity(contacts * law_state_len, 0.0),
            law_state_len,
            ranked: Table::with_capacity(if lane == 0 { contacts } else { 0 }, 0),
            shares: lane > 0,
            demand: CapacityDemand::default(),
            counts: FrameCounts::default(),
            times: WorkTimes::default(),
        }
    }

    /// Whether anything of a phase may be here.
    pub fn holds_a_phase(&self) -> bool {
        self.phase != Self::NO_PHASE
    }

    /// Empties the buffer for a phase.
    pub fn begin(&mut self, phase: u64) {
        self.phase = phase;
        self.contacts.clear();
        self.places.clear();
        self.told_places.clear();
        self.terms.clear();
        self.records.clear();
        self.shares = self.lane > 0;
        self.bristles.clear();
        self.law_state.clear();
        self.demand = CapacityDemand::default();
        self.counts.clear();
        self.times = WorkTimes::default();
    }

    /// The slot of what stands at an index here.
    #[inline]
    pub fn slot_of(&self, index: usize) -> Slot {
        Slot::new(self.lane, index)
    }

    /// Whether registered laws keep numbers of contacts.
    #[inline]
    pub fn has_law_state(&self) -> bool {
        self.law_state_len > 0
    }

    /// The numbers of a contact.
    pub fn law_state_of(&self, contact: usize) -> &[f64] {
        &self.law_state[contact * self.law_state_len..(contact + 1) * self.law_state_len]
    }

    /// The same, to be written.
    pub fn law_state_mut(&mut self, contact: usize) -> &mut [f64] {
        &mut self.law_state[contact * self.law_state_len..(contact + 1) * self.law_state_len]
    }

    /// How far the buffer has got. No friction waits for what comes after that.
    pub fn checkpoint(&mut self) -> Checkpoint {
        self.settle();
        Checkpoint { contacts: self.contacts.len(), demand: self.demand, counts: self.counts }
    }

    /// Forgets all that came after a checkpoint.
    pub fn restore(&mut self, checkpoint: &Checkpoint) {
        self.contacts.truncate(checkpoint.contacts);
        self.places.truncate(checkpoint.contacts);
        self.told_places.truncate(checkpoint.contacts);
        self.terms.truncate(checkpoint.contacts);
        self.records.truncate(checkpoint.contacts);
        self.bristles.clear();
        self.law_state.truncate(checkpoint.contacts * self.law_state_len);
        self.demand = checkpoint.demand;
        self.counts = checkpoint.counts;
    }

    /// Works out all friction that waits.
    pub fn settle(&mut self) {
        let settled = self.bristles.settle(&mut self.contacts);
        if !self.records.is_empty() {
            for &place in settled {
                remember(&self.contacts, &mut self.records, place as usize);
            }
        }
    }

    /// The same, if no more can wait.
    #[inline(always)]
    pub fn settle_if_full(&mut self) {
        if self.bristles.is_full() {
            self.settle();
        }
    }

    /// Works out all friction that waits and writes where the new contacts stand and what they add to the wrenches, all at once: of
    /// lines that another core has read, a core that writes to several in a row waits for many at a time, and for each if the
    /// writes are far apart.
    pub fn finish(&mut self) {
        self.settle();
        let told = self.told_places.len();
        self.told_places.extend_from_slice(&self.places[told..]).expect("as much room as for contacts");
        for contact in &self.contacts[self.terms.len()..self.records.len()] {
            self.terms.push(Term::of(contact)).expect("as much room as for records");
        }
    }

    /// Writes what is to be remembered of a contact that is whole.
    #[inline(always)]
    pub fn remember(&mut self, place: usize) {
        if !self.records.is_empty() {
            remember(&self.contacts, &mut self.records, place);
        }
    }

    /// Whether the buffer has a record for each of its contacts.
    pub fn remembers_all(&self) -> bool {
        self.records.len() == self.contacts.len()
    }

    /// Takes over all that another [finished](Self::finish) buffer of the lane found, but for its counts, without copying a
    /// contact, and gives its memory for it.
    pub fn take_over(&mut self, other: &mut Self) {
        debug_assert!(self.lane == other.lane && self.law_state_len == 0);
        swap(&mut self.contacts, &mut other.contacts);
        swap(&mut self.places, &mut other.told_places);
        swap(&mut self.terms, &mut other.terms);
        swap(&mut self.records, &mut other.records);
        self.demand = other.demand;
        (self.phase, other.phase) = (other.phase, Self::NO_PHASE);
    }

    /// Copies all that another [finished](Self::finish) buffer found; whether there was room.
    pub fn absorb(&mut self, other: &Self) -> bool {
        let first = self.contacts.len();
        let room = self.contacts.extend_from_slice(&other.contacts).is_ok()
            && self.law_state.extend_from_slice(&other.law_state).is_ok();
        if room {
            for (index, place) in (first..).zip(&*other.places) {
                self.places.push(place.at(self.slot_of(index))).expect("as many as contacts");
            }
        }
        self.demand.add(&other.demand);
        self.counts.add(&other.counts);
        room && !other.demand.overflowed
    }

    /// A place for one more contact of this role; the caller writes it. Where there is no room the deepest so far stay, if this
    /// buffer can rank them; else the contact is lost (`None`) and the whole phase must be done again by one that can.
    #[inline]
    pub fn slot(&mut self, role: ContactRole, sealed: &Sealed) -> Option<usize> {
        self.demand.count(role);
        if self.contacts.len() == self.contacts.capacity() {
            self.demand.overflowed = true;
            if self.shares {
                return None;
            }
            self.keep_deepest(sealed.contact_capacity, sealed.record_capacity - sealed.contact_capacity);
        }
        for _ in 0..self.law_state_len {
            self.law_state.push(0.0).expect("as much room as for contacts");
        }
        if self.shares && self.records.capacity() > 0 {
            self.make_room_for_record();
        }
        self.contacts.slot().expect("ranking makes room");
        self.places.slot().expect("as many as contacts");
        Some(self.contacts.len() - 1)
    }

    /// As long as every contact has had a record, the next one gets one too.
    #[inline(never)]
    fn make_room_for_record(&mut self) {
        if self.remembers_all() && self.records.len() < self.records.capacity() {
            self.records.slot().expect("asked before");
        }
    }

    /// Adds friction that waits for nobody to a contact that has none yet.
    #[inline(never)]
    pub fn add_friction_alone(&mut self, place: usize, law: &FrictionProps, input: &FrictionInput<'_>) {
        let FrictionOutput { force_b, bristle_b, sticks, stored } =
            friction_alone(law, input, self.law_state_mut(place));
        let contact = &mut self.contacts[place];
        (contact.friction_force_b, contact.bristle_b, contact.sticks) = (force_b, bristle_b, sticks);
        contact.stored += stored;
        self.remember(place);
    }

    /// Makes room: keeps the deepest `pushing` of the contacts that push and the deepest `others` of the rest, ties
    /// by the order of sums.
    pub fn keep_deepest(&mut self, pushing: usize, others: usize) {
        self.settle();
        self.records.clear();
        let ranked = &mut self.ranked;
        ranked.clear();
        let counts = |contact: &FrameContact| contact.found.status != CandidateStatus::Culled;
        for (index, _) in self.contacts.iter().enumerate().filter(|(_, contact)| counts(contact)) {
            ranked.push(index as u32).expect("as many places as contacts");
        }
        let contacts = &self.contacts;
        ranked.sort_unstable_by(|&i, &j| {
            let (a, b) = (&contacts[i as usize].found, &contacts[j as usize].found);
            let pushes = |role: ContactRole| role == ContactRole::Active;
            pushes(b.role)
                .cmp(&pushes(a.role))
                .then(b.depth.total_cmp(&a.depth))
                .then(a.order().cmp(&b.order()))
        });
        let all_pushing = ranked.partition_point(|&i| contacts[i as usize].found.role == ContactRole::Active);
        let last = ranked.len().min(all_pushing + others);
        // The places that stay, in ascending order, so that moving forward overwrites nothing that is needed.
        let kept_pushing = all_pushing.min(pushing);
        ranked.as_mut_slice().copy_within(all_pushing..last, kept_pushing);
        ranked.truncate(kept_pushing + last - all_pushing);
        ranked.sort_unstable();
        for (to, &from) in ranked.iter().enumerate() {
            self.contacts[to] = self.contacts[from as usize];
            self.places[to] = self.places[from as usize].at(Slot::new(self.lane, to));
            let stride = self.law_state_len;
            let from = from as usize * stride;
            self.law_state.as_mut_slice().copy_within(from..from + stride, to * stride);
        }
        self.contacts.truncate(ranked.len());
        self.places.truncate(ranked.len());
        self.law_state.truncate(ranked.len() * self.law_state_len);
    }
}

/// Writes the record of a contact, if there is one.
#[inline(never)]
fn remember(contacts: &[FrameContact], records: &mut [ContactRecord], place: usize) {
    if let Some(record) = records.get_mut(place) {
        contacts[place].write_record(record);
    }
}
