//! W9: latency: a frame of the ring (48, 1000) once a millisecond: alone, with a worker, with a worker woken
//! shortly before, and with a rehearsal, in which the previous frame is evaluated again to warm the caches.

use pong_bench::one_by_one::{middles_of_halves, quantile, seconds};
use pong_bench::options::Options;
use pong_bench::rig::{Rig, bind_caller};
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::scenes;
use pong_bench::table::{Table, ratio_at_most};
use pong_bench::timing::digits;
use pong_engine::State;
use std::error::Error;
use std::hint::black_box;
use std::ops::Range;
use std::time::{Duration, Instant};

const MICRO: f64 = 1e-6;
const PERIOD: Duration = Duration::from_millis(1);
/// Lead time: long enough to wake a sleeping worker, short against a frame.
const AHEAD: Duration = Duration::from_micros(100);

/// Frames of one world before those of the next, so that disturbances by the machine affect all alike.
const TURN: u32 = 250;

/// One way to run the frames.
struct Way {
    name: &'static str,
    rig: Rig,
    prewake: bool,
    /// True if the present states are evaluated shortly before the frame.
    rehearse: bool,
    /// Times by frame, s.
    times: Vec<f64>,
    late: u32,
}

fn main() -> Result<(), Box<dyn Error>> {
    // A round is a second of each way.
    let options = Options::read(60)?;
    let frames = if options.smoke { 50 } else { 1000 * u32::try_from(options.rounds)? };
    let ring = Ring::new(ring::SIZES[1]);
    let states = scenes::ring_states();
    let way = |name, threads, prewake, rehearse| -> Result<Way, Box<dyn Error>> {
        let rig = scenes::ring(&ring, Tip::Sphere, threads)?;
        Ok(Way { name, rig, prewake, rehearse, times: Vec::with_capacity(frames as usize), late: 0 })
    };
    let mut ways = [
        way("alone", 1, false, false)?,
        way("with a worker", 2, false, false)?,
        way("with a worker, woken 0.1 ms before", 2, true, false)?,
        way("alone, rehearsed 0.1 ms before", 1, false, true)?,
        way("with a worker, woken and rehearsed 0.1 ms before", 2, true, true)?,
    ];
    bind_caller();
    for first in (0..frames).step_by(TURN as usize) {
        for way in &mut ways {
            way.run(first..frames.min(first + TURN), &states);
        }
    }
    println!("Ring of 48 wedges and 1,000 spheres at 1 kHz, {frames} frames each, in turns of {TURN}\n");
    println!("{}", told(&mut ways));
    Ok(())
}

impl Way {
    fn run(&mut self, numbers: Range<u32>, states: &[Vec<State>]) {
        let mut release = Instant::now();
        for frame in numbers {
            release += PERIOD;
            sleep_until(release - AHEAD);
            if self.prewake {
                self.rig.world.prewake(2 * AHEAD);
            }
            if self.rehearse && frame > 0 {
                self.rig.world.evaluate().expect("the states of the last frame");
            }
            while Instant::now() < release {
                std::hint::spin_loop();
            }
            let states = &states[frame as usize % states.len()];
            self.times.push(seconds(|| _ = black_box(self.rig.step(states))));
            self.late += u32::from(release.elapsed() > PERIOD);
        }
        self.rig.world.quiesce();
    }

    /// Median frame of every turn, s.
    fn middles(&self) -> Vec<f64> {
        self.times.chunks(TURN as usize).map(|turn| quantile(&mut turn.to_vec(), 0.5)).collect()
    }
}

fn told(ways: &mut [Way; 5]) -> Table {
    let mut table = Table::new(&[
        "frame of Pong, µs",
        "p50",
        "p99",
        "p99.9",
        "greatest",
        "late for the next",
        "p50 over alone",
        "wanted",
    ]);
    let alone = ways[0].middles();
    for way in ways {
        // Turn by turn: disturbances by the machine change within seconds.
        let mut ratios: Vec<f64> = way.middles().iter().zip(&alone).map(|(own, alone)| own / alone).collect();
        let halves = middles_of_halves(&mut ratios);
        let told = [0.5, 0.99, 0.999, 1.0].map(|share| digits(quantile(&mut way.times, share) / MICRO));
        let wanted = match way {
            Way { name: "alone", .. } | Way { rehearse: true, .. } => "–".to_owned(),
            _ => ratio_at_most(1.0, Some(halves)),
        };
        let row = [way.name.to_owned()].into_iter().chain(told);
        let late = format!("{} of {}", way.late, way.times.len());
        table.row(row.chain([late, digits(quantile(&mut ratios, 0.5)), wanted]));
    }
    table
}

fn sleep_until(time: Instant) {
    let now = Instant::now();
    if time > now {
        std::thread::sleep(time - now);
    }
}
