//! Name and version of the format.

/// The version of the format that is written. Version 1, which is also read, has other names for some fields.
pub const VERSION: u64 = 2;

/// Name of the format.
pub(crate) const FORMAT: &str = "pong-log";
