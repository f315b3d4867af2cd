//! Systems without threads that can be bound or given a priority, WebAssembly above all.

use super::grants::Grants;

const NO_BINDING: &str = "this system binds no thread to a core";
const NO_FIFO: &str = "this system has no SCHED_FIFO";

/// Nothing is granted.
pub const GRANTS: Grants =
    Grants { system: std::env::consts::OS, no_binding: Some(NO_BINDING), no_fifo: Some(NO_FIFO) };

/// Returns the numbers of the cores.
pub fn cores() -> Vec<usize> {
    (0..std::thread::available_parallelism().map_or(1, usize::from)).collect()
}

/// Refuses.
pub fn bind(_core: usize) -> Result<(), String> {
    Err(NO_BINDING.to_owned())
}

/// Refuses.
pub fn raise_priority(_priority: u8) -> Result<(), String> {
    Err(NO_FIFO.to_owned())
}

/// Does nothing.
pub fn lower_priority() {}

/// Runs `start`.
pub fn without_signals<T>(start: impl FnOnce() -> T) -> T {
    start()
}
