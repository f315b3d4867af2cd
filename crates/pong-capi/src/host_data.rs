//! User data of Objects and primitives.

use std::collections::HashMap;

/// Values that were set; all others are 0.
#[derive(Clone, Default)]
pub(crate) struct UserData {
    pub objects: HashMap<u64, u64>,
    pub primitives: HashMap<(u64, u32), u64>,
}
