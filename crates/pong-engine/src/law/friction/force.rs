//! Input and output of friction laws, built in or added by the host.

use pong_geometry::Vec3;
use std::fmt::Debug;

/// Input of every friction law. Vectors are in the frame of B's movable group and lie in the current contact
/// plane.
#[derive(Clone, Copy, Debug)]
pub struct FrictionInput<'a> {
    /// Current normal force, N; positive.
    pub normal_force: f64,
    /// Unit normal of the contact, from B to A.
    pub normal_b: Vec3,
    /// Tangential displacement u of A relative to B since the last commit, m; in the step in which a contact
    /// begins, since first touch.
    pub slip_b: Vec3,
    /// Tangential velocity of A relative to B, m/s.
    pub slip_velocity_b: Vec3,
    /// Share h·w/Σw of the pair's bristle stiffness and damping that this contact has.
    pub share: f64,
    /// Bristle stiffness k_t of the whole pair, N/m.
    pub stiffness: f64,
    /// Bristle deflection rotated into the current contact plane, m; built-in bristle only.
    pub carried_b: Vec3,
    /// True if the contact stuck at the last commit (true for a new contact).
    pub stuck: bool,
    /// The law's parameters as the model gives them.
    pub parameters: &'a [f64],
}

/// Output of every friction law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionOutput {
    /// Force on A, N. A component along the normal is removed by the engine.
    pub force_b: Vec3,
    /// New bristle deflection, m; built-in bristle only.
    pub bristle_b: Vec3,
    /// True if the contact sticks.
    pub sticks: bool,
    /// Energy stored in the law's state, J.
    pub stored: f64,
}

/// A friction law added by the host. It must be pure: equal inputs and states give equal outputs, from any
/// thread, any number of times.
pub trait FrictionForce: Debug + Send + Sync {
    /// Number of state values per contact.
    fn state_len(&self) -> usize;

    /// Force from the current motion. `state` holds the committed values (zero for a new contact) and
    /// receives the new values, which are kept only if the host commits. Vectors in `state` are in the frame
    /// of B's movable group; the law itself has to rotate them into the current contact plane.
    fn evaluate(&self, input: &FrictionInput<'_>, state: &mut [f64]) -> FrictionOutput;
}

impl FrictionOutput {
    /// No friction.
    pub fn free() -> Self {
        Self { force_b: Vec3::zeros(), bristle_b: Vec3::zeros(), sticks: false, stored: 0.0 }
    }
}
