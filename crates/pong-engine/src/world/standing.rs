//! Movable groups whose pose stands still although their velocity is not zero.

use super::World;
use crate::error::EngineError;
use crate::ids::InterfaceId;
use pong_geometry::Pose;

/// Relative rounding of a coordinate or quaternion, with a margin; a smaller motion changes no pose.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl World {
    /// Movable groups in contact whose pose is bit-identical at the last two commits, although their velocity
    /// would have moved them within `step`, the time between the two commits, s. For use right after a commit
    /// of all pairs; empty otherwise.
    ///
    /// Bristle friction follows poses and is damped by velocities (docs/theory.md, 4). A host that keeps a
    /// pose and gives it a velocity, as for a conveyor belt, gets neither the friction of a moving body nor
    /// that of one at rest. It should move the pose, or the surface alone
    /// ([`set_surface_motions`](Self::set_surface_motions)), or choose `Coulomb` friction, which uses only
    /// velocities.
    ///
    /// A group that is committed twice at one pose, as in a pause, is listed too if its velocity is not zero.
    /// Allocates.
    ///
    /// # Errors
    /// [`EngineError::BadValue`] for a step that is not finite and above zero.
    pub fn standing_groups(&self, step: f64) -> Result<Vec<InterfaceId>, EngineError> {
        if !(step > 0.0 && step.is_finite()) {
            let cause = format!("it is {step} s; give the time from one commit to the next, s");
            return Err(EngineError::BadValue { what: "step".to_owned(), cause });
        }
        let Some((before, now)) = self.runtime.last_two_commits() else { return Ok(Vec::new()) };
        let frame = &self.runtime.frame;
        let group_pairs = self.runtime.memory.records.iter().map(|record| record.key.group_pair as usize);
        let pairs = group_pairs.map(|pair| &self.runtime.sealed.group_pairs[pair]);
        // After a continuation from another world, some pairs have no poses at the previous commit.
        let pairs = pairs.filter(|pair| before.knows(pair.pair));
        let mut touching: Vec<usize> = pairs.flat_map(|pair| [pair.first, pair.second]).collect();
        touching.sort_unstable();
        touching.dedup();
        let stands = |body: &usize| {
            let pose: &Pose = now.pose(0, *body);
            let twist = &frame.twists[*body];
            let moves = twist.linear.norm() * step > ROUNDING * pose.position.amax()
                || twist.angular.norm() * step > ROUNDING;
            moves && pose == before.pose(0, *body)
        };
        let stamp = self.scene.stamp;
        Ok(touching.into_iter().filter(stands).map(|body| InterfaceId::new(stamp, body)).collect())
    }
}
