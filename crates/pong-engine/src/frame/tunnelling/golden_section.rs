//! Golden-section search for a time at which two bodies overlap.

/// A time between `low` and `high` at which `gap` is negative, by golden-section search for its least value; `None` if
/// that is not negative. `gap` should have one minimum there.
pub(super) fn time_inside([mut low, mut high]: [f64; 2], gap: impl Fn(f64) -> f64) -> Option<f64> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    const STEPS: usize = 40;
    let time = |low: f64, high: f64, share: f64| low + (high - low) * share;
    let mut inner = [1.0 - GOLDEN, GOLDEN].map(|share| time(low, high, share));
    let mut gaps = inner.map(&gap);
    for _ in 0..STEPS {
        let least = usize::from(gaps[1] < gaps[0]);
        if gaps[least] < 0.0 {
            return Some(inner[least]);
        }
        if least == 0 {
            high = inner[1];
            inner = [time(low, high, 1.0 - GOLDEN), inner[0]];
            gaps = [gap(inner[0]), gaps[0]];
        } else {
            low = inner[0];
            inner = [inner[1], time(low, high, GOLDEN)];
            gaps = [gaps[1], gap(inner[1])];
        }
    }
    None
}
