//! Relative motion of every pair of movable groups, in both directions.
//!
//! r = x_A − x_B and v = v_A − v_B are formed before anything is rotated, so that the results do not depend on
//! where the common origin is or how fast it moves (docs/theory.md, 1).

use crate::frame::{Frame, Given};
use crate::state::PairPose;
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Quat, Transform, Twist, Vec3};

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
    /// A's rotation since then.
    turn: Quat,
}

impl SinceCommit {
    /// φ: rotation vector of A's rotation since the last commit, rad. Costs more than all else here, and only
    /// friction of a contact that lasts and the ledger ask for it.
    pub fn turn(&self) -> Vec3 {
        rotation_vector(&self.turn)
    }
}

impl Motion {
    /// Velocity of A's material point at `c` less that of B's, m/s.
    pub fn velocity_at(&self, c: &Vec3) -> Vec3 {
        self.linear + self.omega_a.cross(&(c - self.x_ba.translation)) - self.omega_b.cross(c)
    }
}

/// Fills in the motions of the directions in which something can be found, and the relative poses that a commit would
/// remember. Of pairs that are off only if the ledger is kept: it asks for the motion of contacts that end.
pub(crate) fn relate(given: &Given<'_>, frame: &mut Frame) {
    let (sealed, memory, enabled) = (given.sealed, given.memory, &given.states.enabled);
    let ledger = given.scene.config.ledger;
    for (index, pair) in sealed.group_pairs.iter().enumerate() {
        frame.remembered[index] = PairPose::unknown();
        if enabled[pair.pair] || ledger {
            let (first, second) = (&frame.poses[pair.first], &frame.poses[pair.second]);
            let relative = [Pose::relative(first, second), Pose::relative(second, first)];
            frame.remembered[index] = PairPose { known: enabled[pair.pair], relative };
        }
    }
    for plan in &sealed.plans {
        let (index, flipped) = (plan.group_pair as usize, plan.flipped as usize);
        if enabled[sealed.group_pairs[index].pair] || ledger {
            let pose = &frame.remembered[index].relative[flipped];
            let committed = &memory.poses[index];
            let earlier = committed.known.then(|| &committed.relative[flipped]);
            let twists = (&frame.twists[plan.body_a], &frame.twists[plan.body_b]);
            frame.input.motions[index][flipped] = motion(pose, twists, &frame.poses[plan.body_b], earlier);
        }
    }
    if ledger {
        let off = sealed.group_pairs.iter().enumerate().filter(|(_, pair)| !enabled[pair.pair]);
        off.for_each(|(index, _)| frame.remembered[index] = PairPose::unknown());
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
            turn: pose_ba.orientation * earlier.orientation.inverse(),
        }),
    }
}
