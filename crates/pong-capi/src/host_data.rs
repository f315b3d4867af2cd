//! Numbers of the host's that are kept with Objects and primitives.

use std::collections::HashMap;

/// What was set; everything else is 0.
#[derive(Clone, Default)]
pub(crate) struct UserData {
    pub objects: HashMap<u64, u64>,
    pub primitives: HashMap<(u64, u32), u64>,
}
