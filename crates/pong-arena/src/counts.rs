//! Counters of the bytes requested from an arena since its last reset, and of the maximum between two resets.

use std::cell::Cell;

/// Bytes handed out and bytes refused since the last reset, and their maximum.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    used: Cell<usize>,
    refused: Cell<usize>,
    /// Maximum of `used` + `refused` up to the last reset. The method `peak` also includes the requests since
    /// then.
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

    /// Returns the number of bytes handed out since the last reset.
    #[inline]
    pub(crate) fn used(&self) -> usize {
        self.used.get()
    }

    /// Returns the most bytes handed out and refused between two resets.
    #[inline]
    pub(crate) fn peak(&self) -> usize {
        self.peak.get().max(self.used.get().saturating_add(self.refused.get()))
    }

    /// Counts a granted request.
    #[inline]
    pub(crate) fn take(&self, bytes: usize) {
        self.used.set(self.used.get() + bytes);
    }

    /// Counts a refused request, which matters for the peak only.
    pub(crate) fn refuse(&self, bytes: usize) {
        self.refused.set(self.refused.get().saturating_add(bytes));
    }
}
