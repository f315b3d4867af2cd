//! Where physics itself jumps: the first hit of a plunger changes its surface, two faces are equally deep, a bristle breaks
//! away. There two tellings of one scene may differ, and only there.
//!
//! A jump shows by itself, without the twin: a small step away, on either side, the first scene gives answers that rounding
//! does not change, but different ones on the two sides, as different as what was found, and both answers found are among
//! them. An answer that only rounding decides is none of that: a step away it is the same all around (a seam), or does
//! not settle anywhere (a branch taken on noise).

use crate::allowance::{Allowance, distance};
use crate::base::Base;
use crate::random::Random;
use crate::twin::Twin;
use pong_engine::State;
use pong_geometry::{Pose, Vec3, Wrench};

/// How many places around are tried at a time, and how often more of them: where three surfaces meet, or a direction turns
/// through a wide angle, few places say little.
const PLACES: usize = 40;
const ROUNDS: usize = 6;
/// The longest step away, in sizes of the scene. What changes over more than this is no jump.
const LONGEST_STEP: f64 = 1e-6;
/// The shortest, where rounding still is far below.
const SHORTEST_STEP: f64 = 1e-12;

/// Whether the difference of a twin's frame is that of a jump of the first scene. `depth` is the least of a contact in either
/// answer, m.
pub fn is_there(
    base: &mut Base,
    twin: &Twin,
    (frame, depth): (usize, f64),
    read: &[Wrench; 2],
    allowance: &Allowance,
    random: &mut Random,
) -> bool {
    let lever = allowance.lever;
    let first = base.answers[frame].wrenches;
    let difference = distance(&first, read, lever);
    let size = base.scene.size;
    // So far that what changes smoothly stays well below the difference: depths change by the step.
    let smooth = 0.02 * difference / base.largest(frame).max(difference) * depth / size;
    let step = smooth.clamp(SHORTEST_STEP, LONGEST_STEP).max(100.0 * twin.rounding / size);
    let mut settled: Vec<[Wrench; 2]> = Vec::new();
    for round in 1..=ROUNDS {
        for _ in 0..PLACES {
            let mut frames = displaced(&base.scene.frames[..=frame], step, size, random.chance(0.5), random);
            let Some(there) = last(base, &frames) else { return false };
            let mut is_settled = true;
            for _ in 0..2 {
                frames = displaced(&frames, 4.0 * f64::EPSILON, size, false, random);
                let Some(again) = last(base, &frames) else { return false };
                is_settled &=
                    distance(&there, &again, lever) < (0.05 * difference).max(2.0 * allowance.force);
            }
            if is_settled {
                settled.push(there);
            }
        }
        if settled.len() < round * PLACES / 4 {
            return false;
        }
        let spread = settled.iter().map(|there| distance(there, &settled[0], lever)).fold(0.0, f64::max);
        let nearest = |answer: &[Wrench; 2]| {
            settled.iter().map(|there| distance(there, answer, lever)).fold(f64::INFINITY, f64::min)
        };
        let near = 0.25 * difference.max(spread) + allowance.force;
        if spread > 0.5 * difference && nearest(&first) < near && nearest(read) < near {
            return true;
        }
    }
    false
}

/// The wrenches of the last frame of a history.
fn last(base: &mut Base, frames: &[[State; 2]]) -> Option<[Wrench; 2]> {
    base.stage.play(frames).ok()?.pop().map(|answer| answer.wrenches)
}

/// The history with A beside its place by `step` sizes of the scene and turned as little: the same in all frames, or another
/// in each.
fn displaced(
    frames: &[[State; 2]],
    step: f64,
    size: f64,
    is_same: bool,
    random: &mut Random,
) -> Vec<[State; 2]> {
    let mut any = || (random.vector(step * size), random.vector(step));
    let same = any();
    let shifted = |state: &State, (shift, turn): (Vec3, Vec3)| {
        let pose = state.pose();
        let turn = nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(
            1.0,
            0.5 * turn.x,
            0.5 * turn.y,
            0.5 * turn.z,
        ));
        let pose = Pose { position: pose.position + shift, orientation: turn * pose.orientation };
        State::from_motion(&pose, &state.twist())
    };
    frames.iter().map(|[a, b]| [shifted(a, if is_same { same } else { any() }), *b]).collect()
}
