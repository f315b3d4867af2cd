//! The recorded motions go through an engine that is not quite the log's: other models, other laws, fewer frames.

use super::options::ReplayOptions;
use super::rebuild;
use super::replayed_world::Replay;
use crate::error::LogError;
use crate::read::{Frame, Log};
use pong_engine::{InterfaceId, Laws, WorkerSettings, World};
use pong_geometry::extension::Extensions;
use pong_model::Model;
use std::sync::Arc;

/// What becomes of a model of the log, by its index; an error is a line of cause and cure.
type Rewrite<'a> = &'a dyn Fn(usize, Model) -> Result<Model, String>;

/// A model that is at hand for one of the log, by its index.
type Instead<'a> = &'a dyn Fn(usize) -> Option<Arc<Model>>;

/// What is to differ from the log.
#[derive(Default)]
pub struct RerunOptions<'a> {
    /// Workers of the world; the results are the same bits.
    pub workers: Option<WorkerSettings>,
    /// Every model, once loaded and checked against the log, is replaced by what this makes of it.
    pub rewrite: Option<Rewrite<'a>>,
    /// Where this has a model for one of the log, that is taken as it is, and the log's is not read.
    pub instead: Option<Instead<'a>>,
    /// Only every so many frames, beginning with the first, are handed to the engine; 0 counts as 1.
    pub every: u64,
    /// The force laws that the host of the log had registered.
    pub laws: Laws,
    /// The kinds of primitives that it knew.
    pub extensions: Extensions,
}

/// A frame of a rerun.
pub struct RerunFrame<'a> {
    /// Number among the log's frames, from 0.
    pub index: u64,
    /// What the log has of it.
    pub logged: &'a Frame,
    /// The world: wrenches are those of this frame, or of the last one that was handed to the engine.
    pub world: &'a World,
    /// The movable groups, in the order of the log's columns.
    pub bodies: &'a [InterfaceId],
    /// Time from handing in the states to the end of the commit, ns; 0 for frames that were passed over.
    pub took_ns: u64,
}

/// The world of a log, built again with something else than the log says: sealed, and nothing is set or remembered yet.
///
/// # Errors
/// A world that cannot be built: a model that was changed, a law of the host's.
pub fn world_of_log(log: &Log, options: RerunOptions<'_>) -> Result<World, LogError> {
    let other = rebuild::Models { rewrite: options.rewrite, instead: options.instead };
    Ok(rebuild::world(log, &replay_options(options), &other)?.0)
}

/// Runs a log through the engine with something else than it says, open loop: the motions stay those of the log. Calls
/// back with every frame, of which there are at most so many.
///
/// An event that gives a surface friction is obeyed without it where the model has none now.
///
/// # Errors
/// A log that cannot be read, or whose world cannot be built; a contact state that was restored in the log and does not fit
/// what differs; what the callback returns.
pub fn rerun<E: From<LogError>>(
    log: &mut Log,
    options: RerunOptions<'_>,
    frames: u64,
    each: &mut dyn FnMut(&RerunFrame<'_>) -> Result<(), E>,
) -> Result<(), E> {
    let every = options.every.max(1);
    let other = rebuild::Models { rewrite: options.rewrite, instead: options.instead };
    let replay = replay_options(options);
    let (world, models) = rebuild::world(log, &replay, &other)?;
    let mut replay = Replay::of_world(log, &replay, world, models)?;
    let mut frame = Frame::default();
    for index in 0..log.frame_count().min(frames) {
        log.read(index, &mut frame)?;
        let mut took_ns = 0;
        if index.is_multiple_of(every) {
            let begin = std::time::Instant::now();
            replay.run(log, &frame)?;
            replay.accept(&frame.row)?;
            took_ns = begin.elapsed().as_nanos() as u64;
        }
        let (world, bodies) = (&replay.world, &replay.bodies[..]);
        each(&RerunFrame { index, logged: &frame, world, bodies, took_ns })?;
    }
    Ok(())
}

/// With a tolerance the hash of the world need not be that of the log.
fn replay_options(options: RerunOptions<'_>) -> ReplayOptions {
    ReplayOptions {
        workers: options.workers,
        tolerance: Some(0.0),
        laws: options.laws,
        extensions: options.extensions,
    }
}
