//! Runs with changed models: a scene or a log is run, its motions and answers are kept, the models are read
//! again with changed text, and the run is repeated with them.
//!
//! | file | is |
//! |---|---|
//! | `run.rs`, `motions.rs` | a scene or a log, run once, and its kept motions |
//! | `answer.rs`, `play.rs`, `counts.rs` | a frame's answer; kept motions played in the engine: compared, counted, timed |
//! | `subject.rs`, `output.rs` | a model file with changed text; the output of changed files |
//! | `samples.rs` | folders, models and scenes of tests |

pub(crate) mod answer;
pub(crate) mod counts;
pub(crate) mod motions;
pub(crate) mod output;
pub(crate) mod play;
pub(crate) mod run;
#[cfg(test)]
pub(crate) mod samples;
pub(crate) mod subject;

pub use counts::Counts;
pub use output::Output;
