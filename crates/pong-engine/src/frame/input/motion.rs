//! Relative motion of two movable groups.

use crate::seal::Direction;
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Quat, Transform, Vec3};

/// Motion of A's movable group relative to B's, in B's group frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// Transform from A's group frame to B's.
    pub x_ba: Transform,
    /// Rotation of `x_ba` as a quaternion.
    pub orientation: Quat,
    /// Relative velocity v_A − v_B of the two origins, m/s.
    pub linear_b: Vec3,
    /// Angular velocity of A, rad/s.
    pub omega_a_b: Vec3,
    /// Angular velocity of B, rad/s.
    pub omega_b_b: Vec3,
    /// Motion since the last commit; `None` without an earlier pose.
    pub since_commit: Option<SinceCommit>,
}

impl Motion {
    /// Placeholder without motion.
    fn none() -> Self {
        Self {
            x_ba: Transform::identity(),
            orientation: Quat::identity(),
            linear_b: Vec3::zeros(),
            omega_a_b: Vec3::zeros(),
            omega_b_b: Vec3::zeros(),
            since_commit: None,
        }
    }
}

/// Motions of a pair of movable groups, valid in the directions that have tests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairMotions {
    pub(super) group_pair: u32,
    /// Frame number of the motions.
    pub(super) frame: u64,
    pub(super) directions: [Motion; 2],
}

impl PairMotions {
    /// Placeholder that belongs to no pair.
    pub fn nobodys() -> Self {
        Self { group_pair: u32::MAX, frame: 0, directions: [Motion::none(); 2] }
    }

    /// Motion in one direction of the pair.
    #[inline]
    pub fn of(&self, direction: Direction) -> &Motion {
        &self.directions[direction.flipped as usize]
    }
}

/// Displacement since the last commit, seen from B's group frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SinceCommit {
    /// Transform from A's group frame to B's at the last commit.
    pub x_ba: Transform,
    /// Rotation of A since the last commit.
    pub rotation: Quat,
}

impl SinceCommit {
    /// Rotation vector φ of A since the last commit, rad. Expensive; only the friction of a continued contact
    /// and the ledger need it.
    pub fn rotation(&self) -> Vec3 {
        rotation_vector(&self.rotation)
    }
}

impl Motion {
    /// Velocity of the material point of A at the point `c` minus that of the material point of B there, in
    /// B's frame, m/s.
    pub fn velocity_at(&self, c: &Vec3) -> Vec3 {
        self.linear_b + self.omega_a_b.cross(&(c - self.x_ba.translation)) - self.omega_b_b.cross(c)
    }
}
