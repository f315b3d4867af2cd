//! Response logs: the states, wrenches and contacts of a run, frame by frame, with all data needed to replay
//! it.
//!
//! The format is described in `docs/response_logs.md`.
//!
//! | file | is |
//! |---|---|
//! | `run.rs`, `event.rs` | run.json and events.jsonl |
//! | `table/` | the rows of the NumPy tables, and tables as they are read |
//! | `write/` | [`Recorder`] on the frame's path, and the thread that writes the files |
//! | `read/` | [`Log`]: whole frames by number |
//! | `csv/` | the same rows as text; energy accounts |
//! | `replay/` | replay of a log in the engine |

#![forbid(unsafe_code)]

mod csv;
mod error;
mod event;
mod format;
mod read;
mod replay;
mod run;
pub mod table;
mod write;

pub use csv::{AccountsTable, CsvTables, Look, csv_name};
pub use error::LogError;
pub use event::{Event, LoggedEvent, SurfaceValues};
pub use format::VERSION;
pub use read::{Frame, Log};
pub use replay::{
    Difference, Obstacle, ReplayOptions, ReplayReport, RerunFrame, replay, rerun, world_at, world_of_log,
    write_tangents,
};
pub use run::{Run, RunAccounts, RunBody, RunModel, RunObject, RunPrimitive, RunTable};
pub use table::{ContactRow, EnergyRow, FrameRow, StateRow, TangentRow, WrenchRow};
pub use write::{LONGEST_WAIT, ModelSource, RecordOptions, RecordStatus, Recorder, WhenFull};
