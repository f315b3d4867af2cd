//! States of movable groups, latched where a frame begins. They were checked when they were set.

use super::Frame;
use crate::error::EngineError;
use crate::scene::Scene;
use crate::sealed::Sealed;

/// Refuses a frame while a movable group of an enabled pair has no state.
pub(crate) fn require_states(scene: &Scene, sealed: &Sealed) -> Result<(), EngineError> {
    for pair in sealed.group_pairs.iter().filter(|pair| scene.pairs[pair.pair].enabled) {
        for body in [pair.first, pair.second] {
            if scene.bodies[body].state.is_none() {
                return Err(EngineError::UnsetState { interface: scene.body_name(body) });
            }
        }
    }
    Ok(())
}

/// Takes the states over into the frame.
pub(super) fn latch(scene: &Scene, frame: &mut Frame) {
    for (body, instance) in scene.bodies.iter().enumerate() {
        if let Some(state) = &instance.state {
            frame.poses[body] = state.pose();
            frame.twists[body] = state.twist();
        }
    }
}
