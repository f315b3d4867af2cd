//! Windows.

use super::grants::Grants;

const NO_FIFO: &str = "Windows has no SCHED_FIFO; start the program in a higher class: start /high PROGRAM";

/// Threads can be bound to the first 64 cores; priorities are those of the class of the process.
pub const GRANTS: Grants = Grants { system: "Windows", no_binding: None, no_fifo: Some(NO_FIFO) };

/// Returns the cores of the affinity mask; none if the system reports none.
pub fn cores() -> Vec<usize> {
    let listed = core_affinity::get_core_ids().unwrap_or_default();
    listed.iter().map(|core| core.id).collect()
}

/// Binds the calling thread to a core.
pub fn bind(core: usize) -> Result<(), String> {
    // The system's mask has 64 bits.
    if core < 64 && core_affinity::set_for_current(core_affinity::CoreId { id: core }) {
        return Ok(());
    }
    Err("the system does not let this thread run there".to_owned())
}

/// Refuses: priorities are relative to the class of the process, which is the host's to choose.
pub fn raise_priority(_priority: u8) -> Result<(), String> {
    Err(NO_FIFO.to_owned())
}

/// Does nothing: a new thread has normal priority.
pub fn lower_priority() {}

/// Runs `start`: Windows delivers no signals to threads.
pub fn without_signals<T>(start: impl FnOnce() -> T) -> T {
    start()
}
