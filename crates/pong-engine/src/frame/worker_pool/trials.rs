//! Trials that decide whether rounds of moderate cost are faster with workers or on the caller alone.
//!
//! The gain depends on the distance between the cores, on whether they are threads of one core, and on other
//! load; on a virtual machine all of that changes while Pong runs. One mode is therefore the *usual* one. Now
//! and then a few rounds in a row use the other mode; they are timed and compared with the usual rounds right
//! before them. Results do not depend on the mode. While the usual mode stays faster, the interval between
//! trials doubles, so the rounds spent on comparison are rare.

use std::time::Instant;

/// Cost below which the caller works alone without a trial, ns.
pub const WORTH_SHARING_NS: u64 = 5_000;

/// Estimated cost from which rounds are always shared, ns: run alone, such a round would be a noticeable
/// delay. The estimate is rough, often twice the real time.
pub const ALWAYS_SHARED_NS: u64 = 160_000;

/// Cost classes, each up to twice as costly as the one before; sharing may pay for long rounds and not for
/// short ones.
const CLASSES: usize = ((ALWAYS_SHARED_NS - 1) / WORTH_SHARING_NS).ilog2() as usize + 1;

/// Usual rounds between two trials: after a change of mode, and at most.
const SOON: u32 = 32;
const LATEST: u32 = 4096;

/// Rounds until a trial that favoured the other mode is repeated.
const AGAIN: u32 = 16;

/// Consecutive trials that must favour the other mode before it becomes the usual one.
const AGREEING: u32 = 2;

/// Rounds of a trial that are not counted, since their caches are from the usual mode, and rounds that are.
const FIRST: u32 = 2;
const COUNTED: u32 = 2;

/// Rounds after which a trial without any worker ends.
const LONGEST: u32 = 64;

/// Timed usual rounds right before a trial.
const BEFORE: usize = 2;

/// Relative time at or below which a mode counts as faster.
const QUICKER: f64 = 0.985;

/// Trials of a world, per cost class.
#[derive(Debug)]
pub struct SharingTrials {
    classes: [Class; CLASSES],
    present: Option<Present>,
}

/// The current round, if it is timed.
#[derive(Debug)]
struct Present {
    class: usize,
    cost_ns: u64,
    began: Instant,
}

impl SharingTrials {
    /// Initial state: all rounds are shared.
    pub const NONE: Self = Self { classes: [Class::NEW; CLASSES], present: None };

    /// Returns true if a round of this estimated cost (ns, at least [`WORTH_SHARING_NS`]) is to be shared.
    pub fn shares(&mut self, cost_ns: u64) -> bool {
        self.present = None;
        if cost_ns >= ALWAYS_SHARED_NS {
            return true;
        }
        let class = (cost_ns / WORTH_SHARING_NS).ilog2() as usize;
        let next = self.classes[class].next();
        if next.is_timed {
            self.present = Some(Present { class, cost_ns, began: Instant::now() });
        }
        next.shares
    }

    /// Ends a timed round, with everything that depends on the mode; the closure returns true if workers took
    /// part.
    #[inline]
    pub fn end_round(&mut self, workers_had_a_part: impl FnOnce() -> bool) {
        if let Some(Present { class, cost_ns, began }) = self.present.take() {
            let time_ns = began.elapsed().as_nanos() as f64;
            self.classes[class].note(time_ns / cost_ns as f64, workers_had_a_part());
        }
    }
}

#[cfg(test)]
impl SharingTrials {
    /// State after trials that favoured the caller alone in every class.
    pub const ALONE: Self = Self { classes: [Class { shares: false, ..Class::NEW }; CLASSES], present: None };

    /// Returns true if any trial has been concluded.
    pub fn any_ended(&self) -> bool {
        self.classes.iter().any(|class| class.interval > SOON || class.agreeing > 0 || !class.shares)
    }
}

/// Rounds of one cost class.
#[derive(Clone, Copy, Debug)]
struct Class {
    /// Usual mode: true with workers.
    shares: bool,
    /// Usual rounds left until the next trial, and interval between trials.
    left: u32,
    interval: u32,
    /// Times of the last timed usual rounds, relative to the estimated cost.
    usual: [f64; BEFORE],
    trial: Option<Trial>,
    /// Consecutive trials that favoured the other mode.
    agreeing: u32,
}

/// A running trial.
#[derive(Clone, Copy, Debug)]
struct Trial {
    rounds: u32,
    /// Rounds in the other mode.
    other_way: u32,
    /// Least time of the counted rounds, relative to the estimated cost.
    least: f64,
}

impl Trial {
    const NEW: Self = Self { rounds: 0, other_way: 0, least: f64::INFINITY };
}

/// Mode of the next round, and whether it is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Next {
    shares: bool,
    is_timed: bool,
}

impl Class {
    const NEW: Self = Self {
        shares: true,
        left: SOON,
        interval: SOON,
        usual: [f64::INFINITY; BEFORE],
        trial: None,
        agreeing: 0,
    };

    #[inline]
    fn next(&mut self) -> Next {
        if self.trial.is_some() {
            return Next { shares: !self.shares, is_timed: true };
        }
        self.left = self.left.saturating_sub(1);
        Next { shares: self.shares, is_timed: (self.left as usize) < BEFORE }
    }

    /// Records the time of a timed round, relative to the estimated cost.
    fn note(&mut self, time: f64, workers_had_a_part: bool) {
        let Some(trial) = &mut self.trial else {
            self.usual.rotate_left(1);
            self.usual[BEFORE - 1] = time;
            self.trial = (self.left == 0).then_some(Trial::NEW);
            return;
        };
        trial.rounds += 1;
        // In a trial of the shared mode only rounds with a worker count; a worker that sleeps or has no core
        // may not come.
        if self.shares || workers_had_a_part {
            trial.other_way += 1;
            if trial.other_way > FIRST {
                trial.least = trial.least.min(time);
            }
        }
        if trial.other_way == FIRST + COUNTED || trial.rounds == LONGEST {
            let least = trial.least;
            self.trial = None;
            self.conclude(least);
        }
    }

    /// Concludes a trial with its least relative time.
    fn conclude(&mut self, least: f64) {
        let usual = self.usual.iter().copied().fold(f64::INFINITY, f64::min);
        if least >= usual * QUICKER {
            self.agreeing = 0;
            self.interval = (2 * self.interval).min(LATEST);
            self.left = self.interval;
            return;
        }
        self.agreeing += 1;
        self.left = AGAIN;
        if self.agreeing == AGREEING {
            *self = Self { shares: !self.shares, ..Self::NEW };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_testkit::Random;

    /// Simulated machine: relative times of a round, alone and shared, and whether workers come when asked.
    struct Machine {
        times: [f64; 2],
        workers_come: bool,
        /// One round in this many takes three times as long.
        disturbed: usize,
        random: Random,
    }

    impl Machine {
        fn new(alone: f64, shared: f64) -> Self {
            Self { times: [alone, shared], workers_come: true, disturbed: 20, random: Random::new(5, 0, 0) }
        }

        /// Runs rounds; returns the fraction that were shared.
        fn run(&mut self, class: &mut Class, rounds: usize) -> f64 {
            let mut shared = 0;
            for _ in 0..rounds {
                let next = class.next();
                shared += usize::from(next.shares);
                let took_part = next.shares && self.workers_come;
                let disturbed = if self.random.below(self.disturbed) == 0 { 3.0 } else { 1.0 };
                let time = self.times[usize::from(took_part)] * disturbed * self.random.between(1.0, 1.02);
                if next.is_timed {
                    class.note(time, took_part);
                }
            }
            shared as f64 / rounds as f64
        }
    }

    #[test]
    fn the_quicker_way_is_usual_and_the_other_one_is_rare() {
        for (alone, shared) in [(1.0, 0.6), (1.0, 0.9), (1.0, 1.1), (1.0, 3.0)] {
            let (mut machine, mut class) = (Machine::new(alone, shared), Class::NEW);
            machine.run(&mut class, 1000);
            let share = machine.run(&mut class, 50_000);
            let right = if shared < alone { share } else { 1.0 - share };
            assert!(
                right > 0.98,
                "{alone} alone, {shared} shared: {right} of the rounds went the quicker way"
            );
        }
    }

    #[test]
    fn where_sharing_does_not_pay_it_ends_soon() {
        let (mut machine, mut class) = (Machine::new(1.0, 1.5), Class::NEW);
        machine.disturbed = usize::MAX;
        machine.run(&mut class, 100);
        assert!(!class.shares);
    }

    #[test]
    fn a_machine_that_changes_is_followed() {
        let (mut machine, mut class) = (Machine::new(1.0, 1.5), Class::NEW);
        for shared in [1.5, 0.6, 1.5, 0.6] {
            machine.times[1] = shared;
            machine.run(&mut class, 3 * LATEST as usize);
            assert_eq!(class.shares, shared < 1.0, "{class:?}");
        }
    }

    #[test]
    fn what_hardly_differs_changes_nothing() {
        let (mut machine, mut class) = (Machine::new(1.0, 1.0), Class::NEW);
        machine.disturbed = usize::MAX;
        assert!(machine.run(&mut class, 10_000) > 0.98);
    }

    /// Rounds without a worker are no evidence about shared rounds; a trial without workers still ends.
    #[test]
    fn workers_that_do_not_come_are_not_judged() {
        let (mut machine, mut class) = (Machine::new(1.0, 0.5), Class { shares: false, ..Class::NEW });
        machine.workers_come = false;
        let share = machine.run(&mut class, 50_000);
        assert!(!class.shares && share < 0.03, "{share}");
        machine.workers_come = true;
        machine.run(&mut class, 3 * LATEST as usize);
        assert!(class.shares);
    }

    /// A sleeping worker comes some rounds after it is asked; these rounds are not counted.
    #[test]
    fn a_trial_waits_for_workers_that_come_late() {
        let mut class = Class { shares: false, ..Class::NEW };
        for _ in 0..10 * LATEST {
            let asleep = class.trial.is_some_and(|trial| trial.rounds < 20);
            let next = class.next();
            let took_part = next.shares && !asleep;
            if next.is_timed {
                class.note(if took_part { 0.5 } else { 1.0 }, took_part);
            }
        }
        assert!(class.shares);
    }

    #[test]
    fn one_disturbed_trial_changes_nothing() {
        let (mut machine, mut class) = (Machine::new(1.0, 0.6), Class::NEW);
        machine.disturbed = usize::MAX;
        machine.run(&mut class, SOON as usize);
        // A disturbance of the usual rounds right before a trial makes the other mode look faster.
        class.usual = [3.0; BEFORE];
        machine.run(&mut class, (FIRST + COUNTED) as usize);
        assert_eq!((class.shares, class.agreeing), (true, 1), "{class:?}");
        machine.run(&mut class, 100);
        assert_eq!((class.shares, class.agreeing), (true, 0), "{class:?}");
    }

    #[test]
    fn each_class_of_cost_is_tried_by_itself() {
        let mut trials = SharingTrials::NONE;
        trials.classes[1].shares = false;
        let shares = [5_000, 9_999, 10_000, 19_999, 20_000, 159_999, 160_000, 1_000_000]
            .map(|cost_ns| trials.shares(cost_ns));
        assert_eq!(shares, [true, true, false, false, true, true, true, true]);
        assert_eq!(trials.classes.map(|class| SOON - class.left), [2, 2, 1, 0, 1]);
    }

    #[test]
    fn rounds_are_timed_before_and_in_a_trial_alone() {
        let mut class = Class::NEW;
        let timed: Vec<bool> = (0..SOON + FIRST + COUNTED + 1)
            .map(|_| {
                let next = class.next();
                if next.is_timed {
                    class.note(1.0, next.shares);
                }
                next.is_timed
            })
            .collect();
        let usual = SOON as usize - BEFORE;
        let trial = BEFORE + (FIRST + COUNTED) as usize;
        let expected = [vec![false; usual], vec![true; trial], vec![false]].concat();
        assert_eq!(timed, expected);
    }
}
