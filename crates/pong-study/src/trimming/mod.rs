//! What runs never came near, and models without it: the wrenches of these runs stay the same bits. What it means:
//! `docs/trim.md`.
//!
//! | file | is |
//! |---|---|
//! | `shape.rs` | how far a primitive reaches, and how far two of them are apart at least |
//! | `nearness.rs` | how near each primitive of each model came to any partner in a run |
//! | `choice.rs` | which primitives of a model go |
//! | `trim.rs` | all of it |
//! | `report.rs` | the page |

mod choice;
mod nearness;
pub mod report;
mod shape;
mod trim;

#[cfg(test)]
mod tests;

pub use crate::runs::{Counts, Output};
pub use trim::{Gone, ModelTrimmed, RunTrimmed, Settings, Trimmed, trim};
