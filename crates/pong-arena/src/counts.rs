//! How much was asked of an arena: since its last reset, and at most.

use std::cell::Cell;

/// Bytes that were handed out and bytes that were refused.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    used: Cell<usize>,
    refused: Cell<usize>,
    /// Of the past: what there is now is looked at when the arena is reset, or when somebody asks.
    peak: Cell<usize>,
}

impl Counts {
    /// Forgets what was handed out and refused; the peak stays.
    #[inline]
    pub(crate) fn reset(&self) {
        self.peak.set(self.peak());
        self.used.set(0);
        self.refused.set(0);
    }

    /// Bytes handed out since the last reset.
    #[inline]
    pub(crate) fn used(&self) -> usize {
        self.used.get()
    }

    /// The most bytes that were handed out and refused between two resets.
    #[inline]
    pub(crate) fn peak(&self) -> usize {
        self.peak.get().max(self.used.get().saturating_add(self.refused.get()))
    }

    /// Books what was handed out.
    #[inline]
    pub(crate) fn take(&self, bytes: usize) {
        self.used.set(self.used.get() + bytes);
    }

    /// Remembers what did not fit, for the peak.
    pub(crate) fn refuse(&self, bytes: usize) {
        self.refused.set(self.refused.get().saturating_add(bytes));
    }
}
