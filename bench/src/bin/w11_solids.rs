//! W11: one pair of convex solids, from two poses to all its contacts, at the poses of `peers/solids_pairs.json`.

use pong_bench::options::Options;
use pong_bench::peer::parry::Manifolds;
use pong_bench::race::Race;
use pong_bench::random::Random;
use pong_bench::solids::{Case, File, Frame, Shape, SolidsPeer, Volume};
use pong_bench::table::{Table, at_most, min_and_median};
use pong_bench::timing::Clock;
use std::error::Error;
use std::hint::black_box;

const PAIRS: usize = 1024;
const MICRO: f64 = 1e-6;
const COLUMNS: [&str; 5] = ["Pong, volume", "Pong, frame", "parry", "MuJoCo", "ODE"];

type Named = (&'static str, Box<dyn SolidsPeer>);

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let file = File::read()?;
    let count = if options.smoke { 64 } else { PAIRS };
    let mut table = Table::new(&[&["pair"][..], &COLUMNS, &["pairs that touch", "wanted"]].concat());
    for (_, case) in file.cases.iter().enumerate().filter(|(number, _)| options.wants(*number)) {
        table.row(row(case, file.shape(case), count, &options)?);
    }
    println!("W11, µs per pair, shortest / middle of {} passes over {count} pairs\n", options.rounds);
    println!("{table}");
    Ok(())
}

fn row(case: &Case, shape: &Shape, count: usize, options: &Options) -> Result<Vec<String>, Box<dyn Error>> {
    let mut all = engines(shape, options)?;
    let pairs = case.pairs(count, &mut Random(0x5011d));
    let mut touching = Vec::new();
    for (name, engine) in &mut all {
        let found = engine.pass(&pairs);
        touching.push(found.to_string());
        // The others may miss what they define otherwise; Pong may not.
        if name.starts_with("Pong") && found != if case.overlap { count } else { 0 } {
            return Err(format!("{}: {name} finds {found} of {count} pairs touching", case.name).into());
        }
    }
    touching.dedup();
    let mut race = Race::new();
    for (name, engine) in &mut all {
        let pairs = &pairs;
        race.enter(name, move || _ = black_box(engine.pass(pairs)));
    }
    let outcome = race.run(options.rounds, count);
    let told = COLUMNS.iter().map(|name| min_and_median(outcome.of(name), Clock::Thread, MICRO));
    let shortest = outcome.of(COLUMNS[0]).map_or(f64::NAN, |times| times.min(Clock::Thread) / MICRO);
    let wanted = wanted(&case.name).map_or("–".to_owned(), |wanted| at_most(wanted, shortest));
    Ok(std::iter::once(case.name.clone()).chain(told).chain([touching.join(", "), wanted]).collect())
}

/// Target time of Pong's volume, µs.
fn wanted(case: &str) -> Option<f64> {
    match case {
        "box, face on face" => Some(2.0),
        "box, apart" | "hull 12, apart" | "hull 32, apart" => Some(0.05),
        "hull 12, face on face" | "hull 12, corner on face" => Some(4.0),
        "hull 32, face on face" | "hull 32, corner on face" => Some(15.0),
        _ => None,
    }
}

fn engines(shape: &Shape, options: &Options) -> Result<Vec<Named>, Box<dyn Error>> {
    let model = shape.model()?;
    let mut all: Vec<Named> =
        vec![(COLUMNS[0], Box::new(Volume::new(model.clone()))), (COLUMNS[1], Box::new(Frame::new(model)?))];
    if !options.alone {
        all.push((COLUMNS[2], Box::new(Manifolds::solids(shape))));
        #[cfg(feature = "mujoco")]
        all.push((COLUMNS[3], Box::new(pong_bench::peer::mujoco::MujocoSolids::new(shape))));
        #[cfg(feature = "ode")]
        all.push((COLUMNS[4], Box::new(pong_bench::peer::ode::OdeSolids::new(shape))));
    }
    Ok(all)
}
