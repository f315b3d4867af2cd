//! Real-time properties of a machine: cores, clocks, limits and priorities from Linux's `/proc` and `/sys`,
//! and the measured time in which a thread wakes up. The purpose of each item, and the cure where it is not
//! granted, is in docs/realtime.md.
//!
//! [`examine`] reads, [`measure`] measures; neither leaves a lasting change.

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

/// All findings that can be read. `fifo` is the answer of the system to a thread that asked for SCHED_FIFO,
/// from [`try_fifo`].
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
