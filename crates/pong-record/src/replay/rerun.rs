//! The recorded motions go through an engine that is not quite the log's: other models, other laws, fewer frames.

use super::options::ReplayOptions;
use super::rebuild;
use super::replayed_world::Replay;
use crate::error::LogError;
use crate::read::{Frame, Log};
use pong_engine::{InterfaceId, World};

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
pub fn world_of_log(log: &Log, options: ReplayOptions<'_>) -> Result<World, LogError> {
    Ok(rebuild::world(log, &of_any_hash(options))?.0)
}

/// Runs a log through the engine with something else than it says, open loop: the motions stay those of the log. Calls
/// back with every frame, of which there are at most so many. Only each `every`-th, beginning with the first, is handed to
/// the engine; 0 counts as 1.
///
/// An event that gives a surface friction is obeyed without it where the model has none now.
///
/// # Errors
/// A log that cannot be read, or whose world cannot be built; a contact state that was restored in the log and does not fit
/// what differs; what the callback returns.
pub fn rerun<E: From<LogError>>(
    log: &mut Log,
    options: ReplayOptions<'_>,
    (frames, every): (u64, u64),
    each: &mut dyn FnMut(&RerunFrame<'_>) -> Result<(), E>,
) -> Result<(), E> {
    let mut replay = Replay::new(log, &of_any_hash(options))?;
    let mut frame = Frame::default();
    for index in 0..log.frame_count().min(frames) {
        log.read(index, &mut frame)?;
        let mut took_ns = 0;
        if index.is_multiple_of(every.max(1)) {
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
fn of_any_hash(options: ReplayOptions<'_>) -> ReplayOptions<'_> {
    ReplayOptions { tolerance: Some(0.0), ..options }
}
