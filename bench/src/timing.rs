//! Times of passes, and what is told of them. Processor time of the thread, so that a pass is not charged for the
//! time that other programs had the core; what they do to its caches is still in it.

use cpu_time::ThreadTime;

/// Times of equal passes, µs per frame.
#[derive(Default)]
pub struct Times(Vec<f64>);

impl Times {
    /// Runs `pass` and keeps its time, shared among `frames`.
    pub fn run(&mut self, frames: usize, pass: impl FnOnce()) {
        let start = ThreadTime::now();
        pass();
        self.0.push(start.elapsed().as_secs_f64() * 1e6 / frames as f64);
    }

    /// The shortest pass.
    pub fn min(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The middle pass.
    pub fn median(&self) -> f64 {
        median(&self.0)
    }

    /// Ratios to another's passes of the same rounds.
    pub fn over(&self, other: &Times) -> Ratios {
        Ratios(self.0.iter().zip(&other.0).map(|(mine, theirs)| mine / theirs).collect())
    }
}

/// Ratios of passes that ran next to each other.
pub struct Ratios(Vec<f64>);

impl std::fmt::Display for Ratios {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let low = self.0.iter().copied().fold(f64::INFINITY, f64::min);
        let high = self.0.iter().copied().fold(0.0, f64::max);
        write!(f, "{:.3} [{low:.3}..{high:.3}]", median(&self.0))
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}
