//! Single frames timed by the wall clock, for effects that a mean over a pass would hide.

use std::hint::black_box;
use std::time::Instant;

/// Bytes touched between frames, to evict all data of a frame from the caches.
const OTHERS_BYTES: usize = 96 << 20;
const CACHE_LINE: usize = 64;

/// Cache pollution by the rest of a simulation between two frames.
pub struct Others(Vec<u8>);

impl Default for Others {
    fn default() -> Self {
        Self(vec![1; OTHERS_BYTES])
    }
}

impl Others {
    /// Reads and writes a byte in every cache line.
    pub fn work(&mut self) {
        for byte in self.0.iter_mut().step_by(CACHE_LINE) {
            *byte = byte.wrapping_mul(3).wrapping_add(1);
        }
        black_box(&self.0);
    }
}

/// Duration of some work, s.
pub fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Quantile 0…1 of numbers in any order; the greatest at 1.
pub fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let index = ((values.len() as f64 * share) as usize).min(values.len().saturating_sub(1));
    values.get(index).copied().unwrap_or(f64::NAN)
}

/// Medians of the earlier and of the later half of the measurements, the smaller first. Sorts each half.
pub fn middles_of_halves(values: &mut [f64]) -> [f64; 2] {
    let (earlier, later) = values.split_at_mut(values.len() / 2);
    let [a, b] = [earlier, later].map(|half| quantile(half, 0.5));
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values() {
        let mut values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!([0.0, 0.5, 0.99, 1.0].map(|share| quantile(&mut values, share)), [1.0, 3.0, 4.0, 4.0]);
    }
}
