//! Other engines on the same scenes: only collision detection, without forces, friction or contact memory.

#[cfg(feature = "mujoco")]
pub mod mujoco;
#[cfg(feature = "ode")]
pub mod ode;
mod ours;
#[cfg(feature = "parry")]
pub mod parry;
#[cfg(feature = "parry")]
pub mod parry_pairs;

#[cfg(any(feature = "mujoco", feature = "ode"))]
use crate::hull::Hull;
use crate::ours::Elements;
use crate::pairs::{Answer, Queries};
#[cfg(any(feature = "mujoco", feature = "ode"))]
use crate::pairs::{TARGET_ROUND, Target};
use pong_engine::State;
#[cfg(any(feature = "mujoco", feature = "ode"))]
use std::borrow::Cow;

/// An engine on a scene of bodies.
pub trait Peer {
    /// Runs one frame from the states of the bodies and returns the number of contacts.
    fn frame(&mut self, states: &[State]) -> usize;

    /// Depth of the deepest contact of the last frame, m; `None` if the engine does not report it.
    fn deepest(&self) -> Option<f64> {
        None
    }
}

/// An engine on one pair of primitives.
pub trait PairPeer {
    /// Answers all queries, from the two poses to the contact: the deepest one of each, if any.
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]);

    /// One pose, many primitives: elements of one body as A, with one relative pose for all. Returns `false`
    /// if the engine has no such query.
    fn pass_over_elements(&mut self, _elements: &Elements, _answers: &mut [Answer]) -> bool {
        false
    }

    /// Frame of the normals and points in answers.
    fn frame_of_answers(&self) -> AnswerFrame {
        AnswerFrame::Target
    }
}

/// Frame of the normals and points of an answer.
pub enum AnswerFrame {
    /// The target.
    Target,
    /// The target, turned by [`crate::pairs::along_y`].
    TargetAlongY,
    /// The common frame.
    Common,
}

/// The polyhedron of a target, or in place of a cone for engines without cones.
#[cfg(any(feature = "mujoco", feature = "ode"))]
fn hull_of(target: &Target) -> Option<Cow<'_, Hull>> {
    const SIDES: u32 = 64;
    match target {
        Target::Hull(hull) => Some(Cow::Borrowed(hull)),
        Target::Cone => Some(Cow::Owned(Hull::cone(TARGET_ROUND.0, TARGET_ROUND.1, SIDES))),
        _ => None,
    }
}

/// Position and quaternion (w, x, y, z) in the layout of engines in C.
#[cfg(any(feature = "mujoco", feature = "ode"))]
fn pose_numbers(state: &State) -> [f64; 7] {
    let ([x, y, z], [w, i, j, k]) = (state.position, state.orientation);
    [x, y, z, w, i, j, k]
}
