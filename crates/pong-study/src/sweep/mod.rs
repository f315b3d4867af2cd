//! Speed against accuracy, measured: a scene is run over the levers that buy speed, each run is compared with a reference
//! that is checked by itself, and the levels that are worth their time are named. What it means: `docs/trade.md`.
//!
//! | file | is |
//! |---|---|
//! | `level.rs`, `plan.rs` | one setting of every lever; which of them are run |
//! | `run.rs`, `record.rs`, `rewrite.rs` | one run: recorded, or timed; models as a level wants them |
//! | `subject.rs`, `open_loop.rs` | what is run: a scene, or the motions of a log |
//! | `errors.rs`, `reference.rs` | how far a run is from the reference; how far that may be off itself |
//! | `study.rs`, `store.rs` | all runs, in turn; what is kept of them |
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
