//! W2: the docking ring. The engine's whole frame beside only the collision detection of others, in the same
//! rounds.

use pong_bench::floor::ring::ByHand;
use pong_bench::heap;
use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::peer::parry::{Loop, Manifolds};
use pong_bench::race::{Outcome, Race};
use pong_bench::rig::{Fingerprint, Rig, bind_caller};
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::scenes;
use pong_bench::side_by_side::SideBySide;
use pong_bench::table::{Table, min_and_median, or_dash, ratio_at_least, ratio_at_most};
use pong_bench::timing::{Clock, Ratios, digits};
use pong_engine::State;
use std::error::Error;
use std::hint::black_box;

#[global_allocator]
static HEAP: heap::Counting = heap::Counting;

const MICRO: f64 = 1e-6;
const ONE: &str = "Pong";
const TWO: &str = "Pong, two threads";
const SIDE_BY_SIDE: &str = "Pong, two worlds side by side";
const FLOOR: &str = "floor";
/// Equal worlds, and floors, used in turn from round to round: the memory layout of one world changes its
/// frame time by 2 to 4 %.
const WORLDS: usize = 4;
const PEERS: [&str; 4] = ["parry", "parry, own loop", "MuJoCo", "ODE"];

/// Targets of a size.
#[derive(Clone, Copy)]
struct Wanted {
    /// Target time of a whole frame, relative to the floor's detection.
    over_floor: f64,
    /// Target speed-up of two threads over one: never slower on the small ring.
    gain: f64,
}

/// Targets, in the order of [`ring::SIZES`].
const WANTED: [Wanted; 3] = [
    Wanted { over_floor: 3.5, gain: 1.0 },
    Wanted { over_floor: 3.0, gain: 1.6 },
    Wanted { over_floor: 2.5, gain: 1.85 },
];

type States = Vec<[State; 2]>;
type Named = (&'static str, Box<dyn Peer>);

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let mut tables = Tables {
        frames: Table::new(&[
            "P, N, shape",
            "contacts",
            "volume tests",
            "pair tests",
            "allocations",
            "wrenches",
        ]),
        times: Table::new(&["P, N, shape", "Pong", "floor", PEERS[0], PEERS[1], PEERS[2], PEERS[3]]),
        ratios: Table::new(&["P, N, shape", "floor", "wanted", PEERS[0], PEERS[1], PEERS[2], PEERS[3]]),
        threads: Table::new(&[
            "P, N, shape",
            "one thread",
            "two threads",
            "two worlds side by side",
            "one over two",
            "of the shortest",
            "wanted",
            "side by side over two",
        ]),
    };
    for (index, size) in ring::SIZES.into_iter().enumerate() {
        if options.wants(index) && !(options.smoke && index > 1) {
            for tip in [Tip::Sphere, Tip::Point] {
                run(size, WANTED[index], tip, &options, &mut tables)?;
            }
        }
    }
    println!(
        "A frame of Pong: contacts found, tests made, calls for memory, hash of the bits of all wrenches\n"
    );
    println!("{}", tables.frames);
    println!("µs per frame, shortest / middle of {} passes\n", options.rounds);
    println!("{}", tables.times);
    println!("Pong's whole frame over the others' detection, middle [least..greatest] of the rounds\n");
    println!("{}", tables.ratios);
    println!("Threads of Pong, µs per frame by the clock on the wall; of two worlds, per frame of either\n");
    println!("{}", tables.threads);
    Ok(())
}

struct Tables {
    frames: Table,
    times: Table,
    ratios: Table,
    threads: Table,
}

fn run(
    size: (usize, usize),
    wanted: Wanted,
    tip: Tip,
    options: &Options,
    tables: &mut Tables,
) -> Result<(), Box<dyn Error>> {
    let ring = Ring::new(size);
    let mut states = ring::states();
    if options.smoke {
        states.truncate(4);
    }
    let name = format!("{}, {}, {}s", size.0, size.1, format!("{tip:?}").to_lowercase());
    let worlds = |threads| -> Result<Vec<Rig>, Box<dyn Error>> {
        (0..WORLDS).map(|_| scenes::ring(&ring, tip, threads)).collect()
    };
    let (mut one, mut two) = (worlds(1)?, worlds(2)?);
    tables.frames.row(first_pass(&name, &mut one[0], &states)?);
    let mut path = scenes::ring_states();
    path.truncate(states.len());
    let mut side_by_side =
        SideBySide::new([scenes::ring(&ring, tip, 1)?, scenes::ring(&ring, tip, 1)?], path)?;

    // Behind a pointer, as the peers: inlined into its pass, the floor takes 10 % longer.
    let mut floors: Vec<Box<dyn Peer>> =
        (0..WORLDS).map(|_| Box::new(ByHand::new(&ring, tip)) as Box<dyn Peer>).collect();
    let mut others = if options.alone { Vec::new() } else { others(&ring, tip) };
    bind_caller();
    let [first, rest @ ..] = &mut one[..] else { return Err("no world".into()) };
    for rig in rest.iter_mut().chain(&mut two) {
        cross_check(&name, first, (ONE, rig), &states)?;
    }
    for floor in &mut floors {
        cross_check(&name, first, (FLOOR, &mut **floor), &states)?;
    }
    for (who, peer) in &mut others {
        cross_check(&name, first, (who, &mut **peer), &states)?;
    }
    let mut race = Race::new();
    // Two threads first: their workers sleep after the warm-up of one thread and slow nothing down.
    race.enter_in_turn(TWO, |round| pass(&mut two[round % WORLDS], &states));
    if let Some(side_by_side) = &mut side_by_side {
        race.enter(SIDE_BY_SIDE, || side_by_side.pass());
    }
    race.enter_in_turn(ONE, |round| pass(&mut one[round % WORLDS], &states));
    race.enter_in_turn(FLOOR, |round| pass(&mut *floors[round % WORLDS], &states));
    for (name, peer) in &mut others {
        race.enter(name, || pass(&mut **peer, &states));
    }
    tables.take(&name, wanted, &race.run(options.rounds, states.len()));
    Ok(())
}

fn others(ring: &Ring, tip: Tip) -> Vec<Named> {
    let mut others: Vec<Named> = Vec::new();
    if tip == Tip::Sphere {
        others.push(("parry", Box::new(Manifolds::ring(ring))));
    }
    others.push(("parry, own loop", Box::new(Loop::ring(ring, tip))));
    #[cfg(feature = "mujoco")]
    others.push(("MuJoCo", Box::new(pong_bench::peer::mujoco::Mujoco::ring(ring, tip))));
    #[cfg(feature = "ode")]
    others.push((
        "ODE",
        Box::new(pong_bench::peer::ode::OdeRing::new(ring, tip, pong_bench::peer::ode::Space::Quadtree)),
    ));
    others
}

fn pass(peer: &mut dyn Peer, states: &States) {
    for states in states {
        black_box(peer.frame(states));
    }
}

/// Counts of a frame, hash of all wrenches of the first pass, and memory taken in the second.
fn first_pass(name: &str, rig: &mut Rig, states: &States) -> Result<[String; 6], Box<dyn Error>> {
    let mut fingerprint = Fingerprint::default();
    let (mut contacts, mut volumes, mut primitives) = (0.0, 0.0, 0.0);
    for states in states {
        fingerprint.add(rig.step(states));
        let report = rig.world.report();
        contacts += f64::from(report.contacts);
        volumes += rig.world.counts().volumes_tested() as f64;
        primitives += rig.world.counts().primitives_tested() as f64;
    }
    let before = heap::calls();
    pass(rig, states);
    let frames = states.len() as f64;
    let taken = (heap::calls() - before) as f64 / frames;
    if contacts == 0.0 {
        return Err(format!("{name}: nothing touched").into());
    }
    Ok([
        name.to_owned(),
        format!("{:.3}", contacts / frames),
        format!("{:.1}", volumes / frames),
        format!("{:.1}", primitives / frames),
        format!("{taken:.2}"),
        fingerprint.to_string(),
    ])
}

/// Checks that every engine finds as many contacts in every frame. ODE's test of a sphere near an edge
/// differs by a rounding that affects a frame or two; this is reported.
fn cross_check(
    name: &str,
    rig: &mut Rig,
    (who, other): (&str, &mut dyn Peer),
    states: &States,
) -> Result<(), Box<dyn Error>> {
    const MOST_OF_ODE: usize = 2;
    let mut of_ode = 0;
    for (frame, states) in states.iter().enumerate() {
        let (ours, theirs) = (rig.frame(states), other.frame(states));
        of_ode += usize::from(who == "ODE" && theirs != ours);
        if theirs != ours && (who != "ODE" || of_ode > MOST_OF_ODE || theirs.abs_diff(ours) > 1) {
            return Err(format!("{name}, frame {frame}: {who} finds {theirs} contacts, Pong {ours}").into());
        }
    }
    if of_ode > 0 {
        println!("{name}: in {of_ode} of {} frames ODE finds one contact more or less\n", states.len());
    }
    Ok(())
}

impl Tables {
    fn take(&mut self, name: &str, wanted: Wanted, outcome: &Outcome) {
        let name = || std::iter::once(name.to_owned());
        let told = |who, clock| min_and_median(outcome.of(who), clock, MICRO);
        let others = || std::iter::once(FLOOR).chain(PEERS);
        let times = std::iter::once(ONE).chain(others()).map(|who| told(who, Clock::Thread));
        self.times.row(name().chain(times));
        let floor = outcome.ratio(ONE, FLOOR, Clock::Thread);
        let verdict = ratio_at_most(wanted.over_floor, floor.as_ref().map(Ratios::halves));
        let ratios = PEERS.map(|who| or_dash(outcome.ratio(ONE, who, Clock::Thread)));
        self.ratios.row(name().chain([or_dash(floor), verdict]).chain(ratios));
        // Other processes occasionally take a core: the shortest passes had both.
        let shortest = |who| outcome.of(who).map(|times| times.min(Clock::Wall));
        let gain = shortest(ONE).zip(shortest(TWO)).map(|(one, two)| one / two);
        let of_halves = |who| outcome.of(who).map(|times| times.min_of_halves(Clock::Wall));
        let gains = of_halves(ONE).zip(of_halves(TWO)).map(|(one, two)| [one[0] / two[0], one[1] / two[1]]);
        let threads = [
            told(ONE, Clock::Wall),
            told(TWO, Clock::Wall),
            told(SIDE_BY_SIDE, Clock::Wall),
            or_dash(outcome.ratio(ONE, TWO, Clock::Wall)),
            or_dash(gain.map(digits)),
            ratio_at_least(wanted.gain, gains.map(|[a, b]| [a.min(b), a.max(b)])),
            or_dash(outcome.ratio(SIDE_BY_SIDE, TWO, Clock::Wall)),
        ];
        self.threads.row(name().chain(threads));
    }
}
