//! The number of the binary interface.

/// Number of the binary interface: the N of libpong.so.N.
pub const PONG_ABI_VERSION: u32 = 0;
