//! W6: a frame of the berthing mechanism: segments, rays, points and spheres on polyhedra.

use pong_bench::berthing::FRAMES;
use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::race::Race;
use pong_bench::rig;
use pong_bench::scenes::Scene;
use pong_bench::table::{Table, min_and_median};
use pong_bench::timing::Clock;
use pong_engine::WorldBuilder;
use std::error::Error;

const MICRO: f64 = 1e-6;

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let scene = Scene::berthing()?;
    let mut rig = scene.rig(WorldBuilder::new(rig::config(1)))?;
    let (mut contacts, mut tests) = (0, 0);
    for states in &scene.states {
        contacts += rig.frame(states);
        tests += rig.world.counts().primitives_tested();
    }
    if contacts == 0 {
        return Err("berthing: nothing touches".into());
    }
    let mut race = Race::new();
    race.enter("Pong", || scene.states.iter().for_each(|states| _ = std::hint::black_box(rig.frame(states))));
    let outcome = race.run(options.rounds, FRAMES);
    let mut table = Table::new(&["scene", "µs per frame", "contacts", "pair tests"]);
    let per_frame = |count: f64| format!("{:.1}", count / FRAMES as f64);
    table.row([
        "berthing, 18 movable groups, 5 pairs of Objects".to_owned(),
        min_and_median(outcome.of("Pong"), Clock::Thread, MICRO),
        per_frame(contacts as f64),
        per_frame(tests as f64),
    ]);
    println!("Shortest / middle of {} passes\n", options.rounds);
    println!("{table}");
    Ok(())
}
