//! Bounding volumes and leaves that lower the frame time of a run, for the same bits: the models of a scene or of a log are
//! given other kinds of volumes, fewer of them, smaller or larger leaves; every proposal must answer as before, bit for
//! bit, and what is faster by more than noise is written as a new model file. What it means: `docs/tune.md`.
//!
//! A sweep (`sweep`) asks what each lever costs in accuracy; here no answer may change, and what is looked for is a model.
//!
//! | file | is |
//! |---|---|
//! | `subject.rs`, `moves.rs` | a model's groups, what they may be given; what may be changed in one step |
//! | `run.rs`, `motions.rs` | a scene or a log, run once; its motions, kept |
//! | `answer.rs`, `play.rs`, `counts.rs` | a frame's answer; kept motions through the engine: compared, counted, timed |
//! | `bench.rs`, `search.rs` | proposals measured in turn; which are tried, which are taken |
//! | `tune.rs`, `write.rs` | all of it; model files |
//! | `report.rs`, `words.rs` | the page; changes in words |

mod answer;
mod bench;
mod counts;
mod motions;
mod moves;
mod play;
pub mod report;
mod run;
mod search;
mod subject;
mod tune;
mod words;
mod write;

#[cfg(test)]
mod tests;

pub use counts::Counts;
pub use tune::{ModelTuned, Progress, RunTuned, Settings, Tuned, tune};
pub use write::Output;
