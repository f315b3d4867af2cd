//! States along a path of poses.

use pong_engine::State;
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Twist};

/// State at a frame of a path, with its twist by central differences.
pub fn state(path: impl Fn(f64) -> Pose, frame: f64, frame_seconds: f64) -> State {
    const STEP: f64 = 1e-3;
    let (before, now, after) = (path(frame - STEP), path(frame), path(frame + STEP));
    let seconds = 2.0 * STEP * frame_seconds;
    let twist = Twist {
        linear: (after.position - before.position) / seconds,
        angular: rotation_vector(&(after.orientation * before.orientation.inverse())) / seconds,
    };
    State::from_motion(&now, &twist)
}
