//! Contenders that run the same pass in turn, each once per round, so that disturbances by the machine affect
//! all alike.

use crate::timing::{Clock, Ratios, Times};

/// Contenders and settings of a race.
pub struct Race<'a> {
    contenders: Vec<Contender<'a>>,
    warm_ups: usize,
}

struct Contender<'a> {
    name: String,
    /// Untimed preparation of every pass.
    prepare: Box<dyn FnMut() + 'a>,
    pass: Box<dyn FnMut(usize) + 'a>,
}

impl Default for Race<'_> {
    fn default() -> Self {
        Self { contenders: Vec::new(), warm_ups: 1 }
    }
}

impl<'a> Race<'a> {
    /// A race without contenders, with one warm-up pass before each counted one.
    pub fn new() -> Self {
        Self::default()
    }

    /// A race with several warm-up passes before each counted one: for scenes that other contenders evict
    /// from the caches and that one pass does not bring back.
    pub fn with_warm_ups(warm_ups: usize) -> Self {
        Self { warm_ups, ..Self::default() }
    }

    /// Adds a contender: its name in the table, and one whole pass.
    pub fn enter(&mut self, name: &str, pass: impl FnMut() + 'a) {
        self.enter_prepared(name, || (), pass);
    }

    /// Adds a contender with an untimed preparation of each pass.
    pub fn enter_prepared(&mut self, name: &str, prepare: impl FnMut() + 'a, mut pass: impl FnMut() + 'a) {
        self.enter_boxed(name, Box::new(prepare), Box::new(move |_| pass()));
    }

    /// Adds a contender whose pass takes the number of the round, to choose among equal instances in turn.
    pub fn enter_in_turn(&mut self, name: &str, pass: impl FnMut(usize) + 'a) {
        self.enter_boxed(name, Box::new(|| ()), Box::new(pass));
    }

    fn enter_boxed(&mut self, name: &str, prepare: Box<dyn FnMut() + 'a>, pass: Box<dyn FnMut(usize) + 'a>) {
        self.contenders.push(Contender { name: name.to_owned(), prepare, pass });
    }

    /// Runs `rounds` rounds. In each, every contender warms up, which restores its data to the caches that
    /// the contender before has filled, and then runs the counted pass. `items` is the number of frames or
    /// queries in a pass.
    pub fn run(mut self, rounds: usize, items: usize) -> Outcome {
        let mut times: Vec<Times> = self.contenders.iter().map(|_| Times::new(items)).collect();
        for round in 0..rounds {
            for (contender, times) in self.contenders.iter_mut().zip(&mut times) {
                for _ in 0..self.warm_ups {
                    (contender.prepare)();
                    (contender.pass)(round);
                }
                (contender.prepare)();
                times.run(|| (contender.pass)(round));
            }
        }
        Outcome(self.contenders.into_iter().map(|contender| contender.name).zip(times).collect())
    }
}

/// The times of a race.
pub struct Outcome(pub Vec<(String, Times)>);

impl Outcome {
    /// The times of a contender, if it ran.
    pub fn of(&self, name: &str) -> Option<&Times> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, times)| times)
    }

    /// Ratios of `over` to `under`, round by round, if both ran.
    pub fn ratio(&self, over: &str, under: &str, clock: Clock) -> Option<Ratios> {
        Some(self.of(over)?.over(self.of(under)?, clock))
    }
}
