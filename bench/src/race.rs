//! Contenders that run the same pass in turn: in every round each once, so that what else the machine does meets all.

use crate::timing::{Clock, Ratios, Times};

/// What runs against what.
pub struct Race<'a> {
    contenders: Vec<Contender<'a>>,
    warm_ups: usize,
}

struct Contender<'a> {
    name: String,
    /// What comes before every pass and is not timed.
    prepare: Box<dyn FnMut() + 'a>,
    pass: Box<dyn FnMut(usize) + 'a>,
}

impl Default for Race<'_> {
    fn default() -> Self {
        Self { contenders: Vec::new(), warm_ups: 1 }
    }
}

impl<'a> Race<'a> {
    /// A race without contenders, with one pass to warm up before each that counts.
    pub fn new() -> Self {
        Self::default()
    }

    /// A race with so many passes to warm up before each that counts: for scenes that the contenders before have
    /// pushed out of the caches, and that one pass does not bring back.
    pub fn with_warm_ups(warm_ups: usize) -> Self {
        Self { warm_ups, ..Self::default() }
    }

    /// One more contender: its name in the table, and one whole pass.
    pub fn enter(&mut self, name: &str, pass: impl FnMut() + 'a) {
        self.enter_prepared(name, || (), pass);
    }

    /// One more contender, with what comes before each of its passes and is not timed.
    pub fn enter_prepared(&mut self, name: &str, prepare: impl FnMut() + 'a, mut pass: impl FnMut() + 'a) {
        self.enter_boxed(name, Box::new(prepare), Box::new(move |_| pass()));
    }

    /// One more contender, which is told the number of the round: for one that is of several equals in turn.
    pub fn enter_in_turn(&mut self, name: &str, pass: impl FnMut(usize) + 'a) {
        self.enter_boxed(name, Box::new(|| ()), Box::new(pass));
    }

    fn enter_boxed(&mut self, name: &str, prepare: Box<dyn FnMut() + 'a>, pass: Box<dyn FnMut(usize) + 'a>) {
        self.contenders.push(Contender { name: name.to_owned(), prepare, pass });
    }

    /// Runs `rounds` rounds. In each, every contender warms up and then runs the pass that counts: so its data are back
    /// in the caches that the contender before it has filled, and all are measured alike. `items` is what a pass is
    /// shared among: frames, queries.
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
