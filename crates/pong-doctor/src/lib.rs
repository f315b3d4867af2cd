//! Real-time properties of a machine: cores, clocks, limits and priorities from Linux's `/proc` and `/sys`,
//! and the measured time in which a thread wakes up. The purpose of each item, and the cure where it is not
//! granted, is in docs/realtime.md. Other systems are asked for what a process can ask
//! ([`examine_elsewhere`]).
//!
//! [`examine_this_machine`] reads, [`measure`] measures; neither leaves a lasting change.

#![forbid(unsafe_code)]

mod cores;
mod cpu_set;
mod files;
mod finding;
mod kernel;
mod latency;
mod limits;
mod platform;

pub use cpu_set::CpuSet;
pub use files::{Files, ThisMachine};
pub use finding::{Finding, State};
pub use latency::{BIN_BOUNDS_US, Latency, measure, try_fifo};
pub use platform::examine_elsewhere;

use pong_threads::system::{GRANTS, cores};

/// All findings about the machine that the program runs on. `fifo` is the answer of the system to a thread that asked
/// for SCHED_FIFO, from [`try_fifo`].
pub fn examine_this_machine(fifo: Result<(), String>) -> Vec<Finding> {
    let mut findings = vec![platform::platform()];
    findings.extend(match cfg!(target_os = "linux") {
        true => examine(&ThisMachine, fifo),
        false => examine_elsewhere(&GRANTS, cores().len(), fifo),
    });
    findings.push(instructions());
    findings
}

/// All findings that Linux's files tell. `fifo` is the answer of the system to a thread that asked for SCHED_FIFO,
/// from [`try_fifo`].
pub fn examine(files: &impl Files, fifo: Result<(), String>) -> Vec<Finding> {
    let mut findings = cores::examine(files);
    findings.extend(limits::examine(files, fifo));
    findings.extend(kernel::examine(files));
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
