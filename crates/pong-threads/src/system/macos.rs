//! macOS. Cross-built and not run yet.

use super::grants::Grants;
pub use super::posix::{lower_priority, raise_priority, without_signals};

const NO_BINDING: &str = "macOS binds no thread to a core";

/// Threads cannot be bound.
pub const GRANTS: Grants = Grants { system: "macOS", no_binding: Some(NO_BINDING), no_fifo: None };

/// Returns the numbers of the cores.
pub fn cores() -> Vec<usize> {
    (0..std::thread::available_parallelism().map_or(1, usize::from)).collect()
}

/// Refuses: what macOS offers in place of a binding is a hint, and none on Apple's own processors.
pub fn bind(_core: usize) -> Result<(), String> {
    Err(NO_BINDING.to_owned())
}
