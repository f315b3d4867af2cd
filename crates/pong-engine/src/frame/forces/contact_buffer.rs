//! Buffer of the contacts that one thread finds, unordered and of fixed capacity. It also counts the contacts
//! for which it has no room.

use super::bristles::PendingBristles;
use crate::frame::forces::contact::FrameContact;
use crate::frame::forces::contact_ref::{ContactRef, Slot};
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::law::FrictionProps;
use crate::law::friction::{FrictionInput, FrictionOutput, friction_alone};
use crate::report::{FrameCounts, WorkTimes};
use crate::seal::Sealed;
use crate::state::ContactRole;
use pong_arena::Table;
use std::mem::swap;

/// Contacts with their forces, and the counts and times of the search.
#[derive(Debug)]
pub(crate) struct ContactBuffer {
    /// Thread index; 0 is the caller.
    thread: usize,
    /// Phase ([`WorkerInput::phase`](crate::frame::input::WorkerInput)) whose contacts the buffer holds, or
    /// [`Self::NO_PHASE`].
    pub phase: u64,
    /// Contacts, unordered.
    pub contacts: Table<FrameContact>,
    /// References to the contacts, one each.
    pub refs: Table<ContactRef>,
    /// Contacts whose friction is pending.
    pub(super) bristles: PendingBristles,
    /// State of registered friction laws, `law_state_len` numbers per contact.
    pub law_state: Table<f64>,
    pub law_state_len: usize,
    /// Scratch for ranking the contacts by depth. Caller's buffer only.
    ranked: Table<u32>,
    /// True while other threads find contacts for the same frame. If the buffer overflows then, the caller
    /// repeats the round alone.
    pub shares: bool,
    pub demand: CapacityDemand,
    pub counts: FrameCounts,
    /// Time per kind of work; zero without a clock.
    pub times: WorkTimes,
}

/// Capacity that a frame needs, whether available or not.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CapacityDemand {
    /// Contacts that push.
    pub pushing: u64,
    /// Contacts that are only remembered.
    pub remembered: u64,
    /// Largest number of candidates of a chunk for which the list of candidates was too short.
    pub at_once: u64,
    /// True if any buffer was too small.
    pub overflowed: bool,
    /// True if one surface had too many contacts with one primitive of A for exact load sharing.
    pub unshared: bool,
    /// Contacts deeper in a mesh than the regions below its facets.
    pub deep_in_meshes: DeepInMeshes,
}

/// Contacts deeper in a mesh that is not convex than the regions below its facets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct DeepInMeshes {
    /// Number of facets whose region another solid reaches down to the floor.
    pub facets: u32,
    /// Bodies of such a mesh and of that solid: those with the lowest indices, because the order in which threads find
    /// contacts must not matter.
    pub first: Option<(usize, usize)>,
}

impl DeepInMeshes {
    /// Counts facets of a mesh. `bodies` are those of the mesh and of the solid in it.
    pub fn note(&mut self, bodies: (usize, usize), facets: u32) {
        if facets > 0 {
            self.add(&Self { facets, first: Some(bodies) });
        }
    }

    fn add(&mut self, other: &Self) {
        self.facets = self.facets.saturating_add(other.facets);
        self.first = self.first.into_iter().chain(other.first).min();
    }
}

impl CapacityDemand {
    /// Counts one contact.
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
        self.deep_in_meshes.add(&other.deep_in_meshes);
    }
}

/// State of a buffer that `restore` returns to.
pub(crate) struct Checkpoint {
    contacts: usize,
    demand: CapacityDemand,
    counts: FrameCounts,
}

impl ContactBuffer {
    /// Phase of an empty buffer.
    pub const NO_PHASE: u64 = 0;

    /// Allocates room for this many contacts. The caller's buffer also gets room to rank contacts by depth, to
    /// keep the deepest if there are too many.
    pub fn new(thread: usize, law_state_len: usize, contacts: usize) -> Self {
        Self {
            thread,
            phase: Self::NO_PHASE,
            contacts: Table::with_capacity(contacts, FrameContact::blank()),
            refs: Table::with_capacity(contacts, ContactRef::NOWHERE),
            bristles: PendingBristles::new(),
            law_state: Table::with_capacity(contacts * law_state_len, 0.0),
            law_state_len,
            ranked: Table::with_capacity(if thread == 0 { contacts } else { 0 }, 0),
            shares: thread > 0,
            demand: CapacityDemand::default(),
            counts: FrameCounts::default(),
            times: WorkTimes::default(),
        }
    }

    /// Returns true if the buffer may hold contacts of a phase.
    pub fn holds_a_phase(&self) -> bool {
        self.phase != Self::NO_PHASE
    }

    /// Empties the buffer for a new phase.
    pub fn begin(&mut self, phase: u64) {
        self.phase = phase;
        self.contacts.clear();
        self.refs.clear();
        self.shares = self.thread > 0;
        self.bristles.clear();
        self.law_state.clear();
        self.demand = CapacityDemand::default();
        self.counts.clear();
        self.times = WorkTimes::default();
    }

    /// Slot of the contact at an index of this buffer.
    #[inline]
    pub fn slot_of(&self, index: usize) -> Slot {
        Slot::new(self.thread, index)
    }

    /// Returns true if registered friction laws have state.
    #[inline]
    pub fn has_law_state(&self) -> bool {
        self.law_state_len > 0
    }

    /// Friction-law state of a contact.
    pub fn law_state_of(&self, contact: usize) -> &[f64] {
        &self.law_state[contact * self.law_state_len..(contact + 1) * self.law_state_len]
    }

    /// Friction-law state of a contact, mutable.
    pub fn law_state_mut(&mut self, contact: usize) -> &mut [f64] {
        &mut self.law_state[contact * self.law_state_len..(contact + 1) * self.law_state_len]
    }

    /// Current state of the buffer. Pending friction is computed first.
    pub fn checkpoint(&mut self) -> Checkpoint {
        self.flush();
        Checkpoint { contacts: self.contacts.len(), demand: self.demand, counts: self.counts }
    }

    /// Discards everything added since a checkpoint.
    pub fn restore(&mut self, checkpoint: &Checkpoint) {
        self.contacts.truncate(checkpoint.contacts);
        self.refs.truncate(checkpoint.contacts);
        self.bristles.clear();
        self.law_state.truncate(checkpoint.contacts * self.law_state_len);
        self.demand = checkpoint.demand;
        self.counts = checkpoint.counts;
    }

    /// Computes all pending friction.
    pub fn flush(&mut self) {
        self.bristles.flush(&mut self.contacts);
    }

    /// Computes the pending friction if eight contacts need it.
    #[inline(always)]
    pub fn flush_if_full(&mut self) {
        if self.bristles.is_full() {
            self.flush();
        }
    }

    /// Moves the contacts and the demand out of another [flushed](Self::flush) buffer of the same thread, by
    /// swapping the tables. Its counts and times stay there.
    pub fn move_from(&mut self, other: &mut Self) {
        debug_assert!(self.thread == other.thread && self.law_state_len == 0);
        swap(&mut self.contacts, &mut other.contacts);
        swap(&mut self.refs, &mut other.refs);
        self.demand = other.demand;
        (self.phase, other.phase) = (other.phase, Self::NO_PHASE);
    }

    /// Adds the contacts, the demand and the counts of another [flushed](Self::flush) buffer. Returns false
    /// if there is not enough room, or if that buffer has overflowed.
    pub fn merge(&mut self, other: &Self) -> bool {
        let first = self.contacts.len();
        let room = self.contacts.extend_from_slice(&other.contacts).is_ok()
            && self.law_state.extend_from_slice(&other.law_state).is_ok();
        if room {
            for (index, contact) in (first..).zip(&*other.refs) {
                self.refs.push(contact.at(self.slot_of(index))).expect("as many as contacts");
            }
        }
        self.demand.add(&other.demand);
        self.counts.add(&other.counts);
        room && !other.demand.overflowed
    }

    /// Index for one more contact of this role, to be written by the calling function. If the buffer is full:
    ///
    /// * While other threads find contacts (`shares`), the contact is dropped (`None`), and the calling
    ///   thread has to repeat the round alone.
    /// * Otherwise the deepest contacts are kept to make room.
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
        self.contacts.slot().expect("ranking makes room");
        self.refs.slot().expect("as many as contacts");
        Some(self.contacts.len() - 1)
    }

    /// Computes the friction of one contact alone, by a law other than the bristle.
    #[inline(never)]
    pub fn add_friction_alone(&mut self, index: usize, law: &FrictionProps, input: &FrictionInput<'_>) {
        let FrictionOutput { force_b, bristle_b, sticks, stored } =
            friction_alone(law, input, self.law_state_mut(index));
        let contact = &mut self.contacts[index];
        (contact.friction_force_b, contact.bristle_b, contact.sticks) = (force_b, bristle_b, sticks);
        contact.stored += stored;
    }

    /// Makes room: keeps the deepest `pushing` contacts that push, and the deepest `others` of those that do
    /// not. Of equally deep contacts those first in summation order are kept. Culled contacts are dropped.
    pub fn keep_deepest(&mut self, pushing: usize, others: usize) {
        self.flush();
        let ranked = &mut self.ranked;
        ranked.clear();
        let counts = |contact: &FrameContact| contact.found.status != CandidateStatus::Culled;
        for (index, _) in self.contacts.iter().enumerate().filter(|(_, contact)| counts(contact)) {
            ranked.push(index as u32).expect("as many ranks as contacts");
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
        // Sort the kept indices, so that moving contacts forward overwrites none that is still needed.
        let kept_pushing = all_pushing.min(pushing);
        ranked.as_mut_slice().copy_within(all_pushing..last, kept_pushing);
        ranked.truncate(kept_pushing + last - all_pushing);
        ranked.sort_unstable();
        for (to, &from) in ranked.iter().enumerate() {
            self.contacts[to] = self.contacts[from as usize];
            self.refs[to] = self.refs[from as usize].at(Slot::new(self.thread, to));
            let stride = self.law_state_len;
            let from = from as usize * stride;
            self.law_state.as_mut_slice().copy_within(from..from + stride, to * stride);
        }
        self.contacts.truncate(ranked.len());
        self.refs.truncate(ranked.len());
        self.law_state.truncate(ranked.len() * self.law_state_len);
    }
}
