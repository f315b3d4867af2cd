//! Relative motion of pairs of movable groups.
//!
//! r = x_A − x_B and v = v_A − v_B are formed before anything is rotated, so that the results do not depend on
//! where the common origin is or how fast it moves (docs/theory.md, 1).

use super::WorkerInput;
use super::motion::{Motion, PairMotions, SinceCommit};
use crate::frame::near_pairs::NearPairs;
use crate::seal::{Direction, Sealed};
use crate::state::CommittedPoses;
use pong_geometry::{Pose, Quat, Transform, Twist};
use std::borrow::Cow;

/// Pairs of movable groups that a frame visits, and the relative motion of any pair.
#[derive(Clone, Copy)]
pub(crate) struct Motions<'a> {
    pub sealed: &'a Sealed,
    /// Number of the frame.
    pub frame: u64,
    /// Pairs that the frame visits.
    pub near: &'a NearPairs,
    /// Poses and twists of all movable groups.
    pub poses: &'a [Pose],
    pub twists: &'a [Twist],
    /// Poses at the last commits.
    pub committed: &'a CommittedPoses,
}

impl Motions<'_> {
    /// Computes the motions of the given pairs, in the directions that have tests. An entry of `out` may still
    /// hold the pair's motion of the last committed frame. Its relative pose is then the pose at the last
    /// commit, and is not computed again.
    pub fn relate(&self, pairs: &[u32], out: &mut Vec<PairMotions>) {
        // Entries are reused: most frames have as many pairs as the frame before. Directions without tests
        // keep old values.
        if out.len() < pairs.len() {
            out.resize(pairs.len(), PairMotions::nobodys());
        }
        out.truncate(pairs.len());
        for (motions, &group_pair) in out.iter_mut().zip(pairs) {
            let is_known = motions.group_pair == group_pair && motions.frame == self.committed.frame();
            (motions.group_pair, motions.frame) = (group_pair, self.frame);
            for (_, direction) in self.sealed.plans_of(group_pair) {
                let motion = &mut motions.directions[direction.flipped as usize];
                let earlier =
                    if is_known { Some((motion.x_ba, motion.orientation)) } else { self.earlier(direction) };
                *motion = self.since(direction, earlier);
            }
        }
    }

    /// Motion of A relative to B now and since the last commit.
    pub fn of(&self, direction: Direction) -> Motion {
        self.since(direction, self.earlier(direction))
    }

    /// Pose of A relative to B at the last commit: the transform from A's group frame to B's, and its
    /// rotation. `None` without an earlier pose.
    #[inline(always)]
    fn earlier(&self, direction: Direction) -> Option<(Transform, Quat)> {
        let (body_a, body_b) = self.sealed.bodies_of(direction);
        let pair = self.sealed.group_pairs[direction.group_pair as usize].pair;
        self.committed.relative(pair, body_a, body_b).map(|pose| (pose.transform(), pose.orientation))
    }

    /// Motion of A relative to B now, and since `earlier`, the relative pose at the last commit.
    #[inline(always)]
    fn since(&self, direction: Direction, earlier: Option<(Transform, Quat)>) -> Motion {
        let (body_a, body_b) = self.sealed.bodies_of(direction);
        let (x_wa, x_wb) = (&self.poses[body_a], &self.poses[body_b]);
        let (v_a, v_b) = (&self.twists[body_a], &self.twists[body_b]);
        let pose_ba = Pose::relative(x_wa, x_wb);
        let b_from_w = x_wb.orientation.inverse();
        Motion {
            x_ba: pose_ba.transform(),
            orientation: pose_ba.orientation,
            linear_b: b_from_w * (v_a.linear - v_b.linear),
            omega_a_b: b_from_w * v_a.angular,
            omega_b_b: b_from_w * v_b.angular,
            since_commit: earlier.map(|(x_ba, orientation)| SinceCommit {
                x_ba,
                rotation: pose_ba.orientation * orientation.inverse(),
            }),
        }
    }

    /// Motion in a direction that has a contact: from the frame's input if it is stored there, otherwise
    /// recomputed.
    pub fn known<'i>(&self, input: &'i WorkerInput, direction: Direction) -> Cow<'i, Motion> {
        match self.near.slot(direction.group_pair) {
            Some(slot) => Cow::Borrowed(input.motions[slot].of(direction)),
            None => Cow::Owned(self.of(direction)),
        }
    }
}
