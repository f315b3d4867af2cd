//! Where physics itself jumps: the first hit of a plunger changes its surface, two faces are equally deep, a bristle breaks
//! away. There two tellings of one scene may differ, and only there.
//!
//! A jump shows by itself, without the twin: a small step away, on either side, the first scene gives answers that rounding
//! does not change, but different ones on the two sides, as different as what was found, and both answers found are among
//! them. An answer that only rounding decides is none of that: a step away it is the same all around (a seam), or does
//! not settle anywhere (a branch taken on noise).
//!
//! Where two jumps coincide (a centre in the planes of two rims at once) rounding decides each of them by itself. It may
//! combine their sides in a way that no step of a whole body can: two planes that are one leave nothing between them. Then
//! the numbers of the shapes are displaced as well, each by itself, so that the two jumps come apart. Corners that are equal
//! to the bit stay so, and with them what hangs together.

mod displaced;

use crate::allowance::{Allowance, distance, thinnest};
use crate::base::Base;
use crate::play::Stage;
use crate::random::Random;
use crate::twin::Twin;
use displaced::{beside, reshaped};
use pong_engine::State;
use pong_geometry::{Vec3, Wrench};

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
    let first = base.answers[frame].wrenches;
    let difference = distance(&first, read, allowance.lever);
    let size = base.scene.size;
    // So far that what changes smoothly stays well below the difference: depths change by the step.
    let smooth = 0.02 * difference / base.largest(frame).max(difference) * depth / size;
    let step = smooth.clamp(SHORTEST_STEP, LONGEST_STEP).max(100.0 * twin.rounding / size);
    let mut around = Around { answers: [first, *read], difference, allowance, settled: Vec::new() };
    let decided = around.decide(
        |_| false,
        |around| {
            let frames = beside(&base.scene.frames[..=frame], step, size, random.chance(0.5), random);
            around.look(&mut base.stage, frames, size, random)
        },
    );
    if let Some(is_there) = decided {
        return is_there;
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

/// Answers beside a place that rounding does not change.
struct Around<'a> {
    /// The two that were found.
    answers: [[Wrench; 2]; 2],
    /// How far these are apart, N.
    difference: f64,
    allowance: &'a Allowance,
    settled: Vec<[Wrench; 2]>,
}

/// What is seen among the answers around.
enum Seen {
    /// Too few of them settle.
    Nothing,
    /// Not both answers, or no jump between them.
    Some,
    /// A jump, and both answers beside it.
    Both,
}

impl Around<'_> {
    /// Looks around, round after round, until that decides whether a jump is there; `None` if it never does. `look` answers
    /// `None` for what cannot be played, `gives_up` whether further rounds are of no use.
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

    /// The last answer of a history, kept if two further roundings of its states do not change it. `None` if it cannot be played.
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

    /// How far the settled answers are apart, N.
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
        // What is exactly at the jump may have an answer between those on its sides.
        let is_seen = self.answers.iter().any(is_beside)
            && self.answers.iter().all(|answer| is_beside(answer) || is_between(answer));
        if self.is_jump() && is_seen { Seen::Both } else { Seen::Some }
    }
}

/// Of all wrenches between two the one that is nearest to an answer.
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

/// The wrenches of the last frame of a history.
fn last(stage: &mut Stage, frames: &[[State; 2]]) -> Option<[Wrench; 2]> {
    stage.play(frames).ok()?.pop().map(|answer| answer.wrenches)
}
