//! Replay of a log in the engine, with comparison of the results.

mod compare;
mod options;
mod rebuild;
mod replayed_world;
mod report;
mod rerun;
mod tangents;

pub use compare::Difference;
pub use options::ReplayOptions;
pub use report::{Obstacle, ReplayReport};
pub use rerun::{RerunFrame, rerun, world_at, world_of_log};
pub use tangents::write_tangents;

use crate::error::LogError;
use crate::read::{Frame, Log};
use replayed_world::Replay;
use std::ops::ControlFlow;

/// Replays a log, and stops at the first frame that differs. `progress` is called with the number of frames
/// done, and may end the replay.
///
/// # Errors
/// A log that cannot be read, or whose world cannot be rebuilt: a model that was changed, a law of the
/// host's.
pub fn replay(
    log: &mut Log,
    options: &ReplayOptions<'_>,
    progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<ReplayReport, LogError> {
    let mut replay = Replay::new(log, options)?;
    let mut report = ReplayReport { frames: log.frame_count(), ..ReplayReport::default() };
    let mut frame = Frame::default();
    for index in 0..report.frames {
        log.read(index, &mut frame)?;
        let obstacle = replay.obstacle(&frame.row);
        report.obstacle = report.obstacle.or(obstacle);
        if report.obstacle.is_some() && options.tolerance.is_none() {
            break;
        }
        replay.run(log, &frame)?;
        report.compared += 1;
        report.contacts += frame.contacts.len() as u64;
        report.differences = replay.comparison.differences(log.run(), &replay.world, &frame)?;
        if !report.differences.is_empty() {
            break;
        }
        replay.accept(&frame.row)?;
        if progress(index + 1).is_break() {
            break;
        }
    }
    Ok(report)
}
