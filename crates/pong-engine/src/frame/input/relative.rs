//! Relative motion of every pair of movable groups, in both directions.
//!
//! r = x_A − x_B and v = v_A − v_B are formed before anything is rotated, so that the results do not depend on
//! where the common origin is or how fast it moves (docs/theory.md, 1).

use super::EvaluationInput;
use super::motion::{Motion, SinceCommit};
use crate::frame::buffers::EvaluationBuffers;
use crate::state::PairPose;
use pong_geometry::{Pose, Twist};

/// Fills in the motions of the directions in which something can be found, and the relative poses that a commit would
/// remember. Of pairs that are off only if the ledger is kept: it asks for the motion of contacts that end.
pub(crate) fn relate(given: &EvaluationInput<'_>, frame: &mut EvaluationBuffers) {
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
        linear_b: b_from_w * (v_a.linear - v_b.linear),
        omega_a_b: b_from_w * v_a.angular,
        omega_b_b: b_from_w * v_b.angular,
        since_commit: earlier.map(|earlier| SinceCommit {
            x_ba: earlier.transform(),
            rotation: pose_ba.orientation * earlier.orientation.inverse(),
        }),
    }
}
