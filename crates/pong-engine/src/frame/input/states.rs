//! Latches the states of the movable groups at the start of a frame. They were validated when they were set.

use crate::error::EngineError;
use crate::scene::{Scene, States};
use crate::seal::Sealed;
use pong_geometry::{Pose, Twist};

/// Returns an error if a movable group of an enabled pair has no state.
#[inline]
pub(crate) fn require_states(scene: &Scene, sealed: &Sealed, states: &States) -> Result<(), EngineError> {
    // Fast path: usually all groups have a state, and there may be many more pairs than groups.
    if sealed.paired_bodies.iter().all(|&body| states.bodies[body].is_some()) {
        return Ok(());
    }
    for pair in sealed.group_pairs.iter().filter(|pair| states.enabled[pair.pair]) {
        for body in [pair.first, pair.second] {
            if states.bodies[body].is_none() {
                return Err(EngineError::UnsetState { interface: scene.body_name(body) });
            }
        }
    }
    Ok(())
}

/// Copies the states into the poses and twists of the frame.
#[inline]
pub(crate) fn latch(sealed: &Sealed, states: &States, poses: &mut [Pose], twists: &mut [Twist]) {
    for &body in &*sealed.paired_bodies {
        if let Some(state) = &states.bodies[body] {
            poses[body] = states.poses[body];
            // Copied field by field, because copying the struct right after writing its fields would stall
            // (store forwarding).
            let twist = &mut twists[body];
            twist.linear.copy_from_slice(&state.linear_velocity);
            twist.angular.copy_from_slice(&state.angular_velocity);
        }
    }
}
