//! What a machine grants a real-time program: cores, clocks, limits and priorities as Linux tells them in `/proc` and
//! `/sys`, and the measured time in which a thread wakes up. What each item is good for, and the cure where it is not
//! granted, is in docs/realtime.md.
//!
//! [`examine`] reads, [`measure`] measures; neither changes anything that outlives it.

#![forbid(unsafe_code)]

mod cores;
mod cpu_set;
mod files;
mod finding;
mod kernel;
mod latency;
mod limits;

pub use cpu_set::CpuSet;
pub use files::{Files, ThisMachine};
pub use finding::{Finding, State};
pub use latency::{BIN_BOUNDS_US, Latency, measure, try_fifo};

/// Everything that can be read. `fifo` is the answer of the system to a thread that asked for SCHED_FIFO, from
/// [`try_fifo`].
pub fn examine(files: &impl Files, fifo: Result<(), String>) -> Vec<Finding> {
    let mut findings = cores::examine(files);
    findings.extend(limits::examine(files, fifo));
    findings.extend(kernel::examine(files));
    findings.push(instructions());
    findings
}

fn instructions() -> Finding {
    let level = pong_geometry::simd::level_name();
    Finding::new(
        "instruction set",
        State::Info,
        level.to_owned(),
        "Bounding volumes and contact testers use these instructions. The results are the same bits with all of them.",
    )
}
