//! Processor time of the thread as criterion's clock: time in which another program had the core does not
//! count.

use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use pong_bench::timing::median;

/// Clock in ns, so that a time can be divided among the queries or frames of a pass.
pub struct ThreadTime;

impl Measurement for ThreadTime {
    type Intermediate = cpu_time::ThreadTime;
    type Value = f64;

    fn start(&self) -> Self::Intermediate {
        cpu_time::ThreadTime::now()
    }

    fn end(&self, start: Self::Intermediate) -> f64 {
        start.elapsed().as_nanos() as f64
    }

    fn add(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }

    fn zero(&self) -> f64 {
        0.0
    }

    fn to_f64(&self, value: &f64) -> f64 {
        *value
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        // It takes ns.
        WallTime.formatter()
    }
}

/// Median of passes that return their own time, times their number, ns. For wall-clock times: a pass
/// interrupted by another program does not count.
pub fn middle_of(passes: u64, mut pass: impl FnMut() -> f64) -> f64 {
    median((0..passes).map(|_| pass()).collect()) * passes as f64
}

/// Time of `passes` calls, divided by the items of a pass, ns.
pub fn per_item(passes: u64, items: usize, mut pass: impl FnMut()) -> f64 {
    let start = ThreadTime.start();
    (0..passes).for_each(|_| pass());
    ThreadTime.end(start) / items as f64
}
