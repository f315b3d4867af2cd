//! W9: latency: a frame of the ring (48, 1000) once a millisecond, alone, with a worker, and with a worker that is woken
//! shortly before.

use pong_bench::one_by_one::{quantile, seconds};
use pong_bench::options::Options;
use pong_bench::rig::bind_caller;
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::scenes;
use pong_bench::table::Table;
use pong_bench::timing::digits;
use std::error::Error;
use std::hint::black_box;
use std::time::{Duration, Instant};

const MICRO: f64 = 1e-6;
const PERIOD: Duration = Duration::from_millis(1);
/// Long enough for a sleeping worker to be up, short against a frame.
const AHEAD: Duration = Duration::from_micros(100);
const SECONDS: u32 = 60;

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(1)?;
    let frames = if options.smoke { 50 } else { 1000 * SECONDS };
    let ring = Ring::new(ring::SIZES[1]);
    let states = scenes::ring_states();
    let mut table =
        Table::new(&["frame of Pong, µs", "p50", "p99", "p99.9", "greatest", "late for the next"]);
    for (name, threads, prewake) in
        [("alone", 1, false), ("with a worker", 2, false), ("with a worker, woken 0.1 ms before", 2, true)]
    {
        let mut rig = scenes::ring(&ring, Tip::Sphere, threads)?;
        bind_caller();
        let (mut times, mut late) = (Vec::with_capacity(frames as usize), 0);
        let mut release = Instant::now();
        for frame in 0..frames {
            release += PERIOD;
            sleep_until(release - AHEAD);
            if prewake {
                rig.world.prewake(2 * AHEAD);
            }
            while Instant::now() < release {
                std::hint::spin_loop();
            }
            let states = &states[frame as usize % states.len()];
            times.push(seconds(|| _ = black_box(rig.step(states))));
            late += u32::from(release.elapsed() > PERIOD);
        }
        let told = [0.5, 0.99, 0.999, 1.0].map(|share| digits(quantile(&mut times, share) / MICRO));
        table.row([name.to_owned()].into_iter().chain(told).chain([format!("{late} of {frames}")]));
    }
    println!("Ring of 48 wedges and 1,000 spheres at 1 kHz, {} frames each\n", frames);
    println!("{table}");
    Ok(())
}

fn sleep_until(time: Instant) {
    let now = Instant::now();
    if time > now {
        std::thread::sleep(time - now);
    }
}
