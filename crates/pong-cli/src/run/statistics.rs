//! Statistics for the summary of a run: those of the executive, step times, contacts that act together.

use super::acting::Acting;
use pong_executive::scene::BuiltScene;
use pong_executive::{RunStatistics, Simulation};
use std::time::Duration;

/// Most step times that are kept; of longer runs every second, third … is kept.
const TIMES_KEPT: u64 = 1_000_000;

/// Statistics of a run and its duration.
pub(super) struct Statistics {
    pub run: RunStatistics,
    times_ns: Vec<u64>,
    every: u64,
    steps: u64,
    /// Contacts that act together, on request.
    pub acting: Option<Acting>,
}

impl Statistics {
    /// Statistics of a scene before its first instant. With `acting`, the step is checked against contacts
    /// that act together.
    pub fn new(built: &BuiltScene, acting: bool) -> Self {
        Self {
            run: RunStatistics::new(&built.simulation),
            times_ns: Vec::new(),
            every: built.steps.div_ceil(TIMES_KEPT).max(1),
            steps: 0,
            acting: acting.then(|| Acting::new(built.simulation.step_plan())),
        }
    }

    /// Records the first instant.
    pub fn start(&mut self, simulation: &Simulation) {
        self.run = RunStatistics::new(simulation);
        self.acting.iter_mut().for_each(|acting| acting.observe(simulation));
    }

    /// Records the time of a step.
    pub fn took(&mut self, time: Duration) {
        if self.steps.is_multiple_of(self.every) {
            self.times_ns.push(time.as_nanos() as u64);
        }
        self.steps += 1;
    }

    /// Records an instant.
    pub fn observe(&mut self, simulation: &Simulation) {
        self.run.observe(simulation);
        self.acting.iter_mut().for_each(|acting| acting.observe(simulation));
    }

    /// Median, 99th percentile and longest step, in microseconds; `None` before the first.
    pub fn step_times_us(&self) -> Option<[f64; 3]> {
        let mut sorted = self.times_ns.clone();
        sorted.sort_unstable();
        let last = sorted.len().checked_sub(1)?;
        let at = |share: f64| sorted[(share * last as f64).round() as usize] as f64 * 1e-3;
        Some([at(0.5), at(0.99), at(1.0)])
    }
}
