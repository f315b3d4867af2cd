//! Linux, with glibc or musl.

use super::grants::Grants;
pub use super::posix::{lower_priority, raise_priority, without_signals};

/// Everything that is asked for, where the limits of the process allow it.
pub const GRANTS: Grants = Grants { system: "Linux", no_binding: None, no_fifo: None };

/// Returns the cores of the affinity mask; none if the system reports none.
pub fn cores() -> Vec<usize> {
    let listed = core_affinity::get_core_ids().unwrap_or_default();
    listed.iter().map(|core| core.id).collect()
}

/// Binds the calling thread to a core.
pub fn bind(core: usize) -> Result<(), String> {
    // `core_affinity` would write past the system's set.
    if core < libc::CPU_SETSIZE as usize && core_affinity::set_for_current(core_affinity::CoreId { id: core })
    {
        return Ok(());
    }
    Err("the system does not let this thread run there".to_owned())
}
