//! Number of lanes, and masks of lanes.

/// Number of lanes: the count of numbers that are processed at a time.
pub const LANES: usize = 8;

/// Bit mask of lanes; the lowest bit is lane 0.
pub type LaneBits = u8;
