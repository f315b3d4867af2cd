//! Bounding volumes and leaves that lower the frame time of a run, with the same bits: the models of a scene
//! or of a log get other kinds of volumes, fewer of them, smaller or larger leaves. Every proposal must give
//! the same answers, bit for bit, and one that is faster by more than noise is written as a new model file.
//! See `docs/tune.md`.
//!
//! A sweep (`sweep`) measures the cost of each lever in accuracy; here no answer may change, and the result
//! is a model.
//!
//! | file | is |
//! |---|---|
//! | `moves.rs` | changes made in one step |
//! | `bench.rs`, `search.rs` | proposals measured in turn; the search among them |
//! | `tune.rs` | the whole procedure |
//! | `report.rs`, `words.rs` | the report; changes in words |

mod bench;
mod moves;
pub mod report;
mod search;
mod tune;
mod words;

#[cfg(test)]
mod tests;

pub use crate::runs::{Counts, Output};
pub use tune::{ModelTuned, Progress, RunTuned, Settings, Tuned, tune};
