//! Contacts of a body of a scene at poses that were measured.

use crate::error::Result;
use pong_executive::{BodyId, Motion, Pose, RigidBody, Simulation, Twist, Vec3};

/// A body that is put at poses, while the others stay where the scene has them.
pub(crate) struct Probe<'a> {
    simulation: &'a mut Simulation,
    body: BodyId,
}

impl<'a> Probe<'a> {
    pub fn new(simulation: &'a mut Simulation, body: BodyId) -> Self {
        Self { simulation, body }
    }

    /// Tests whether no other body moves, so that the scene has the place of each at any time.
    pub fn others_are_fixed(&self) -> bool {
        let fixed = |body: &RigidBody| matches!(body.motion, Motion::Fixed);
        self.simulation.bodies().all(|(id, body)| id == self.body || fixed(body))
    }

    /// Contact points in the frame of the body, and depths (m), of a pose.
    pub fn contacts(&mut self, pose: Pose) -> Result<Vec<(Vec3, f64)>> {
        self.simulation.clear_contact_history()?;
        self.simulation.set_motion(self.body, pose, Twist::zero())?;
        self.simulation.commit_initial_states()?;
        let interface = self.simulation.bodies().nth(self.body.index()).and_then(|(_, body)| body.interface);
        let to_body = pose.inverse();
        let contacts = self.simulation.world().contacts_iter();
        let own = contacts.filter(|one| [one.a.interface, one.b.interface].map(Some).contains(&interface));
        Ok(own.map(|one| (to_body.orientation * one.point + to_body.position, one.depth)).collect())
    }
}
