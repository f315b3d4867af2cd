//! What all lanes of a frame have found, wherever it stands.

use super::contact::FrameContact;
use super::contact_buffer::ContactBuffer;
use super::place::Place;
use super::term::Term;
use std::ops::{Deref, DerefMut};

/// What all lanes of a frame have found: the caller's buffer, and those of workers that were taken over as they are.
#[derive(Clone, Copy)]
pub(crate) struct FoundContacts<'a> {
    pub caller: &'a ContactBuffer,
    pub workers: &'a [ContactBuffer],
}

impl<'a> FoundContacts<'a> {
    #[inline]
    fn lane(&self, place: &Place) -> &'a ContactBuffer {
        match place.slot.lane() {
            0 => self.caller,
            worker => &self.workers[worker - 1],
        }
    }

    #[inline]
    pub fn contact(&self, place: &Place) -> &'a FrameContact {
        &self.lane(place).contacts[place.slot.index()]
    }

    /// What a contact adds to the wrenches.
    #[inline]
    pub fn term(&self, place: &Place) -> Term {
        match place.slot.lane() {
            0 => Term::of(&self.caller.contacts[place.slot.index()]),
            worker => self.workers[worker - 1].terms[place.slot.index()],
        }
    }

    /// All lanes, the caller's first.
    pub fn lanes(&self) -> impl Iterator<Item = &'a ContactBuffer> + Clone + use<'a> {
        std::iter::once(self.caller).chain(self.workers)
    }
}

/// Memory for what each worker finds. In a frame of the caller alone it stands empty and out of sight: to look at each buffer
/// is to wait for a cache line.
#[derive(Debug)]
pub(crate) struct WorkerBuffers {
    all: Vec<ContactBuffer>,
    in_use: bool,
}

impl WorkerBuffers {
    /// Those of all workers, which are not in use.
    pub fn new(all: Vec<ContactBuffer>) -> Self {
        Self { all, in_use: false }
    }

    /// All of them, for a round that the workers share.
    pub fn put_to_use(&mut self) -> &mut [ContactBuffer] {
        self.in_use = true;
        &mut self.all
    }

    /// Empties those that are in use; none is any more.
    #[inline]
    pub fn empty(&mut self) {
        self.iter_mut().filter(|buffer| buffer.holds_a_phase()).for_each(|buffer| {
            buffer.begin(ContactBuffer::NO_PHASE);
        });
        self.in_use = false;
    }
}

/// Those in use: all, or none.
impl Deref for WorkerBuffers {
    type Target = [ContactBuffer];

    #[inline]
    fn deref(&self) -> &[ContactBuffer] {
        if self.in_use { &self.all } else { &[] }
    }
}

impl DerefMut for WorkerBuffers {
    #[inline]
    fn deref_mut(&mut self) -> &mut [ContactBuffer] {
        if self.in_use { &mut self.all } else { &mut [] }
    }
}
