//! Studies: a scene or a log is run many times with changes.
//!
//! * [`sweep`]: the options that buy speed, each against a reference. See `docs/trade.md`.
//! * [`tree_tuning`]: other bounding volumes and leaves, with the same bits required. See `docs/tune.md`.

#![forbid(unsafe_code)]

mod error;
mod runs;
pub mod sweep;
pub mod tree_tuning;

pub use error::{Result, StudyError};
