//! Relative motion of every pair of movable groups, in both directions.
//!
//! r = x_A − x_B and v = v_A − v_B are formed before anything is rotated, so that the results do not depend on
//! where the common origin is or how fast it moves (physics contract, section 1).

use super::Frame;
use crate::sealed::Sealed;
use crate::state::{ContactMemory, PairPose};
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Transform, Twist, Vec3};

/// Motion of A's movable group against B's, seen from and expressed in B's group frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// From A's group frame to B's.
    pub x_ba: Transform,
    /// v_A − v_B of the two origins, m/s.
    pub linear: Vec3,
    /// Angular velocity of A, rad/s.
    pub omega_a: Vec3,
    /// Angular velocity of B, rad/s.
    pub omega_b: Vec3,
    /// What happened since the last commit; `None` if there is no earlier pose.
    pub since_commit: Option<SinceCommit>,
}

impl Motion {
    /// No motion at all.
    pub fn none() -> Self {
        Self {
            x_ba: Transform::identity(),
            linear: Vec3::zeros(),
            omega_a: Vec3::zeros(),
            omega_b: Vec3::zeros(),
            since_commit: None,
        }
    }
}

/// Displacement since the last commit, seen from B's group frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SinceCommit {
    /// From A's group frame to B's at the last commit.
    pub x_ba: Transform,
    /// φ: rotation vector of A's rotation since then, rad.
    pub turn: Vec3,
}

impl Motion {
    /// Velocity of A's material point at `c` less that of B's, m/s.
    pub fn velocity_at(&self, c: &Vec3) -> Vec3 {
        self.linear + self.omega_a.cross(&(c - self.x_ba.translation)) - self.omega_b.cross(c)
    }
}

/// Fills in the motions, and the relative poses that a commit would remember.
pub(super) fn relate(sealed: &Sealed, enabled: &[bool], memory: &ContactMemory, frame: &mut Frame) {
    for (index, pair) in sealed.group_pairs.iter().enumerate() {
        let bodies = [pair.first, pair.second];
        let known = enabled[pair.pair];
        let mut remembered = PairPose { known, ..PairPose::unknown() };
        let committed = &memory.poses[index];
        let motions = [0, 1].map(|flipped| {
            let (a, b) = (bodies[flipped], bodies[1 - flipped]);
            let pose = Pose::relative(&frame.poses[a], &frame.poses[b]);
            remembered.relative[flipped] = pose;
            let earlier = committed.known.then(|| &committed.relative[flipped]);
            motion(&pose, (&frame.twists[a], &frame.twists[b]), &frame.poses[b], earlier)
        });
        frame.input.motions[index] = motions;
        frame.remembered[index] = if known { remembered } else { PairPose::unknown() };
    }
}

fn motion(pose_ba: &Pose, (v_a, v_b): (&Twist, &Twist), x_wb: &Pose, earlier: Option<&Pose>) -> Motion {
    let b_from_w = x_wb.orientation.inverse();
    Motion {
        x_ba: pose_ba.transform(),
        linear: b_from_w * (v_a.linear - v_b.linear),
        omega_a: b_from_w * v_a.angular,
        omega_b: b_from_w * v_b.angular,
        since_commit: earlier.map(|earlier| SinceCommit {
            x_ba: earlier.transform(),
            turn: rotation_vector(&(pose_ba.orientation * earlier.orientation.inverse())),
        }),
    }
}
