//! Motion of one movable group against another.

use crate::sealed::Direction;
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Quat, Transform, Vec3};

/// Motion of A's movable group against B's, seen from and expressed in B's group frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// From A's group frame to B's.
    pub x_ba: Transform,
    /// The same rotation.
    pub orientation: Quat,
    /// v_A − v_B of the two origins, m/s.
    pub linear_b: Vec3,
    /// Angular velocity of A, rad/s.
    pub omega_a_b: Vec3,
    /// Angular velocity of B, rad/s.
    pub omega_b_b: Vec3,
    /// What happened since the last commit; `None` if there is no earlier pose.
    pub since_commit: Option<SinceCommit>,
}

impl Motion {
    /// No motion at all.
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

/// The motions of a pair of movable groups, in those of its two directions in which something can be found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairMotions {
    pub(super) group_pair: u32,
    /// Number of the frame that they are of.
    pub(super) frame: u64,
    pub(super) directions: [Motion; 2],
}

impl PairMotions {
    /// Of no pair.
    pub fn nobodys() -> Self {
        Self { group_pair: u32::MAX, frame: 0, directions: [Motion::none(); 2] }
    }

    /// The motion in a direction of the pair.
    #[inline]
    pub fn of(&self, direction: Direction) -> &Motion {
        &self.directions[direction.flipped as usize]
    }
}

/// Displacement since the last commit, seen from B's group frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SinceCommit {
    /// From A's group frame to B's at the last commit.
    pub x_ba: Transform,
    /// A's rotation since then.
    pub rotation: Quat,
}

impl SinceCommit {
    /// φ: rotation vector of A's rotation since the last commit, rad. Costs more than all else here, and only
    /// friction of a contact that lasts and the ledger ask for it.
    pub fn rotation(&self) -> Vec3 {
        rotation_vector(&self.rotation)
    }
}

impl Motion {
    /// Velocity of A's material point at `c` less that of B's, m/s.
    pub fn velocity_at(&self, c: &Vec3) -> Vec3 {
        self.linear_b + self.omega_a_b.cross(&(c - self.x_ba.translation)) - self.omega_b_b.cross(c)
    }
}
