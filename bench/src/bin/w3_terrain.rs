//! W3: six wheels on a bumpy terrain of a thousand to a million triangles.

use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::peer::parry::Manifolds;
use pong_bench::race::{Outcome, Race};
use pong_bench::scenes;
use pong_bench::table::{Table, at_most, min_and_median, or_dash};
use pong_bench::terrain::{self, Terrain, WHEELS, Wheel};
use pong_bench::timing::Clock;
use pong_engine::State;
use std::error::Error;
use std::hint::black_box;

const MICRO: f64 = 1e-6;
/// Greatest time as a share of the best peer's, and over that on the smallest terrain.
const OVER_BEST: f64 = 1.0 / 3.0;
const OVER_SMALLEST: f64 = 1.2;
const PEERS: [&str; 3] = ["parry", "MuJoCo", "ODE"];

type Named = (String, Box<dyn Peer>);

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let sizes = &Terrain::SIZES[..if options.smoke { 2 } else { 4 }];
    println!("µs per frame of six wheels, shortest / middle of {} passes\n", options.rounds);
    for (_, wheel) in Wheel::BOTH.into_iter().enumerate().filter(|(number, _)| options.wants(*number)) {
        println!("{}", run(sizes, wheel, &options)?);
    }
    Ok(())
}

/// Every size and every engine in the same rounds: sizes are compared too.
fn run(sizes: &[Terrain], wheel: Wheel, options: &Options) -> Result<Table, Box<dyn Error>> {
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
    let mut race = Race::new();
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

/// Contacts per frame of everyone: how many is each engine's own choice, but none is wrong.
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
    let each = contacts.len() / sizes.len();
    for (terrain, contacts) in sizes.iter().zip(contacts.chunks(each)) {
        let name = |who: &str| format!("{who} {}", terrain.count());
        let ours = name("Pong");
        let time = |who: &str| outcome.of(&name(who)).map(|times| times.min(Clock::Thread));
        let best = PEERS.into_iter().filter(|who| time(who).is_some());
        let best = best.min_by(|a, b| time(a).unwrap_or(0.0).total_cmp(&time(b).unwrap_or(0.0)));
        let over_best = best.and_then(|who| Some((who, outcome.ratio(&ours, &name(who), Clock::Thread)?)));
        let smallest = format!("Pong {}", sizes[0].count());
        let mut row = vec![terrain.count().to_string()];
        let everyone = std::iter::once("Pong").chain(PEERS);
        row.extend(everyone.map(|who| min_and_median(outcome.of(&name(who)), Clock::Thread, MICRO)));
        row.push(contacts.iter().map(|n| format!("{n:.1}")).collect::<Vec<_>>().join(", "));
        row.push(or_dash(over_best.as_ref().map(|(who, ratio)| format!("{who}: {ratio}"))));
        row.push(at_most(OVER_BEST, over_best.map(|(_, ratio)| ratio.median())));
        let over_smallest = outcome.ratio(&ours, &smallest, Clock::Thread);
        row.push(or_dash(over_smallest.as_ref()));
        row.push(at_most(OVER_SMALLEST, over_smallest.map(|ratio| ratio.median())));
        table.row(row);
    }
    table
}
