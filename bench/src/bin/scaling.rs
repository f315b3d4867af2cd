//! Growth of a frame's time with threads, triangles and points. Writes a table of numbers and a plot.

use pong_bench::floor::ring::ByHand;
use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::peer::parry::{Loop, Manifolds};
use pong_bench::plot::{Panel, svg};
use pong_bench::race::Race;
use pong_bench::rig::{self, bind_caller};
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::scenes::{self, ring_states};
use pong_bench::table::{Table, or_dash};
use pong_bench::terrain::{self, Terrain, WHEELS, Wheel};
use pong_bench::timing::{Clock, digits};
use pong_engine::State;
use std::error::Error;
use std::fmt::Write as _;
use std::hint::black_box;
use std::path::PathBuf;

/// One engine at one point of an axis.
struct Entry {
    line: String,
    at: f64,
    peer: Box<dyn Peer>,
    states: Vec<Vec<State>>,
}

/// Engines at the points of an axis.
type Entries = fn(bool) -> Result<Vec<Entry>, Box<dyn Error>>;

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(20)?;
    let into = options.into.clone().unwrap_or_else(|| PathBuf::from("."));
    let smoke = options.smoke;
    let all: [(_, _, Entries); 3] = [
        ("threads", Clock::Wall, threads),
        ("triangles", Clock::Thread, triangles),
        ("points", Clock::Thread, points),
    ];
    let mut axes = Vec::new();
    for (number, (axis, clock, entries)) in all.into_iter().enumerate() {
        if options.wants(number) {
            axes.push((axis, clock, entries(smoke)?));
        }
    }
    // All worker pools have started, with all cores available to them.
    bind_caller();
    let (mut panels, mut numbers) = (Vec::new(), String::from("axis,line,at,least_us,middle_us\n"));
    println!("µs per frame, shortest of {} passes\n", options.rounds);
    for (axis, clock, entries) in axes {
        let mut panel = Panel { x: axis, lines: Vec::new() };
        for (line, at, least, middle) in measure(entries, clock, options.rounds) {
            writeln!(numbers, "{axis},{line},{at},{least:.3},{middle:.3}")?;
            match panel.lines.iter_mut().find(|(known, _)| *known == line) {
                Some((_, points)) => points.push((at, least)),
                None => panel.lines.push((line, vec![(at, least)])),
            }
        }
        println!("{}", table(&panel));
        panels.push(panel);
    }
    if !smoke {
        std::fs::write(into.join("performance_scaling.csv"), numbers)?;
        std::fs::write(into.join("performance_scaling.svg"), svg(&panels, "µs per frame"))?;
    }
    Ok(())
}

/// Line, x value, shortest and median pass in µs per frame; all in the same rounds.
fn measure(mut entries: Vec<Entry>, clock: Clock, rounds: usize) -> Vec<(String, f64, f64, f64)> {
    let frames = entries[0].states.len();
    let mut race = Race::new();
    for Entry { line, peer, states, .. } in &mut entries {
        race.enter(line, || states.iter().for_each(|states| _ = black_box(peer.frame(states))));
    }
    let outcome = race.run(rounds, frames);
    let told =
        outcome.0.into_iter().zip(&entries).map(|((line, times), entry)| {
            (line, entry.at, times.min(clock) * 1e6, times.median(clock) * 1e6)
        });
    told.collect()
}

/// One row per x value, one column per line.
fn table(panel: &Panel) -> Table {
    let head: Vec<&str> =
        std::iter::once(panel.x).chain(panel.lines.iter().map(|(line, _)| line.as_str())).collect();
    let mut table = Table::new(&head);
    let mut places: Vec<f64> = panel.lines.iter().flat_map(|(_, points)| points).map(|p| p.0).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    for at in places {
        let time = |points: &[(f64, f64)]| points.iter().find(|p| p.0 == at).map(|p| digits(p.1));
        let cells = panel.lines.iter().map(|(_, points)| or_dash(time(points)));
        table.row(std::iter::once(at.to_string()).chain(cells));
    }
    table
}

// ---- axes

/// From one thread to twice the number of cores, and to a minimum where cores are few.
fn threads(smoke: bool) -> Result<Vec<Entry>, Box<dyn Error>> {
    let cores = std::thread::available_parallelism()?.get();
    let counts: Vec<usize> = rig::thread_counts(if smoke { 2 } else { (2 * cores).max(16) }).collect();
    let mut out = Vec::new();
    for size in ring::sizes(smoke) {
        let ring = Ring::new(size);
        for &count in &counts {
            out.push(ring_entry(format!("Pong, ring of {} points", size.1), count as f64, &ring, count)?);
        }
    }
    Ok(out)
}

fn triangles(smoke: bool) -> Result<Vec<Entry>, Box<dyn Error>> {
    let mut out = Vec::new();
    for terrain in &Terrain::SIZES[..if smoke { 1 } else { 4 }] {
        for wheel in Wheel::BOTH {
            let (at, states) = (terrain.count() as f64, terrain::states(ring::FRAMES, wheel));
            let entry = |line: String, peer| Entry { line, at, peer, states: states.clone() };
            out.push(entry(
                format!("Pong, six {}s", wheel.name()),
                Box::new(scenes::wheels(terrain, wheel)?),
            ));
            if let Some(parry) = Manifolds::terrain(terrain, wheel, WHEELS) {
                out.push(entry("parry, six spheres, detection".to_owned(), Box::new(parry)));
            }
            #[cfg(feature = "ode")]
            if let Some(ode) = pong_bench::peer::ode::OdeTerrain::new(terrain, wheel) {
                out.push(entry("ODE, six spheres, detection".to_owned(), Box::new(ode)));
            }
        }
    }
    Ok(out)
}

fn points(smoke: bool) -> Result<Vec<Entry>, Box<dyn Error>> {
    let mut out = Vec::new();
    for count in if smoke { vec![100] } else { vec![100, 300, 1000, 3000, 10_000, 30_000] } {
        let ring = Ring::new((48, count));
        out.push(ring_entry("Pong, 48 wedges".to_owned(), count as f64, &ring, 1)?);
        let others: [(&str, Box<dyn Peer>); 2] = [
            ("parry, own loop, detection", Box::new(Loop::ring(&ring, Tip::Point))),
            ("floor, detection", Box::new(ByHand::new(&ring, Tip::Point))),
        ];
        for (line, peer) in others {
            out.push(Entry { line: line.to_owned(), at: count as f64, peer, states: ring_states() });
        }
    }
    Ok(out)
}

fn ring_entry(line: String, at: f64, ring: &Ring, threads: usize) -> Result<Entry, Box<dyn Error>> {
    Ok(Entry { line, at, peer: Box::new(scenes::ring(ring, Tip::Point, threads)?), states: ring_states() })
}
