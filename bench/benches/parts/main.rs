//! Separate benchmarks of every part of the engine, by criterion: `bash bench/run criterion [NAME PART]
//! [OPTIONS OF CRITERION]`.

mod bounding;
mod calls;
mod clock;
mod stages;
mod testers;

use clock::ThreadTime;
use criterion::Criterion;
use std::error::Error;
use std::time::Duration;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default()
        .with_measurement(ThreadTime)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .sample_size(30)
        .nresamples(20_000)
        .configure_from_args();
    testers::all(&mut criterion);
    bounding::all(&mut criterion)?;
    stages::all(&mut criterion)?;
    calls::all(&mut criterion)?;
    criterion.final_summary();
    Ok(())
}
