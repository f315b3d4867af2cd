//! W7: many Objects, all paired, none touching: cost of empty results.

use pong_bench::cloud::{self, FRAMES};
use pong_bench::heap;
use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::race::{Outcome, Race};
use pong_bench::rig;
use pong_bench::scenes::Scene;
use pong_bench::table::{Table, min_and_median, or_dash, ratio_at_most};
use pong_bench::timing::{Clock, Ratios};
use pong_engine::WorldBuilder;
use std::error::Error;

#[global_allocator]
static HEAP: heap::Counting = heap::Counting;

const MICRO: f64 = 1e-6;
const MEBIBYTE: f64 = 1024.0 * 1024.0;
const COUNTS: [usize; 3] = [100, 300, 1000];
/// Most rounds of the largest scene: a pass of it takes seconds.
const ROUNDS_OF_LARGEST: usize = 2;
/// Target time, relative to MuJoCo's.
const OVER_MUJOCO: f64 = 1.0;

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(10)?;
    let mut table =
        Table::new(&["spheres", "pairs", "Pong", "MuJoCo", "Pong over", "wanted", "Pong's world, MiB"]);
    for &count in &COUNTS[..if options.smoke { 1 } else { COUNTS.len() }] {
        let states = cloud::states(count);
        let mut all: Vec<(&str, Box<dyn Peer>)> = Vec::new();
        let scene = Scene::cloud(count)?;
        let before = heap::held();
        let rig = scene.rig(WorldBuilder::new(rig::config(1)))?;
        let memory = (heap::held() - before) as f64 / MEBIBYTE;
        all.push(("Pong", Box::new(rig)));
        #[cfg(feature = "mujoco")]
        if !options.alone {
            all.push(("MuJoCo", Box::new(pong_bench::peer::mujoco::Mujoco::cloud(count))));
        }
        let found = |peer: &mut dyn Peer| states.iter().map(|states| peer.frame(states)).sum::<usize>();
        if all.iter_mut().any(|(_, peer)| found(&mut **peer) > 0) {
            return Err(format!("{count} spheres: some touch").into());
        }
        let mut race = Race::new();
        for (name, peer) in &mut all {
            race.enter(name, || states.iter().for_each(|s| _ = std::hint::black_box(peer.frame(s))));
        }
        let rounds = if count == COUNTS[2] { options.rounds.min(ROUNDS_OF_LARGEST) } else { options.rounds };
        table.row(row(count, memory, &race.run(rounds, FRAMES)));
    }
    println!(
        "µs per frame, shortest / middle of {} passes, of {ROUNDS_OF_LARGEST} with a thousand spheres\n",
        options.rounds
    );
    println!("{table}");
    Ok(())
}

fn row(count: usize, memory: f64, outcome: &Outcome) -> Vec<String> {
    let told = |who| min_and_median(outcome.of(who), Clock::Thread, MICRO);
    let over = outcome.ratio("Pong", "MuJoCo", Clock::Thread);
    let verdict = ratio_at_most(OVER_MUJOCO, over.as_ref().map(Ratios::halves));
    let pairs = count * (count - 1) / 2;
    vec![
        count.to_string(),
        pairs.to_string(),
        told("Pong"),
        told("MuJoCo"),
        or_dash(over),
        verdict,
        format!("{memory:.1}"),
    ]
}
