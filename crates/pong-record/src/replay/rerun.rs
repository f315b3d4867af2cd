//! Rerun of the recorded motions in a changed engine: other models, other laws, fewer frames.

use super::options::ReplayOptions;
use super::rebuild;
use super::replayed_world::Replay;
use super::report::Obstacle;
use crate::error::LogError;
use crate::read::{Frame, Log};
use pong_engine::{InterfaceId, World};

/// A frame of a rerun.
pub struct RerunFrame<'a> {
    /// Index in the log, from 0.
    pub index: u64,
    /// The frame as recorded.
    pub logged: &'a Frame,
    /// The world: its wrenches are those of this frame, or of the last frame that the engine evaluated.
    pub world: &'a World,
    /// The movable groups, in the order of the log's columns.
    pub bodies: &'a [InterfaceId],
    /// Time from setting the states to the end of the commit, ns; 0 for frames that were skipped.
    pub took_ns: u64,
}

/// Rebuilds the world of a log with the changes of `options`: sealed, without states or contact history.
///
/// # Errors
/// A world that cannot be built: a model that was changed, a law of the host's.
pub fn world_of_log(log: &Log, options: ReplayOptions<'_>) -> Result<World, LogError> {
    Ok(rebuild::world(log, &of_any_hash(options))?.0)
}

/// Runs the recorded motions of a log, open loop, through an engine with the changes of `options`. Calls back
/// with every frame, of at most the given number. The engine evaluates only each `every`-th, beginning with
/// the first; 0 counts as 1.
///
/// A surface event with friction is applied without the friction where the model has none now.
///
/// # Errors
/// A log that cannot be read, or whose world cannot be built; a contact state that was restored in the log
/// and does not fit the changes; errors of the callback.
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

/// World of a log as it is at a frame, given its index: the frame is committed as in the log, and evaluated again, so that
/// its bristles are there. The obstacle is the first reason why the contact state may differ from that of the run.
///
/// # Errors
/// A log that cannot be read, or whose world cannot be built; [`LogError::Refused`] for a frame that does not exist.
pub fn world_at(
    log: &mut Log,
    options: ReplayOptions<'_>,
    index: u64,
) -> Result<(World, Option<Obstacle>), LogError> {
    if index >= log.frame_count() {
        let cause = format!("there is no frame {index}: the log has {}", log.frame_count());
        return Err(LogError::refused(cause, "choose one of its frames"));
    }
    let mut replay = Replay::new(log, &of_any_hash(options))?;
    let (mut frame, mut obstacle) = (Frame::default(), None);
    for index in 0..=index {
        log.read(index, &mut frame)?;
        let here = replay.obstacle(&frame.row);
        obstacle = obstacle.or(here);
        replay.run(log, &frame)?;
        replay.accept(&frame.row)?;
    }
    replay.world.evaluate()?;
    Ok((replay.world, obstacle))
}

/// With a tolerance the hash of the world may differ from that of the log.
fn of_any_hash(options: ReplayOptions<'_>) -> ReplayOptions<'_> {
    ReplayOptions { tolerance: Some(0.0), ..options }
}
