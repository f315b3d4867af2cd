//! How a log is replayed.

use pong_engine::{Laws, WorkerSettings};
use pong_geometry::extension::Extensions;
use pong_model::Model;
use std::sync::Arc;

/// What becomes of a model of the log, by its index; an error is a line of cause and cure.
type Rewrite<'a> = &'a dyn Fn(usize, Model) -> Result<Model, String>;

/// A model that is at hand for one of the log, by its index.
type Instead<'a> = &'a dyn Fn(usize) -> Option<Arc<Model>>;

/// How the world of a log is built again, and how its frames are compared.
#[derive(Default)]
pub struct ReplayOptions<'a> {
    /// Workers of the world; the results are the same bits.
    pub workers: Option<WorkerSettings>,
    /// How far numbers may be apart, relative to the largest of their kind in the frame. `None` for the same bits.
    /// With a tolerance a log that cannot be replayed exactly is replayed nevertheless. A rerun compares nothing.
    pub tolerance: Option<f64>,
    /// The force laws that the host of the log had registered.
    pub laws: Laws,
    /// The kinds of primitives that it knew.
    pub extensions: Extensions,
    /// Every model, once loaded and checked against the log, is replaced by what this makes of it.
    pub rewrite: Option<Rewrite<'a>>,
    /// Where this has a model for one of the log, that is taken as it is, and the log's is not read.
    pub instead: Option<Instead<'a>>,
}
