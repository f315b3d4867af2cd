//! What the benchmark programs share: scenes, the peer on the same scenes, clocks and counters.

pub mod heap;
pub mod options;
pub mod peer;
pub mod random;
pub mod rig;
pub mod ring;
pub mod ron;
pub mod terrain;
pub mod timing;
