//! Contenders that run the same pass in turn: in every round each once, so that what else the machine does meets all.

use crate::timing::{Clock, Ratios, Times};

/// What runs against what.
#[derive(Default)]
pub struct Race<'a> {
    contenders: Vec<(String, Box<dyn FnMut() + 'a>)>,
}

impl<'a> Race<'a> {
    /// A race without contenders.
    pub fn new() -> Self {
        Self::default()
    }

    /// One more contender: its name in the table, and one whole pass.
    pub fn enter(&mut self, name: &str, pass: impl FnMut() + 'a) {
        self.contenders.push((name.to_owned(), Box::new(pass)));
    }

    /// Runs `rounds` rounds. In each, every contender runs its pass twice, of which the second counts: the first brings
    /// its data back into the caches that the contender before it has filled, so that all are measured alike. `items` is
    /// what a pass is shared among: frames, queries.
    pub fn run(mut self, rounds: usize, items: usize) -> Outcome {
        let mut times: Vec<Times> = self.contenders.iter().map(|_| Times::new(items)).collect();
        for _ in 0..rounds {
            for ((_, pass), times) in self.contenders.iter_mut().zip(&mut times) {
                pass();
                times.run(pass);
            }
        }
        Outcome(self.contenders.into_iter().map(|(name, _)| name).zip(times).collect())
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
