//! The sealed world: what computes frames. The files follow its methods:
//!
//! | file | methods |
//! |---|---|
//! | `frame.rs` | states in; evaluate, commit, step |
//! | `changes.rs` | what may change between frames: pairs on and off, values of surfaces, the contacts' past |
//! | `results.rs` | wrenches, contacts and reports of the last frame |
//! | `energy.rs` | energies of the last commit |
//! | `contact_state.rs` | the contact state as a block of bytes |
//! | `standing.rs` | poses that contradict velocities |
//! | `workers.rs` | workers, and the times of a frame |
//! | `clone.rs` | another world of the same sealed scene |

mod changes;
mod clone;
mod contact_state;
mod energy;
mod frame;
mod results;
mod standing;
mod workers;

use crate::inspect::Inspection;
use crate::runtime::Runtime;
use crate::scene::{Scene, States, Surfaces};
use std::sync::Arc;

/// A contact world that [`WorldBuilder::seal`](crate::WorldBuilder::seal) made: it takes states, computes frames, and
/// remembers contacts from one commit to the next.
///
/// A frame takes no memory and gives none back. The world may be sent to another thread; one thread at a time calls it.
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

    /// What was set up: models, Objects, pairs and laws, with their names and ids.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Hash of the sealed scene: two worlds with equal hashes can exchange contact state.
    pub fn scene_hash(&self) -> u64 {
        self.runtime.sealed.hash
    }

    /// Most contacts of a frame.
    pub fn contact_capacity(&self) -> usize {
        self.runtime.sealed.contact_capacity
    }

    /// What the tests of single parts look into.
    #[cfg(test)]
    pub(crate) fn runtime_mut(&mut self) -> &mut crate::runtime::Runtime {
        &mut self.runtime
    }

    /// What a tool beside the engine reads of the world.
    pub fn inspect(&self) -> Inspection<'_> {
        Inspection::new(&self.scene, &self.runtime)
    }
}
