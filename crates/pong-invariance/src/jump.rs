//! Recognition of true discontinuities: the first hit of a plunger changes its surface, two faces are equally
//! deep, a bristle breaks away. Only there may two descriptions of one scene differ.
//!
//! A discontinuity shows without the twin: a small step away, on either side, the first scene gives answers
//! that are stable under rounding but differ between the sides by as much as the answers in question, and
//! both of these are among them. An answer decided by rounding alone fails this: a step away it is the same
//! all around (a seam), or never stable (a branch taken on noise).
//!
//! Where two discontinuities coincide (a centre in the planes of two edge loops at once), rounding decides
//! each separately. It may combine their sides in a way that no step of a whole body can: two coincident
//! planes leave nothing between them. The numbers of the shapes are then displaced as well, independently, so
//! that the two separate. Bit-equal corners are displaced alike, which keeps connected shapes connected.

mod displaced;

use crate::allowance::{Allowance, bent, distance, thinnest};
use crate::base::Base;
use crate::play::Stage;
use crate::random::Random;
use crate::twin::Twin;
use displaced::{beside, reshaped};
use pong_engine::State;
use pong_geometry::{Vec3, Wrench};

/// Points tried per round, and rounds at most: where three surfaces meet, or a direction turns through a wide
/// angle, few points are not conclusive.
const PLACES: usize = 40;
const ROUNDS: usize = 6;
/// Longest step, in sizes of the scene; slower changes are no discontinuity.
const LONGEST_STEP: f64 = 1e-6;
/// Shortest step, still far above rounding, in sizes of the scene.
const SHORTEST_STEP: f64 = 1e-12;

/// Tests whether the difference of a twin's frame is a discontinuity of the first scene. `depth` is the least
/// depth of a contact in either answer, m.
pub fn is_there(
    base: &mut Base,
    twin: &Twin,
    (frame, depth): (usize, f64),
    read: &[Wrench; 2],
    allowance: &Allowance,
    random: &mut Random,
) -> bool {
    let first = base.answers[frame].wrenches;
    let difference = distance(&first, read, allowance.lever);
    let size = base.scene.size;
    // Step length for which smooth changes stay well below the difference: depths change by the step.
    let smooth = 0.02 * difference / base.largest(frame).max(difference) * depth / size;
    let step = smooth.clamp(SHORTEST_STEP, LONGEST_STEP).max(100.0 * twin.rounding / size);
    let mut around = Around { answers: [first, *read], difference, allowance, settled: Vec::new() };
    // Faces that are bent by single precision are known to the height of their corners: so is whether they touch.
    let of_bends = (bent(&base.scene) / size).min(LONGEST_STEP);
    let steps = [step, of_bends];
    let mut decided = None;
    for step in steps.into_iter().filter(|longer| *longer >= step) {
        decided = around.decide(
            |_| false,
            |around| {
                let frames = beside(&base.scene.frames[..=frame], step, size, random.chance(0.5), random);
                around.look(&mut base.stage, frames, size, random)
            },
        );
        if decided == Some(true) {
            return true;
        }
    }
    if decided == Some(false) {
        return false;
    }
    // Thin triangles turn by more than their corners move.
    let longest = (step * thinnest(&base.scene)).max(SHORTEST_STEP);
    let decided = around.decide(
        |around| !around.is_jump(),
        |around| {
            let scene = reshaped(&base.scene, (SHORTEST_STEP, longest), random);
            let step = random.log_between(SHORTEST_STEP, longest);
            let frames = beside(&scene.frames[..=frame], step, size, random.chance(0.5), random);
            around.look(&mut Stage::set_up(&scene, 0).ok()?, frames, size, random)
        },
    );
    decided.unwrap_or(false)
}

/// Stable answers near a point.
struct Around<'a> {
    /// The two answers in question.
    answers: [[Wrench; 2]; 2],
    /// Distance between these, N.
    difference: f64,
    allowance: &'a Allowance,
    settled: Vec<[Wrench; 2]>,
}

/// Evidence among the stable answers.
enum Seen {
    /// Too few answers are stable.
    Nothing,
    /// One answer is missing, or there is no discontinuity between them.
    Some,
    /// A discontinuity with both answers beside it.
    Both,
}

impl Around<'_> {
    /// Samples round after round until a discontinuity is confirmed or excluded; `None` if neither happens.
    /// `look` returns `None` for states that cannot be played; `gives_up` is true if further rounds are
    /// useless.
    fn decide(
        &mut self,
        gives_up: impl Fn(&Self) -> bool,
        mut look: impl FnMut(&mut Self) -> Option<()>,
    ) -> Option<bool> {
        self.settled.clear();
        for round in 1..=ROUNDS {
            for _ in 0..PLACES {
                if look(self).is_none() {
                    return Some(false);
                }
            }
            match self.verdict(round * PLACES) {
                Seen::Nothing => return Some(false),
                Seen::Both => return Some(true),
                Seen::Some if gives_up(self) => return Some(false),
                Seen::Some => {}
            }
        }
        None
    }

    /// Last answer of a history, kept if two further roundings of its states do not change it. `None` if it
    /// cannot be played.
    fn look(
        &mut self,
        stage: &mut Stage,
        mut frames: Vec<[State; 2]>,
        size: f64,
        random: &mut Random,
    ) -> Option<()> {
        let lever = self.allowance.lever;
        let there = last(stage, &frames)?;
        let mut is_settled = true;
        for _ in 0..2 {
            frames = beside(&frames, 4.0 * f64::EPSILON, size, false, random);
            let again = last(stage, &frames)?;
            is_settled &=
                distance(&there, &again, lever) < (0.05 * self.difference).max(2.0 * self.allowance.force);
        }
        if is_settled {
            self.settled.push(there);
        }
        Some(())
    }

    /// Largest distance between stable answers, N.
    fn spread(&self) -> f64 {
        let lever = self.allowance.lever;
        self.settled.iter().map(|there| distance(there, &self.settled[0], lever)).fold(0.0, f64::max)
    }

    fn is_jump(&self) -> bool {
        self.spread() > 0.5 * self.difference
    }

    fn verdict(&self, tried: usize) -> Seen {
        if self.settled.len() < tried / 4 {
            return Seen::Nothing;
        }
        let lever = self.allowance.lever;
        let near = 0.25 * self.difference.max(self.spread()) + self.allowance.force;
        let is_beside =
            |answer: &[Wrench; 2]| self.settled.iter().any(|there| distance(there, answer, lever) < near);
        let is_between = |answer: &[Wrench; 2]| {
            let mut pairs = self.settled.iter().enumerate().flat_map(|(i, one)| {
                self.settled[..i].iter().map(move |other| between(one, other, answer, lever))
            });
            pairs.any(|there| distance(&there, answer, lever) < near)
        };
        // A state exactly at the discontinuity may have an answer between those of its sides.
        let is_seen = self.answers.iter().any(is_beside)
            && self.answers.iter().all(|answer| is_beside(answer) || is_between(answer));
        if self.is_jump() && is_seen { Seen::Both } else { Seen::Some }
    }
}

/// Wrench nearest to an answer on the straight line between two others.
fn between(one: &[Wrench; 2], other: &[Wrench; 2], answer: &[Wrench; 2], lever: f64) -> [Wrench; 2] {
    let arrow = |from: &Wrench, to: &Wrench| (to.force - from.force, (to.moment - from.moment) / lever);
    let dot = |x: (Vec3, Vec3), y: (Vec3, Vec3)| x.0.dot(&y.0) + x.1.dot(&y.1);
    let way = [0, 1].map(|i| arrow(&one[i], &other[i]));
    let square: f64 = way.iter().map(|&way| dot(way, way)).sum();
    let along: f64 = [0, 1].into_iter().map(|i| dot(way[i], arrow(&one[i], &answer[i]))).sum();
    let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    std::array::from_fn(|i| Wrench {
        force: one[i].force + (other[i].force - one[i].force) * share,
        moment: one[i].moment + (other[i].moment - one[i].moment) * share,
    })
}

/// Wrenches of the last frame of a history.
fn last(stage: &mut Stage, frames: &[[State; 2]]) -> Option<[Wrench; 2]> {
    stage.play(frames).ok()?.pop().map(|answer| answer.wrenches)
}
