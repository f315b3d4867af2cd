//! What the benchmark programs share: scenes, peers on the same scenes, clocks, counters and tables.

pub mod berthing;
pub mod cloud;
pub mod difference;
pub mod docking;
pub mod floor;
pub mod folder;
pub mod heap;
pub mod hull;
pub mod motion;
pub mod one_by_one;
pub mod optional;
pub mod options;
pub mod ours;
pub mod pairs;
pub mod peer;
pub mod plot;
pub mod race;
pub mod random;
pub mod rig;
pub mod ring;
pub mod ron;
pub mod scenes;
pub mod table;
pub mod terrain;
pub mod timing;
pub mod volumes;
