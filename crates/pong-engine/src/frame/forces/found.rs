//! View of the contacts that all threads of a frame have found.

use super::contact::FrameContact;
use super::contact_buffer::ContactBuffer;
use super::contact_ref::ContactRef;
use std::ops::{Deref, DerefMut};

/// Contacts of a frame: the caller's buffer and the workers' buffers that were swapped in.
#[derive(Clone, Copy)]
pub(crate) struct FoundContacts<'a> {
    pub caller: &'a ContactBuffer,
    pub workers: &'a [ContactBuffer],
}

impl<'a> FoundContacts<'a> {
    /// Contact of a reference.
    #[inline]
    pub fn contact(&self, reference: &ContactRef) -> &'a FrameContact {
        let buffer = match reference.slot.thread() {
            0 => self.caller,
            worker => &self.workers[worker - 1],
        };
        &buffer.contacts[reference.slot.index()]
    }

    /// Buffers of all threads, the caller's first.
    pub fn threads(&self) -> impl Iterator<Item = &'a ContactBuffer> + Clone + use<'a> {
        std::iter::once(self.caller).chain(self.workers)
    }
}

/// A second contact buffer for each worker, swapped with the worker's own after a round. Buffers not in use
/// read as an empty slice: in a frame without workers, each look at a buffer would cost a cache miss.
#[derive(Debug)]
pub(crate) struct WorkerBuffers {
    all: Vec<ContactBuffer>,
    in_use: bool,
}

impl WorkerBuffers {
    /// Buffers of all workers, not in use.
    pub fn new(all: Vec<ContactBuffer>) -> Self {
        Self { all, in_use: false }
    }

    /// Marks all buffers as in use, for a round on the workers, and returns them.
    pub fn put_to_use(&mut self) -> &mut [ContactBuffer] {
        self.in_use = true;
        &mut self.all
    }

    /// Empties the buffers that hold a phase, and marks all as not in use.
    #[inline]
    pub fn empty(&mut self) {
        self.iter_mut().filter(|buffer| buffer.holds_a_phase()).for_each(|buffer| {
            buffer.begin(ContactBuffer::NO_PHASE);
        });
        self.in_use = false;
    }
}

/// All buffers if they are in use, otherwise none.
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
