//! Relative motion of pairs of movable groups.
//!
//! r = x_A − x_B and v = v_A − v_B are formed before anything is rotated, so that the results do not depend on
//! where the common origin is or how fast it moves (docs/theory.md, 1).

use super::WorkerInput;
use super::motion::{Motion, SinceCommit};
use crate::frame::near_pairs::NearPairs;
use crate::sealed::{Direction, Sealed};
use crate::state::CommittedPoses;
use pong_geometry::{Pose, Twist};
use std::borrow::Cow;

/// What the relative motion of any pair is computed from.
#[derive(Clone, Copy)]
pub(crate) struct Motions<'a> {
    pub sealed: &'a Sealed,
    /// Poses and twists of all movable groups.
    pub poses: &'a [Pose],
    pub twists: &'a [Twist],
    /// Their poses at the last commits.
    pub committed: &'a CommittedPoses,
}

impl Motions<'_> {
    /// Fills in the motions of some pairs, in the directions in which something can be found.
    pub fn relate(&self, pairs: &[u32], out: &mut Vec<[Motion; 2]>) {
        // What is of no use stays as it is: both directions may be written, and few are not. As a rule there are as many as in
        // the frame before, and nothing is made only to be thrown away.
        if out.len() < pairs.len() {
            out.resize(pairs.len(), [Motion::none(); 2]);
        }
        out.truncate(pairs.len());
        for (motions, &group_pair) in out.iter_mut().zip(pairs) {
            for (_, direction) in self.sealed.plans_of(group_pair) {
                motions[direction.flipped as usize] = self.of(direction);
            }
        }
    }

    /// The motion of A against B. In place where it is asked for: it is large to hand around.
    #[inline(always)]
    pub fn of(&self, direction: Direction) -> Motion {
        let (body_a, body_b) = self.sealed.bodies_of(direction);
        let pair = self.sealed.group_pairs[direction.group_pair as usize].pair;
        let (x_wa, x_wb) = (&self.poses[body_a], &self.poses[body_b]);
        let earlier = self.committed.relative(pair, body_a, body_b);
        let twists = (&self.twists[body_a], &self.twists[body_b]);
        motion(&Pose::relative(x_wa, x_wb), twists, x_wb, earlier.as_ref())
    }

    /// The motion of a direction in which a contact was found: as the frame has it, or computed again.
    pub fn known<'i>(
        &self,
        near: &NearPairs,
        input: &'i WorkerInput,
        direction: Direction,
    ) -> Cow<'i, Motion> {
        match near.slot(direction.group_pair) {
            Some(slot) => Cow::Borrowed(&input.motions[slot][direction.flipped as usize]),
            None => Cow::Owned(self.of(direction)),
        }
    }
}

#[inline(always)]
fn motion(pose_ba: &Pose, (v_a, v_b): (&Twist, &Twist), x_wb: &Pose, earlier: Option<&Pose>) -> Motion {
    let b_from_w = x_wb.orientation.inverse();
    Motion {
        x_ba: pose_ba.transform(),
        linear_b: b_from_w * (v_a.linear - v_b.linear),
        omega_a_b: b_from_w * v_a.angular,
        omega_b_b: b_from_w * v_b.angular,
        since_commit: earlier.map(|earlier| SinceCommit {
            x_ba: earlier.transform(),
            rotation: pose_ba.orientation * earlier.orientation.inverse(),
        }),
    }
}
