//! Writing logs: a recorder in the frame, and a thread of its own for the files.

mod capture;
mod commits;
mod describe;
mod folder;
mod message;
mod models;
mod options;
mod recorder;
mod tables;
mod thread;

pub(crate) use capture::{Capture, wrench_row};
pub(crate) use describe::describe;
pub use models::ModelSource;
pub use options::{LONGEST_WAIT, RecordOptions, WhenFull};
pub use recorder::{RecordStatus, Recorder};
