//! Contacts of a frame in summation order.

use crate::frame::forces::contact::FrameContact;
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::forces::found::FoundContacts;

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
        self.order.iter().filter(|place| place.pushes()).map(move |place| found.contact(place))
    }

    /// References to the contacts whose keys have this high word.
    pub fn with_head(&self, head: u64) -> impl Iterator<Item = &'a ContactRef> + use<'a> {
        let first = self.order.partition_point(|place| place.head < head);
        self.order[first..].iter().take_while(move |place| place.head == head)
    }
}
