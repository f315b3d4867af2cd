//! Bytes requested from an arena since its last reset, and the maximum between two resets.

use std::cell::Cell;

/// Bytes handed out and bytes refused.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    used: Cell<usize>,
    refused: Cell<usize>,
    /// Maximum up to the last reset; `peak()` also includes the requests since then.
    peak: Cell<usize>,
}

impl Counts {
    /// Clears the bytes handed out and refused; keeps the peak.
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

    /// Most bytes handed out and refused between two resets.
    #[inline]
    pub(crate) fn peak(&self) -> usize {
        self.peak.get().max(self.used.get().saturating_add(self.refused.get()))
    }

    /// Adds a granted request.
    #[inline]
    pub(crate) fn take(&self, bytes: usize) {
        self.used.set(self.used.get() + bytes);
    }

    /// Adds a refused request, which counts for the peak only.
    pub(crate) fn refuse(&self, bytes: usize) {
        self.refused.set(self.refused.get().saturating_add(bytes));
    }
}
