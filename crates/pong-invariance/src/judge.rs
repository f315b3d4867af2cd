//! Whether two answers are the same.

use crate::allowance::{Allowance, distance, thinnest};
use crate::base::Base;
use crate::jump;
use crate::play::Answer;
use crate::random::Random;
use crate::scene::{Friction, Scene};
use crate::twin::Twin;
use pong_geometry::Vec3;

/// What came of one comparison.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// The same.
    Agrees,
    /// There is no such twin of this scene, or the check says nothing of it.
    DoesNotApply,
    /// The answers differ, and so do those of the first scene itself on both sides of a place within rounding.
    AtAJump(Finding),
    /// The answers differ.
    Differs(Finding),
}

/// A disagreement.
#[derive(Clone, Debug)]
pub struct Finding {
    /// In which frame first.
    pub frame: usize,
    /// Ratio of the difference to the largest term.
    pub relative: f64,
    /// What differs.
    pub says: String,
    /// Whether the twin was refused by the loader or the engine.
    pub is_refusal: bool,
    /// The twin's scene, if it has models and states of its own.
    pub twin: Option<Scene>,
}

impl Verdict {
    /// A disagreement of a scene with itself.
    pub fn differs(frame: usize, relative: f64, says: String) -> Self {
        Self::Differs(Finding { frame, relative, says, is_refusal: false, twin: None })
    }
}

/// What folds leave uncertain of a force. Normal force and friction turn with the normal, and damping sees another part of
/// the velocity. A bristle remembers the contact plane in which it was stretched.
fn of_folds(base: &Base, twin: &Twin, answers: &[Answer], largest: f64) -> f64 {
    let frame = answers.len() - 1;
    let remembers =
        |body: usize| matches!(base.scene.bodies[body].surface.friction, Friction::Bristle { .. });
    let since = if remembers(0) || remembers(1) { 0 } else { frame };
    let turned = (since..=frame).map(|frame| turned_by_a_fold(base, twin, frame, &answers[frame]));
    let [a, b] = &base.scene.frames[frame];
    let norm = |v: [f64; 3]| Vec3::from(v).norm();
    let speed = (Vec3::from(a.linear_velocity) - Vec3::from(b.linear_velocity)).norm()
        + (norm(a.angular_velocity) + norm(b.angular_velocity)) * base.scene.size;
    let force = std::f64::consts::SQRT_2 * largest + base.scene.damping() * speed;
    force * turned.fold(0.0, f64::max)
}

/// How uncertain the direction of a shared push is. Two faces folded by a small angle θ divide a push by the difference of
/// their depths; rounding moves each by ε of a size, and the place where they balance by ε/θ of it. The direction turns by that
/// over the depth, and by no more than θ. The planes of thin triangles are known as well as their heights.
fn turned_by_a_fold(base: &Base, twin: &Twin, frame: usize, answer: &Answer) -> f64 {
    /// Steeper folds are known well enough.
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

/// Plays a twin and holds it against the scene, bit by bit or within the tolerance.
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
                    / first.largest.max(answer.largest);
                return Verdict::Differs(finding(base, twin, frame, relative, answer));
            }
            continue;
        }
        let largest = base.largest(frame).max(answer.largest / twin.back.force);
        let mut allowance = Allowance::of(base, twin, largest);
        allowance.force += of_folds(base, twin, &answers[..=frame], largest);
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

/// The least depth of a contact up to a frame, of the twin's answer in it as well, m. What is deeper than a thousandth of the
/// scene's size is deep enough.
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

/// A frame's answer to read.
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
