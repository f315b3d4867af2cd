//! The sealed world, which computes frames. Methods by file:
//!
//! | file | methods |
//! |---|---|
//! | `frame.rs` | states in; evaluate, commit, step |
//! | `changes.rs` | changes between frames: pairs on and off, surface values, contact history |
//! | `results.rs` | wrenches, contacts and reports of the last frame |
//! | `pair_wrench.rs` | wrench that one Object or movable group puts on another |
//! | `distance.rs` | distance of two movable groups |
//! | `energy.rs` | energies of the last commit |
//! | `contact_state.rs` | the contact state as a block of bytes |
//! | `tangent.rs`, `differences.rs` | derivatives of the wrenches of the last frame |
//! | `standing.rs` | poses that contradict velocities |
//! | `workers.rs` | workers, and the times of a frame |
//! | `clone.rs` | clones of a world |
//! | `continuation.rs` | continuation of a run in a world of more or fewer Objects |

mod changes;
mod clone;
mod contact_state;
mod continuation;
mod differences;
mod distance;
mod energy;
mod frame;
mod pair_wrench;
mod regressor;
mod results;
mod standing;
mod tangent;
mod workers;

pub use continuation::Continuation;
pub use distance::{GroupDistance, NearestPrimitive};
pub use regressor::SurfaceSlope;

use crate::inspect::Inspection;
use crate::runtime::Runtime;
use crate::scene::{Scene, States, Surfaces};
use std::sync::Arc;

/// A contact world made by [`WorldBuilder::seal`](crate::WorldBuilder::seal): it takes states, computes
/// frames, and remembers contacts from one commit to the next.
///
/// Frames neither allocate nor free memory. The world may be sent to another thread; one thread at a time may
/// call it.
pub struct World {
    /// Shared with the workers.
    scene: Arc<Scene>,
    surfaces: Surfaces,
    states: States,
    runtime: Runtime,
}

impl World {
    pub(crate) fn new(scene: Arc<Scene>, surfaces: Surfaces, states: States, runtime: Runtime) -> Self {
        Self { scene, surfaces, states, runtime }
    }

    /// The scene: models, Objects, pairs and laws, with their names and ids.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Hash of the sealed scene: two worlds with equal hashes can exchange contact state.
    pub fn scene_hash(&self) -> u64 {
        self.runtime.sealed.hash
    }

    /// Maximum contacts of a frame.
    pub fn contact_capacity(&self) -> usize {
        self.runtime.sealed.contact_capacity
    }

    /// Runtime, for unit tests.
    #[cfg(test)]
    pub(crate) fn runtime_mut(&mut self) -> &mut crate::runtime::Runtime {
        &mut self.runtime
    }

    /// View of the world for tools beside the engine.
    pub fn inspect(&self) -> Inspection<'_> {
        Inspection::new(&self.scene, &self.runtime)
    }
}
