//! Runs of the engine, studied: a scene or a log is run again and again.
//!
//! * [`sweep`]: over the levers that buy speed, each against a reference. What it means: `docs/trade.md`.
//! * [`tree_tuning`]: with other bounding volumes and leaves, the same bits demanded. What it means: `docs/tune.md`.

#![forbid(unsafe_code)]

mod error;
pub mod sweep;
pub mod tree_tuning;

pub use error::{Result, StudyError};
