//! W10: fixed costs of a frame: empty, one contact, each further contact, many points in one convex body.
//! convex body.

use pong_bench::hull::Hull;
use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::race::Race;
use pong_bench::random::Random;
use pong_bench::rig;
use pong_bench::ron;
use pong_bench::scenes::Scene;
use pong_bench::table::{Table, min_and_median, ratio_at_most};
use pong_bench::timing::Clock;
use pong_engine::{State, WorldBuilder};
use std::error::Error;
use std::hint::black_box;

const MICRO: f64 = 1e-6;
const FRAMES: usize = 256;
const POINTS: usize = 512;
/// Spheres in the scene that measures the cost of a further contact.
const MANY: usize = 65;
/// Target for a frame of one contact, µs.
const ONE_CONTACT: f64 = 0.5;

const EMPTY: &str = "nothing near";
const ONE: &str = "one contact";
const FULL: &str = "65 contacts";
const HULL: &str = "512 points in one convex body of 12 faces";

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let scenes = [
        (EMPTY, Scene::spheres_on_plane(1, 1.0)?, 0),
        (ONE, Scene::spheres_on_plane(1, 0.0)?, 1),
        (FULL, Scene::spheres_on_plane(MANY, 0.0)?, MANY),
        (HULL, points_in_hull()?, POINTS),
    ];
    let mut race = Race::new();
    for (name, scene, contacts) in scenes {
        let mut rig = scene.rig(WorldBuilder::new(rig::config(1)))?;
        let states = scene.states[0].clone();
        let found = rig.frame(&states);
        if found != contacts {
            return Err(format!("{name}: {found} contacts, not {contacts}").into());
        }
        race.enter(name, move || (0..FRAMES).for_each(|_| _ = black_box(rig.frame(&states))));
    }
    let outcome = race.run(options.rounds, FRAMES);
    let mut table = Table::new(&["frame", "µs", "wanted"]);
    for name in [EMPTY, ONE, FULL, HULL] {
        let halves = outcome.of(name).map(|times| times.min_of_halves(Clock::Thread).map(|s| s / MICRO));
        let halves = halves.map(|[a, b]| [a.min(b), a.max(b)]);
        let wanted = if name == ONE { ratio_at_most(ONE_CONTACT, halves) } else { "–".to_owned() };
        table.row([name.to_owned(), min_and_median(outcome.of(name), Clock::Thread, MICRO), wanted]);
    }
    let shortest = |name| outcome.of(name).map_or(f64::NAN, |times| times.min(Clock::Thread) / MICRO);
    let further = (shortest(FULL) - shortest(ONE)) / (MANY - 1) as f64;
    table.row(["each further contact".to_owned(), format!("{further:.3}"), "–".to_owned()]);
    println!("Whole frames, shortest / middle of {} passes of {FRAMES} frames\n", options.rounds);
    println!("{table}");
    Ok(())
}

fn points_in_hull() -> Result<Scene, Box<dyn Error>> {
    let mut random = Random(0x512);
    let point = |i: usize| {
        let at = ron::vector(&(random.direction() * 0.1));
        format!("Point(name: \"p{i}\", position: {at}),\n")
    };
    let points = ron::model("points", &(0..POINTS).map(point).collect::<String>());
    let state = State::identity();
    Scene::two(&points, &Hull::fibonacci(8).model(), [state, state])
}
