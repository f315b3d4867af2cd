//! How a log is replayed.

use pong_engine::{Laws, WorkerSettings};
use pong_geometry::extension::Extensions;

/// How a log is replayed.
#[derive(Default)]
pub struct ReplayOptions {
    /// Workers of the world; the results are the same bits.
    pub workers: Option<WorkerSettings>,
    /// How far numbers may be apart, relative to the largest of their kind in the frame. `None` for the same bits.
    /// With a tolerance a log that cannot be replayed exactly is replayed nevertheless.
    pub tolerance: Option<f64>,
    /// The force laws that the host of the log had registered.
    pub laws: Laws,
    /// The kinds of primitives that it knew.
    pub extensions: Extensions,
}
