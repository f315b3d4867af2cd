//! Options of a replay.

use pong_engine::{Laws, WorkerSettings};
use pong_model::{Extensions, Model};
use std::sync::Arc;

/// Rewrites a model of the log, given its index; an error is a line of cause and cure.
type Rewrite<'a> = &'a dyn Fn(usize, Model) -> Result<Model, String>;

/// Returns a ready model for the one of the log with this index, if there is one.
type Instead<'a> = &'a dyn Fn(usize) -> Option<Arc<Model>>;

/// Options for rebuilding the world of a log and comparing its frames.
#[derive(Default)]
pub struct ReplayOptions<'a> {
    /// Workers of the world; the results are the same bits.
    pub workers: Option<WorkerSettings>,
    /// Largest difference of numbers, relative to the largest of their kind in the frame. `None` requires the
    /// same bits. With a tolerance a log that cannot be replayed exactly is replayed nevertheless. A rerun
    /// compares nothing.
    pub tolerance: Option<f64>,
    /// The force laws that the host of the log had registered.
    pub laws: Laws,
    /// The kinds of primitives that the host of the log had registered.
    pub extensions: Extensions,
    /// Function that rewrites every model, once it is loaded and checked against the log.
    pub rewrite: Option<Rewrite<'a>>,
    /// Source of ready models: where it has one for a model of the log, the log's file is not read.
    pub instead: Option<Instead<'a>>,
}
