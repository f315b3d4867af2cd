//! The clock that a world is given if its stages are to be timed.

use std::sync::OnceLock;
use std::time::Instant;

/// When this was first asked, by CLOCK_MONOTONIC.
static ORIGIN: OnceLock<Instant> = OnceLock::new();

/// Time since then, ns.
pub(crate) fn now_ns() -> u64 {
    u64::try_from(ORIGIN.get_or_init(Instant::now).elapsed().as_nanos()).unwrap_or(u64::MAX)
}
