//! Speed against accuracy, measured: a scene is run with the options that buy speed, each run is compared
//! with a reference whose own error is estimated, and the levels that are worth their time are named. See
//! `docs/trade.md`.
//!
//! | file | is |
//! |---|---|
//! | `level.rs`, `plan.rs` | one setting of every lever; the levels to run |
//! | `run.rs`, `record.rs`, `rewrite.rs` | one run, recorded or timed; models changed for a level |
//! | `subject.rs`, `open_loop.rs` | the subject: a scene, or the motions of a log |
//! | `errors.rs`, `reference.rs` | errors of a run against the reference; error of the reference itself |
//! | `study.rs`, `store.rs` | all runs, in turn; kept results |
//! | `choice.rs` | the Pareto front and the cheapest level within a tolerance |
//! | `report/` | tables and the plot |

pub mod choice;
mod errors;
mod hashes;
mod level;
mod open_loop;
mod plan;
mod record;
mod reference;
pub mod report;
mod rewrite;
mod run;
mod store;
mod study;
mod subject;

pub use errors::{Errors, Quantity};
pub use level::{Level, Lever, Motion, motion_name, seconds};
pub use open_loop::LogAlternative;
pub use plan::{Plan, PlanSettings};
pub use reference::{Check, Reference};
pub use run::Frames;
pub use study::{Answer, Place, Progress, Row, Settings, Study, Times, study, study_log};
