//! Clock of a world whose stages are timed.

use std::sync::OnceLock;
use std::time::Instant;

/// CLOCK_MONOTONIC at the first call.
static ORIGIN: OnceLock<Instant> = OnceLock::new();

/// Time since the first call, ns.
pub(crate) fn now_ns() -> u64 {
    u64::try_from(ORIGIN.get_or_init(Instant::now).elapsed().as_nanos()).unwrap_or(u64::MAX)
}
