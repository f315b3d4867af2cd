//! Whether rounds of moderate cost are sooner done with workers or by the caller alone: found out by trying.
//!
//! What a worker takes off such a round depends on how far apart the cores are, whether they are threads of one core and who
//! else runs on them; a host of virtual machines changes all of that while Pong runs. So of the two ways one is *usual*, and now
//! and then some rounds in a row go the other way, are timed, and are compared with the usual rounds right before them. No
//! answer depends on the way. Rounds that only cost time to compare are rare: as long as the usual way stays the quicker one,
//! the next trial is twice as far away.

use std::time::Instant;

/// Work below this is done by the caller alone, ns: waking nobody is quicker.
pub const WORTH_SHARING_NS: u64 = 5_000;

/// Rounds that may cost so much, ns, or more are always shared: alone, one of them would take the caller by surprise. What a round
/// may cost is a rough estimate, often twice the time that it takes.
pub const ALWAYS_SHARED_NS: u64 = 160_000;

/// Classes of cost, each up to twice as much as the one before: what pays for long rounds need not for short ones.
const CLASSES: usize = ((ALWAYS_SHARED_NS - 1) / WORTH_SHARING_NS).ilog2() as usize + 1;

/// Usual rounds from one trial to the next: after the usual way has changed, and at most.
const SOON: u32 = 32;
const LATEST: u32 = 4096;

/// A trial that finds the other way quicker is repeated so soon.
const AGAIN: u32 = 16;

/// So many trials in a row must find the other way quicker before it is the usual one.
const AGREEING: u32 = 2;

/// Rounds of a trial that find the caches as the usual way has left them, and those that count.
const FIRST: u32 = 2;
const COUNTED: u32 = 2;

/// A trial in which no worker comes ends after so many rounds.
const LONGEST: u32 = 64;

/// Usual rounds right before a trial that are timed.
const BEFORE: usize = 2;

/// So much of the usual time, or less, is quicker.
const QUICKER: f64 = 0.985;

/// Trials of a world, for each class of cost.
#[derive(Debug)]
pub struct SharingTrials {
    classes: [Class; CLASSES],
    present: Option<Present>,
}

/// The round in hand, if it is timed.
#[derive(Debug)]
struct Present {
    class: usize,
    cost_ns: u64,
    began: Instant,
}

impl SharingTrials {
    /// All rounds are shared until trials say otherwise.
    pub const NONE: Self = Self { classes: [Class::NEW; CLASSES], present: None };

    /// Whether a round that may cost so much, ns, at least [`WORTH_SHARING_NS`], is to be shared.
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

    /// The round is done, and all that depends on who did it; workers had a part in it, or not.
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
    /// After trials that found rounds of any cost quicker alone.
    pub const ALONE: Self = Self { classes: [Class { shares: false, ..Class::NEW }; CLASSES], present: None };

    /// Whether any trial has come to an end.
    pub fn any_ended(&self) -> bool {
        self.classes.iter().any(|class| class.interval > SOON || class.agreeing > 0 || !class.shares)
    }
}

/// Rounds of about one cost.
#[derive(Clone, Copy, Debug)]
struct Class {
    /// The usual way: with workers.
    shares: bool,
    /// Usual rounds until the next trial, and from one trial to the next.
    left: u32,
    interval: u32,
    /// Times of the last usual rounds that were timed, over what they might cost.
    usual: [f64; BEFORE],
    trial: Option<Trial>,
    /// Trials in a row that found the other way quicker.
    agreeing: u32,
}

/// A trial that is under way.
#[derive(Clone, Copy, Debug)]
struct Trial {
    rounds: u32,
    /// Those that went the way that is tried.
    other_way: u32,
    /// The least time of those that count, over what they might cost.
    least: f64,
}

impl Trial {
    const NEW: Self = Self { rounds: 0, other_way: 0, least: f64::INFINITY };
}

/// How the next round is done.
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

    /// A timed round took so long, over what it might cost.
    fn note(&mut self, time: f64, workers_had_a_part: bool) {
        let Some(trial) = &mut self.trial else {
            self.usual.rotate_left(1);
            self.usual[BEFORE - 1] = time;
            self.trial = (self.left == 0).then_some(Trial::NEW);
            return;
        };
        trial.rounds += 1;
        // To be shared is to be asked for: a worker that sleeps or has no core does not come.
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

    /// The trial is over; its least time was so long.
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

    /// What a round takes each way, alone or shared, over what it might cost; and whether workers come when they are asked.
    struct Machine {
        times: [f64; 2],
        workers_come: bool,
        /// One round in so many takes thrice as long.
        disturbed: usize,
        random: Random,
    }

    impl Machine {
        fn new(alone: f64, shared: f64) -> Self {
            Self { times: [alone, shared], workers_come: true, disturbed: 20, random: Random::new(5, 0, 0) }
        }

        /// Runs rounds; the share of them that were shared.
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

    /// Rounds that no worker came to say nothing about rounds that are shared; a trial without workers ends all the same.
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

    /// A worker that sleeps comes some rounds after it is asked for: these are not counted.
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
        // What disturbs the usual rounds right before a trial makes the other way look quicker.
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
