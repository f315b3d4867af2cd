//! How wide all is.

/// How many numbers are worked on at a time.
pub const LANES: usize = 8;

/// One bit per lane: the lowest is lane 0.
pub type LaneBits = u8;
