//! What went through something, as a frame tells it.

/// What went through.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TunnellingEvents {
    /// How often an element of A did: once per place at most.
    pub count: u32,
    /// The first in the order of plans.
    pub first: Option<TunnellingEvent>,
}

/// An element of A that went through B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TunnellingEvent {
    pub body_a: usize,
    pub primitive_a: u32,
    pub body_b: usize,
}

impl TunnellingEvents {
    /// One passage more.
    pub fn note(&mut self, passed: TunnellingEvent) {
        self.count = self.count.saturating_add(1);
        self.first.get_or_insert(passed);
    }
}
