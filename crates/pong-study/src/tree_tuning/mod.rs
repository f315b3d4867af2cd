//! Bounding volumes and leaves that lower the frame time of a run, for the same bits: the models of a scene or of a log are
//! given other kinds of volumes, fewer of them, smaller or larger leaves; every proposal must answer as before, bit for
//! bit, and what is faster by more than noise is written as a new model file. What it means: `docs/tune.md`.
//!
//! A sweep (`sweep`) asks what each lever costs in accuracy; here no answer may change, and what is looked for is a model.
//!
//! | file | is |
//! |---|---|
//! | `moves.rs` | what may be changed in one step |
//! | `bench.rs`, `search.rs` | proposals measured in turn; which are tried, which are taken |
//! | `tune.rs` | all of it |
//! | `report.rs`, `words.rs` | the page; changes in words |

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
