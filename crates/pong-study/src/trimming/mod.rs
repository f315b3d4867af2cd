//! Models without the primitives that runs never came near: the wrenches of these runs stay the same bits.
//! See `docs/trim.md`.
//!
//! | file | is |
//! |---|---|
//! | `shape.rs` | extent of a primitive, and a lower bound of the distance between two |
//! | `nearness.rs` | least distance of each primitive of each model from any partner in a run |
//! | `choice.rs` | choice of the primitives to remove |
//! | `trim.rs` | the whole procedure |
//! | `report.rs` | the report |

mod choice;
mod nearness;
pub mod report;
mod shape;
mod trim;

#[cfg(test)]
mod tests;

pub use crate::runs::{Counts, Output};
pub use trim::{Gone, ModelTrimmed, RunTrimmed, Settings, Trimmed, trim};
