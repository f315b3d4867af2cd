//! What friction laws are given and answer, built in or added by a user.

use pong_geometry::Vec3;
use std::fmt::Debug;

/// What every friction law is given. Vectors are expressed in the frame of B's movable group and lie in the
/// present contact plane.
#[derive(Clone, Copy, Debug)]
pub struct FrictionInput<'a> {
    /// Present normal force, N; positive.
    pub normal_force: f64,
    /// Unit normal of the contact, from B to A.
    pub normal_b: Vec3,
    /// Tangential displacement u of A against B since the last commit, m; in the step a contact is born, since the touch.
    pub slip_b: Vec3,
    /// Tangential velocity of A against B, m/s.
    pub slip_velocity_b: Vec3,
    /// The part of the pair's bristle stiffness and damping that this contact carries: h·w/Σw.
    pub share: f64,
    /// Bristle stiffness k_t of the whole pair, N/m.
    pub stiffness: f64,
    /// Bristle displacement carried into the present contact plane, m; built-in bristle only.
    pub carried_b: Vec3,
    /// Whether the contact stuck at the last commit (true when new).
    pub stuck: bool,
    /// The law's parameters as the model gives them.
    pub parameters: &'a [f64],
}

/// What every friction law answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionOutput {
    /// Force on A, N. A component along the normal is removed by the engine.
    pub force_b: Vec3,
    /// New bristle displacement, m; built-in bristle only.
    pub bristle_b: Vec3,
    /// Whether the contact sticks.
    pub sticks: bool,
    /// Energy stored in the law's state, J.
    pub stored: f64,
}

/// A friction law added by the user. It must be pure: the same input and state give the same output, from any
/// thread, any number of times.
pub trait FrictionForce: Debug + Send + Sync {
    /// How many numbers the law remembers per contact.
    fn state_len(&self) -> usize;

    /// Force from the present motion. `state` holds the committed numbers (zero for a new contact) and takes the
    /// new ones, which count only if the host commits. Vectors in it must be carried by the law itself; they are
    /// in the frame of B's movable group.
    fn evaluate(&self, input: &FrictionInput<'_>, state: &mut [f64]) -> FrictionOutput;
}

impl FrictionOutput {
    /// No friction.
    pub fn free() -> Self {
        Self { force_b: Vec3::zeros(), bristle_b: Vec3::zeros(), sticks: false, stored: 0.0 }
    }
}
