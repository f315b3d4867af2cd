//! Notes about deep contacts at the start of a run.

use super::Simulation;
use crate::stability::group_mass;
use pong_advise::{StoredEnergy, stored_energy};
use pong_engine::InterfaceId;
use pong_geometry::Vec3;

/// Smallest ratio of the net force on a body to its contact forces at which the body counts as not held.
const UNBALANCED: f64 = 0.5;

impl Simulation {
    /// Notes about bodies that start deep in each other: their contacts hold more energy than the motion
    /// between them has, and no force holds them together. Uses the present instant; empty before
    /// [`commit_initial_states`](Self::commit_initial_states).
    pub fn start_notes(&self) -> Vec<String> {
        let pairs = stored_energy(self.world()).unwrap_or_default();
        pairs.iter().filter_map(|pair| self.start_note(pair)).collect()
    }

    fn start_note(&self, pair: &StoredEnergy) -> Option<String> {
        let bodies = pair.groups.map(|group| {
            let of_group = |interface: InterfaceId| interface.index() == group;
            self.system.bodies.iter().position(|body| body.interface.is_some_and(of_group))
        });
        let [Some(first), Some(second)] = bodies else { return None };
        let inverse = |body: usize| 1.0 / group_mass(&self.system.bodies[body]).mass;
        let softness = inverse(first) + inverse(second);
        if softness == 0.0 || !(self.is_pushed(first) || self.is_pushed(second)) {
            return None;
        }
        let mass = 1.0 / softness;
        let of = bodies[pair.deepest.0]?;
        let place = self.system.motions[of].0.transform().point(&Vec3::from(pair.deepest.1));
        let velocity = |body: usize| {
            let (pose, twist) = &self.system.motions[body];
            twist.linear + twist.angular.cross(&(place - pose.position))
        };
        let motion = 0.5 * mass * (velocity(first) - velocity(second)).norm_squared();
        let [a, b] = &pair.names;
        (pair.energy > motion).then(|| {
            format!(
                "`{a}` and `{b}` start {:.3e} m deep in each other: their contacts hold {:.3e} J, beside {motion:.3e} J of motion \
                 between them, and can throw {mass:.3e} kg off at {:.3e} m/s",
                pair.depth,
                pair.energy,
                (2.0 * pair.energy / mass).sqrt(),
            )
        })
    }

    /// True if contact pushes a free body with more force than other forces balance.
    fn is_pushed(&self, body: usize) -> bool {
        let Some(slot) = self.system.free.iter().position(|(index, _)| *index == body) else { return false };
        let push = self.system.contact[body].force;
        let sum = push
            + self.system.applied_force(self.time(), body)
            + self.system.gravity * self.system.free[slot].1.mass;
        sum.norm() > UNBALANCED * push.norm()
    }
}
