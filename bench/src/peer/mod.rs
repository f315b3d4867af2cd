//! Other engines on the same scenes: collision detection alone, without forces, friction or memory of contacts.

#[cfg(feature = "mujoco")]
pub mod mujoco;
#[cfg(feature = "ode")]
pub mod ode;
pub mod parry;
pub mod parry_pairs;

use crate::pairs::{Answer, Queries};
use pong_engine::State;

/// An engine on a scene of bodies.
pub trait Peer {
    /// One frame from the states of the bodies; how many contacts it found.
    fn frame(&mut self, states: &[State]) -> usize;
}

/// An engine on one pair of primitives.
pub trait PairPeer {
    /// Answers all queries: for each the deepest contact, if there is one.
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]);
}

/// Position and quaternion (w, x, y, z), as engines in C take them.
#[cfg(any(feature = "mujoco", feature = "ode"))]
fn pose_numbers(state: &State) -> [f64; 7] {
    let ([x, y, z], [w, i, j, k]) = (state.position, state.orientation);
    [x, y, z, w, i, j, k]
}
