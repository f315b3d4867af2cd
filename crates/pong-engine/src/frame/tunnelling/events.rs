//! Tunnelling events of a frame.

/// Tunnelling events of a frame.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TunnellingEvents {
    /// Number of events: at most one per batch of B for each followed point or axis of A, and one per ended
    /// contact.
    pub count: u32,
    /// First event, in the order of pairs and directions.
    pub first: Option<TunnellingEvent>,
}

/// An element of A that passed through B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TunnellingEvent {
    pub body_a: usize,
    pub primitive_a: u32,
    pub body_b: usize,
}

impl TunnellingEvents {
    /// Records one event.
    pub fn note(&mut self, passed: TunnellingEvent) {
        self.count = self.count.saturating_add(1);
        self.first.get_or_insert(passed);
    }
}
