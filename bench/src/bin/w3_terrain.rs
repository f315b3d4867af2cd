//! W3: six wheels on a bumpy terrain of a thousand to a million triangles.

use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::peer::parry::Manifolds;
use pong_bench::race::{Outcome, Race};
use pong_bench::scenes;
use pong_bench::table::{Table, min_and_median, or_dash, ratio_at_most};
use pong_bench::terrain::{self, Terrain, WHEELS, Wheel};
use pong_bench::timing::{Clock, Ratios, median};
use pong_engine::State;
use std::error::Error;
use std::hint::black_box;

const MICRO: f64 = 1e-6;
/// Target time, relative to that on the smallest terrain.
const OVER_SMALLEST: f64 = 1.2;
/// Warm-up passes: the caches of a mesh of a million triangles and its tree refill slowly.
const WARM_UPS: usize = 4;

/// Target time, relative to the best peer's.
fn over_best(wheel: Wheel) -> f64 {
    match wheel {
        Wheel::Sphere { .. } => 0.8,
        Wheel::Ellipsoid { .. } => 0.2,
    }
}
const PEERS: [&str; 3] = ["parry", "MuJoCo", "ODE"];

type Named = (String, Box<dyn Peer>);

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let sizes = &Terrain::SIZES[..if options.smoke { 2 } else { 4 }];
    println!(
        "µs per frame of six wheels, shortest / middle of {} passes, {WARM_UPS} to warm up before each\n",
        options.rounds
    );
    let mut depths = Table::new(&["wheels", "peer", "greatest difference, mm", "middle one, mm"]);
    for (_, wheel) in Wheel::BOTH.into_iter().enumerate().filter(|(number, _)| options.wants(*number)) {
        println!("{}", run(sizes, wheel, &options, &mut depths)?);
    }
    println!("Depth of the deepest contact of a frame, from Pong's on the largest terrain\n");
    println!("{depths}");
    Ok(())
}

/// Runs every size and every engine in the same rounds, because sizes are compared too.
fn run(
    sizes: &[Terrain],
    wheel: Wheel,
    options: &Options,
    depths: &mut Table,
) -> Result<Table, Box<dyn Error>> {
    let states = terrain::states(if options.smoke { 4 } else { 64 }, wheel);
    let mut all: Vec<Named> = Vec::new();
    for terrain in sizes {
        let name = |who: &str| format!("{who} {}", terrain.count());
        all.push((name("Pong"), Box::new(scenes::wheels(terrain, wheel)?)));
        if !options.alone {
            all.extend(peers(terrain, wheel).into_iter().map(|(who, peer)| (name(who), peer)));
        }
    }
    let contacts = contacts(&mut all, &states)?;
    let each = all.len() / sizes.len();
    compare_depths(all.rchunks_mut(each).next().unwrap_or_default(), wheel, &states, depths);
    let mut race = Race::with_warm_ups(if options.smoke { 1 } else { WARM_UPS });
    for (name, peer) in &mut all {
        race.enter(name, || states.iter().for_each(|states| _ = black_box(peer.frame(states))));
    }
    Ok(table(sizes, wheel, &contacts, &race.run(options.rounds, states.len())))
}

fn peers(terrain: &Terrain, wheel: Wheel) -> Vec<(&'static str, Box<dyn Peer>)> {
    let mut peers: Vec<(_, Box<dyn Peer>)> = Vec::new();
    if let Some(parry) = Manifolds::terrain(terrain, wheel, WHEELS) {
        peers.push(("parry", Box::new(parry)));
    }
    #[cfg(feature = "mujoco")]
    peers.push(("MuJoCo", Box::new(pong_bench::peer::mujoco::Mujoco::terrain(terrain, wheel, WHEELS))));
    #[cfg(feature = "ode")]
    if let Some(ode) = pong_bench::peer::ode::OdeTerrain::new(terrain, wheel) {
        peers.push(("ODE", Box::new(ode)));
    }
    peers
}

/// Distance of each peer's deepest contact from ours, which comes first.
fn compare_depths(all: &mut [Named], wheel: Wheel, states: &[Vec<State>], depths: &mut Table) {
    const MILLI: f64 = 1e-3;
    let of_all = all.iter_mut().map(|(_, peer)| {
        let of_frame = |states: &Vec<State>| {
            peer.frame(states);
            peer.deepest().unwrap_or(f64::NAN)
        };
        states.iter().map(of_frame).collect::<Vec<_>>()
    });
    let of_all: Vec<Vec<f64>> = of_all.collect();
    for ((name, _), theirs) in all.iter().zip(&of_all).skip(1) {
        let apart: Vec<f64> = theirs.iter().zip(&of_all[0]).map(|(a, b)| (a - b).abs() / MILLI).collect();
        let greatest = apart.iter().copied().fold(0.0, f64::max);
        let numbers = [greatest, median(apart)].map(|apart| format!("{apart:.1e}"));
        let names = [format!("{}s", wheel.name()), name.clone()];
        depths.row(names.into_iter().chain(numbers));
    }
}

/// Contacts per frame of every engine: the number is its own choice, but zero is wrong.
fn contacts(all: &mut [Named], states: &[Vec<State>]) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut out = Vec::new();
    for (name, peer) in all {
        let found: usize = states.iter().map(|states| peer.frame(states)).sum();
        if found == 0 {
            return Err(format!("{name}: no wheel touches").into());
        }
        out.push(found as f64 / states.len() as f64);
    }
    Ok(out)
}

fn table(sizes: &[Terrain], wheel: Wheel, contacts: &[f64], outcome: &Outcome) -> Table {
    let mut head = vec![format!("{}s, triangles", wheel.name()), "Pong".to_owned()];
    head.extend(PEERS.map(str::to_owned));
    head.extend(
        ["contacts, in that order", "Pong over best", "wanted", "over the smallest", "wanted"]
            .map(str::to_owned),
    );
    let mut table = Table::new(&head.iter().map(String::as_str).collect::<Vec<_>>());
    let (each, wanted) = (contacts.len() / sizes.len(), over_best(wheel));
    for (terrain, contacts) in sizes.iter().zip(contacts.chunks(each)) {
        let name = |who: &str| format!("{who} {}", terrain.count());
        let ours = name("Pong");
        let time = |who: &str| outcome.of(&name(who)).map(|times| times.min(Clock::Thread));
        let best = PEERS.into_iter().filter(|who| time(who).is_some());
        let best = best.min_by(|a, b| time(a).unwrap_or(0.0).total_cmp(&time(b).unwrap_or(0.0)));
        let ratio_best = best.and_then(|who| Some((who, outcome.ratio(&ours, &name(who), Clock::Thread)?)));
        let smallest = format!("Pong {}", sizes[0].count());
        let mut row = vec![terrain.count().to_string()];
        let everyone = std::iter::once("Pong").chain(PEERS);
        row.extend(everyone.map(|who| min_and_median(outcome.of(&name(who)), Clock::Thread, MICRO)));
        row.push(contacts.iter().map(|n| format!("{n:.1}")).collect::<Vec<_>>().join(", "));
        row.push(or_dash(ratio_best.as_ref().map(|(who, ratio)| format!("{who}: {ratio}"))));
        row.push(ratio_at_most(wanted, ratio_best.as_ref().map(|(_, ratio)| ratio.halves())));
        let over_smallest = outcome.ratio(&ours, &smallest, Clock::Thread);
        row.push(or_dash(over_smallest.as_ref()));
        row.push(ratio_at_most(OVER_SMALLEST, over_smallest.as_ref().map(Ratios::halves)));
        table.row(row);
    }
    table
}
