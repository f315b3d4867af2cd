//! Comparison of two answers.

use crate::allowance::{Allowance, distance, of_directions, thinnest};
use crate::base::Base;
use crate::jump;
use crate::play::Answer;
use crate::random::Random;
use crate::scene::{Friction, Scene};
use crate::twin::Twin;
use pong_geometry::Vec3;

/// Result of one comparison.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// The answers agree.
    Agrees,
    /// The scene has no such twin, or the check does not cover it.
    DoesNotApply,
    /// The answers differ, and those of the first scene itself differ on both sides of a point within
    /// rounding.
    AtAJump(Finding),
    /// The answers differ.
    Differs(Finding),
}

/// A disagreement.
#[derive(Clone, Debug)]
pub struct Finding {
    /// First frame that differs.
    pub frame: usize,
    /// Difference relative to the largest term.
    pub relative: f64,
    /// Description of the difference.
    pub says: String,
    /// True if the loader or the engine refused the twin.
    pub is_refusal: bool,
    /// The twin's scene, if its models or states differ.
    pub twin: Option<Scene>,
}

impl Verdict {
    /// A violated property of one scene.
    pub fn differs(frame: usize, relative: f64, says: String) -> Self {
        Self::Differs(Finding { frame, relative, says, is_refusal: false, twin: None })
    }
}

/// Force uncertainty of directions: between the normals of a fold, and of round parts. Normal force and friction turn with the normal, and damping acts on
/// another component of the velocity. A bristle remembers the contact plane in which it was stretched.
fn of_turns(base: &Base, twin: &Twin, answers: &[Answer], largest: f64) -> f64 {
    let frame = answers.len() - 1;
    let remembers =
        |body: usize| matches!(base.scene.bodies[body].surface.friction, Friction::Bristle { .. });
    let since = if remembers(0) || remembers(1) { 0 } else { frame };
    let turned = (since..=frame).map(|frame| {
        turned_by_a_fold(base, twin, frame, &answers[frame]).max(of_directions(base, twin, frame))
    });
    let [a, b] = &base.scene.frames[frame];
    let norm = |v: [f64; 3]| Vec3::from(v).norm();
    let speed = (Vec3::from(a.linear_velocity) - Vec3::from(b.linear_velocity)).norm()
        + (norm(a.angular_velocity) + norm(b.angular_velocity)) * base.scene.size;
    let force = std::f64::consts::SQRT_2 * largest + base.scene.damping() * speed;
    force * turned.fold(0.0, f64::max)
}

/// Uncertainty of the direction of a shared force, rad. Two faces folded by a small angle θ share a force by
/// the difference of their depths; rounding moves each by ε of a size, and the point of balance by ε/θ of it.
/// The direction turns by that over the depth, by at most θ. Planes of thin triangles are as uncertain as
/// their heights.
fn turned_by_a_fold(base: &Base, twin: &Twin, frame: usize, answer: &Answer) -> f64 {
    /// Steeper folds are sufficiently certain.
    const STEEP: f64 = 1e-3;
    let back = twin.back.turn.inverse();
    let far = base.scene.frames[frame]
        .iter()
        .flat_map(|state| state.position)
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    let thin = thinnest(&base.scene).min(thinnest(&twin.scene));
    let moved = 64.0 * (f64::EPSILON * (base.scene.size + far) / thin + twin.rounding);
    let mine = base.answers[frame].contacts.iter().map(|touch| (touch.normal, touch.depth));
    let all: Vec<_> =
        mine.clone().chain(answer.contacts.iter().map(|touch| (back * touch.normal, touch.depth))).collect();
    let mut most = 0.0_f64;
    for (normal, depth) in mine {
        for (other, _) in &all {
            let fold = (normal - other).norm();
            if fold > f64::EPSILON * 8.0 && fold < STEEP {
                most = most.max(fold.min(moved / (fold * depth)));
            }
        }
    }
    most
}

/// Plays a twin and compares it with the scene, bit by bit or within the tolerance.
pub fn compare(base: &mut Base, twin: &Twin, is_bits: bool, random: &mut Random) -> Verdict {
    let answers = match twin.play(&base.scene, &mut base.stage) {
        Ok(answers) => answers,
        Err(refusal) => {
            let says = format!("the twin is refused: {refusal}");
            let twin = Some(twin.scene.clone());
            return Verdict::Differs(Finding { frame: 0, relative: 1.0, says, is_refusal: true, twin });
        }
    };
    for (frame, answer) in answers.iter().enumerate() {
        let first = &base.answers[frame];
        if is_bits {
            if first.bits != answer.bits {
                let relative = distance(&first.wrenches, &answer.wrenches, base.scene.size)
                    / first.largest.max(answer.largest).max(f64::MIN_POSITIVE);
                return Verdict::Differs(finding(base, twin, frame, relative, answer));
            }
            continue;
        }
        let largest = base.largest(frame).max(answer.largest / twin.back.force);
        let mut allowance = Allowance::of(base, twin, largest);
        allowance.force += match base.scene.is_of_solids() {
            true => Allowance::of_solids(base, twin, &answers[..=frame]),
            false => of_turns(base, twin, &answers[..=frame], largest),
        };
        let read = twin.read(answer, &base.scene, frame);
        if allowance.exceeded(&first.wrenches, &read) > 1.0 {
            let difference = distance(&first.wrenches, &read, allowance.lever);
            let found = finding(base, twin, frame, difference / largest, answer);
            let depth = least_depth(base, twin, frame, answer);
            let is_at_a_jump = jump::is_there(base, twin, (frame, depth), &read, &allowance, random);
            return if is_at_a_jump { Verdict::AtAJump(found) } else { Verdict::Differs(found) };
        }
    }
    Verdict::Agrees
}

/// Least depth of a contact up to a frame, including the twin's answer, m; at most a thousandth of the
/// scene's size.
fn least_depth(base: &Base, twin: &Twin, frame: usize, answer: &Answer) -> f64 {
    let size = base.scene.size;
    let scale = size / twin.scene.size;
    let mine = base.answers[..=frame].iter().flat_map(|answer| &answer.contacts).map(|touch| touch.depth);
    let all = mine.chain(answer.contacts.iter().map(|touch| touch.depth * scale));
    all.fold(1e-3 * size, f64::min)
}

fn finding(base: &Base, twin: &Twin, frame: usize, relative: f64, answer: &Answer) -> Finding {
    let says = format!("first:{}\ntwin: {}", told(&base.answers[frame]), told(answer));
    Finding { frame, relative, says, is_refusal: false, twin: Some(twin.scene.clone()) }
}

/// Text of a frame's answer.
pub fn told(answer: &Answer) -> String {
    let mut text = format!(
        " force on a {:?} moment {:?}",
        answer.wrenches[0].force.as_slice(),
        answer.wrenches[0].moment.as_slice()
    );
    for touch in answer.contacts.iter().take(8) {
        text += &format!(
            "\n  depth {:.9e} weight {:.9} normal {:?} normal force {:.6e} friction {:.6e} primitives {:?} feature {:#x} \
             end {} sticks {}",
            touch.depth,
            touch.weight,
            touch.normal.as_slice(),
            touch.normal_force,
            touch.friction.norm(),
            touch.of,
            touch.feature,
            touch.end,
            touch.sticks
        );
    }
    text
}
