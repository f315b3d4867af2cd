//! Times of passes, and their statistics.

use cpu_time::ThreadTime;
use std::sync::OnceLock;
use std::time::Instant;

/// Clock of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// Processor time of the calling thread: excludes the time that other programs had the core, but not
    /// their effect on its caches. Excludes the work of other threads.
    Thread,
    /// Wall-clock time: for passes on more than one thread.
    Wall,
}

/// Wall clock for the engine, ns since its first reading.
pub fn now_ns() -> u64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_nanos() as u64
}

/// Times of equal passes, in seconds per item by both clocks.
pub struct Times {
    items: f64,
    passes: Vec<[f64; 2]>,
}

impl Times {
    /// No times yet, for passes over this many items.
    pub fn new(items: usize) -> Self {
        Self { items: items as f64, passes: Vec::new() }
    }

    /// Runs `pass` and records its time.
    pub fn run(&mut self, pass: impl FnOnce()) {
        let (wall, thread) = (Instant::now(), ThreadTime::now());
        pass();
        let (thread, wall) = (thread.elapsed(), wall.elapsed());
        self.passes.push([thread, wall].map(|time| time.as_secs_f64() / self.items));
    }

    /// Shortest pass, s per item.
    pub fn min(&self, clock: Clock) -> f64 {
        self.by(clock).fold(f64::INFINITY, f64::min)
    }

    /// Median pass, s per item.
    pub fn median(&self, clock: Clock) -> f64 {
        median(self.by(clock).collect())
    }

    /// Shortest passes of the earlier and of the later half of the rounds, s per item.
    pub fn min_of_halves(&self, clock: Clock) -> [f64; 2] {
        let passes: Vec<f64> = self.by(clock).collect();
        let (earlier, later) = passes.split_at(passes.len() / 2);
        let least = |half: &[f64]| half.iter().copied().fold(f64::INFINITY, f64::min);
        if earlier.is_empty() { [least(later); 2] } else { [least(earlier), least(later)] }
    }

    /// Ratios to the passes of another contender in the same rounds.
    pub fn over(&self, other: &Times, clock: Clock) -> Ratios {
        Ratios(self.by(clock).zip(other.by(clock)).map(|(mine, theirs)| mine / theirs).collect())
    }

    fn by(&self, clock: Clock) -> impl Iterator<Item = f64> + '_ {
        self.passes.iter().map(move |pass| pass[usize::from(clock == Clock::Wall)])
    }
}

/// Ratios of adjacent passes.
#[derive(Clone)]
pub struct Ratios(Vec<f64>);

impl Ratios {
    /// Median ratio.
    pub fn median(&self) -> f64 {
        median(self.0.clone())
    }

    /// Medians of the earlier and the later half of the rounds, the smaller first: a verdict of both halves
    /// has been confirmed.
    pub fn halves(&self) -> [f64; 2] {
        let (earlier, later) = self.0.split_at(self.0.len() / 2);
        let mut halves = [earlier, later].map(|half| median(half.to_vec()));
        if earlier.is_empty() {
            halves[0] = halves[1];
        }
        halves.sort_by(f64::total_cmp);
        halves
    }
}

impl std::fmt::Display for Ratios {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let low = self.0.iter().copied().fold(f64::INFINITY, f64::min);
        let high = self.0.iter().copied().fold(0.0, f64::max);
        write!(f, "{} [{}..{}]", digits(self.median()), digits(low), digits(high))
    }
}

/// A number with three significant digits.
pub fn digits(x: f64) -> String {
    let decimals = match x.abs() {
        x if x >= 100.0 => 0,
        x if x >= 10.0 => 1,
        x if x >= 1.0 => 2,
        _ => 3,
    };
    format!("{x:.decimals$}")
}

/// Median of numbers; NaN for none.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(passes: &[f64]) -> Times {
        Times { items: 1.0, passes: passes.iter().map(|&pass| [pass, 2.0 * pass]).collect() }
    }

    #[test]
    fn ratios_are_those_of_the_same_round() {
        let (mine, theirs) = (times(&[1.0, 6.0, 2.0]), times(&[2.0, 2.0, 8.0]));
        assert_eq!(mine.over(&theirs, Clock::Thread).to_string(), "0.500 [0.250..3.00]");
        assert_eq!((mine.min(Clock::Thread), mine.median(Clock::Wall)), (1.0, 4.0));
    }

    #[test]
    fn halves_are_those_of_the_rounds() {
        let ratios = |passes: &[f64]| times(passes).over(&times(&vec![1.0; passes.len()]), Clock::Thread);
        assert_eq!(ratios(&[5.0, 3.0, 4.0, 1.0, 1.0, 2.0]).halves(), [1.0, 4.0]);
        assert_eq!(ratios(&[7.0]).halves(), [7.0, 7.0]);
    }

    #[test]
    fn numbers_have_three_digits() {
        assert_eq!(
            [0.01234, 1.234, 12.34, 123.4, 12345.6].map(digits),
            ["0.012", "1.23", "12.3", "123", "12346"]
        );
    }
}
