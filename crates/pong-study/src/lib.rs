//! Runs of the engine, studied: a scene or a log is run again and again.
//!
//! * [`sweep`]: over the levers that buy speed, each against a reference. What it means: `docs/trade.md`.
//! * [`tree_tuning`]: with other bounding volumes and leaves, the same bits demanded. What it means: `docs/tune.md`.
//! * [`trimming`]: without the primitives that a run never came near. What it means: `docs/trim.md`.

#![forbid(unsafe_code)]

mod error;
mod runs;
pub mod sweep;
pub mod tree_tuning;
pub mod trimming;

pub use error::{Result, StudyError};
