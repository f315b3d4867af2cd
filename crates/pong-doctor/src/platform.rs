//! The platform itself: system, processor, and what no setting of it can grant.

use crate::{Finding, State};
use pong_threads::system::{GRANTS, Grants};

/// Finding with the names of the system and the processor.
pub(crate) fn platform() -> Finding {
    Finding::new(
        "platform",
        State::Info,
        format!("{} on {}", GRANTS.system, std::env::consts::ARCH),
        "The results are the same bits on every platform; docs/platforms.md says what each of them lacks.",
    )
}

/// Findings of a system without `/proc` and `/sys`, which the process is asked for. `cores` is the number of cores
/// that the process may use, `fifo` the answer to a thread that asked for SCHED_FIFO.
pub fn examine_elsewhere(grants: &Grants, cores: usize, fifo: Result<(), String>) -> Vec<Finding> {
    let binding = "A thread that is not bound may be moved to another core within a frame.";
    vec![
        Finding::judged(
            "cores",
            cores > 1,
            format!("this process may use {cores}"),
            "A real-time thread wants a core of its own, beside one for the rest of the system; each worker wants one more.",
            "Start the program with more cores.",
        ),
        match grants.no_binding {
            None => Finding::new("core binding", State::Good, "threads can be bound".to_owned(), binding),
            Some(why) => Finding::new("core binding", State::Info, why.to_owned(), binding),
        },
        Finding::judged(
            "SCHED_FIFO",
            fifo.is_ok(),
            fifo.map_or_else(|why| why, |()| "granted to a thread that asked for it".to_owned()),
            "Without a real-time priority any other thread delays a frame by its time slice: milliseconds.",
            "Run what must be in time on Linux, with the settings of docs/realtime.md.",
        ),
        Finding::unknown(
            "everything else",
            "clock rates, idle states, locked memory and preemption are read on Linux alone",
            "Measure on the machine of the simulation, with its load.",
        ),
    ]
}
