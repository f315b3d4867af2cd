//! W1: one pair of primitives per query, from the relative pose to depth, normal and point.

use pong_bench::difference::Difference;
use pong_bench::floor::{Level, planes};
use pong_bench::hull::Hull;
use pong_bench::options::Options;
use pong_bench::ours::Ours;
use pong_bench::pairs::{Answer, Mover, Queries, Target};
use pong_bench::peer::PairPeer;
use pong_bench::peer::parry_pairs::Parry;
use pong_bench::race::{Outcome, Race};
use pong_bench::table::{Table, at_most, min_and_median, or_dash};
use pong_bench::timing::{Clock, digits};
use pong_geometry::Vec3;
use std::error::Error;

const POSES: usize = 4096;
const NANO: f64 = 1e-9;
const PEERS: [&str; 3] = ["parry", "MuJoCo", "ODE"];

/// An engine that no registry has, from the table of the workloads: its time there, and the time there of a peer
/// that runs here too. Here it is taken to be as many times that peer.
struct Listed {
    engine: &'static str,
    time: f64,
    beside: &'static str,
    its_time: f64,
}

/// One row of the table.
struct Case {
    mover: Mover,
    /// Vertices of the hull; `None` for the triangle.
    vertices: Option<usize>,
    listed: Option<Listed>,
    /// Greatest time to reach, as a share of the floor's for points, else of the best peer's.
    wanted: f64,
}

const fn hull(
    mover: Mover,
    vertices: usize,
    wanted: f64,
    listed: Option<(&'static str, f64, &'static str, f64)>,
) -> Case {
    Case { mover, vertices: Some(vertices), listed: beside(listed), wanted }
}

const fn beside(listed: Option<(&'static str, f64, &'static str, f64)>) -> Option<Listed> {
    match listed {
        Some((engine, time, beside, its_time)) => Some(Listed { engine, time, beside, its_time }),
        None => None,
    }
}

const CASES: [Case; 17] = [
    hull(Mover::Point, 8, 2.0, Some(("Box3D", 262.0, "ODE", 364.0))),
    hull(Mover::Point, 18, 2.0, Some(("Box3D", 413.0, "ODE", 566.0))),
    hull(Mover::Point, 66, 2.0, None),
    hull(Mover::Segment, 8, 0.2, Some(("Box3D", 507.0, "ODE", 681.0))),
    hull(Mover::Segment, 18, 0.2, Some(("Box3D", 769.0, "ODE", 907.0))),
    hull(Mover::Segment, 66, 0.2, None),
    hull(Mover::Sphere, 8, 0.25, Some(("Box3D", 252.0, "MuJoCo", 379.0))),
    hull(Mover::Sphere, 18, 0.25, Some(("Box3D", 398.0, "MuJoCo", 495.0))),
    hull(Mover::Sphere, 66, 0.25, None),
    hull(Mover::Ellipsoid, 8, 0.25, None),
    hull(Mover::Ellipsoid, 18, 0.25, None),
    hull(Mover::Ellipsoid, 66, 0.25, None),
    hull(Mover::Ray, 8, 1.0 / 3.0, Some(("Box3D", 60.4, "MuJoCo", 487.0))),
    hull(Mover::Ray, 18, 1.0 / 3.0, Some(("Box3D", 113.0, "MuJoCo", 747.0))),
    hull(Mover::Ray, 66, 1.0 / 3.0, Some(("Jolt", 529.0, "MuJoCo", 1101.0))),
    Case {
        mover: Mover::Sphere,
        vertices: None,
        listed: beside(Some(("Box3D", 32.5, "ODE", 124.0))),
        wanted: 0.5,
    },
    Case {
        mover: Mover::Ray,
        vertices: None,
        listed: beside(Some(("Jolt", 16.1, "parry", 53.8))),
        wanted: 0.5,
    },
];

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let poses = if options.smoke { 64 } else { POSES };
    let mut times =
        Table::new(&["pair", "Pong", "floor", "parry", "MuJoCo", "ODE", "listed*", "Pong over", "wanted"]);
    let mut checks: Vec<Difference> = Vec::new();
    for (_, case) in CASES.iter().enumerate().filter(|(number, _)| options.wants(*number)) {
        run(case, poses, &options, &mut times, &mut checks)?;
    }
    println!("ns per query, shortest / middle of {} passes over {poses} poses\n", options.rounds);
    println!("{times}");
    println!("All find the same hits and misses. Greatest differences from Pong at hits:\n");
    println!("{}", Difference::table(&checks));
    Ok(())
}

type Named = (&'static str, Box<dyn PairPeer>);

fn peers(case: &Case, target: &Target) -> Vec<Named> {
    let mut peers: Vec<Named> = Vec::new();
    if let Some(pair) = Parry::new(case.mover, target) {
        peers.push(("parry", Box::new(pair)));
    }
    #[cfg(feature = "mujoco")]
    if let Some(pair) = pong_bench::peer::mujoco::MujocoPair::new(case.mover, target) {
        peers.push(("MuJoCo", Box::new(pair)));
    }
    #[cfg(feature = "ode")]
    if let Some(pair) = pong_bench::peer::ode::OdePair::new(case.mover, target) {
        peers.push(("ODE", Box::new(pair)));
    }
    peers
}

fn run(
    case: &Case,
    poses: usize,
    options: &Options,
    times: &mut Table,
    checks: &mut Vec<Difference>,
) -> Result<(), Box<dyn Error>> {
    let target = case.vertices.map_or(Target::Triangle, |vertices| Target::Hull(Hull::fibonacci(vertices)));
    let mut ours = Ours::new(case.mover, &target);
    let queries = Queries::new(poses, case.mover, &target, |x| ours.touches(x));
    let mut peers = if options.alone { Vec::new() } else { peers(case, &target) };
    let name = case.name(&target);
    check(case, &name, &queries, &mut ours, &mut peers, checks)?;

    let mut answers = vec![Answer::default(); poses];
    let mut scratch = vec![answers.clone(); peers.len()];
    let mut race = Race::new();
    race.enter("Pong", || ours.pass(&queries, std::hint::black_box(&mut answers)));
    if let (Mover::Point, Target::Hull(hull)) = (case.mover, &target) {
        let (level, blocks, origin) = (Level::detect(), planes::blocks(&hull.planes()), Vec3::zeros());
        let mut out = vec![0.0; poses];
        let queries = &queries;
        let mut floor = move || {
            let origin = std::hint::black_box(&origin);
            planes::heights(level, &blocks, origin, &queries.transforms, std::hint::black_box(&mut out));
            out[0]
        };
        race.enter("floor", move || _ = std::hint::black_box(floor()));
    }
    for ((name, peer), answers) in peers.iter_mut().zip(&mut scratch) {
        race.enter(name, || peer.pass(&queries, std::hint::black_box(answers)));
    }
    let outcome = race.run(options.rounds, poses);
    times.row(case.row(&name, &outcome));
    Ok(())
}

impl Case {
    fn name(&self, target: &Target) -> String {
        let mover = format!("{:?}", self.mover).to_lowercase();
        match target.faces() {
            Some(faces) => format!("{mover}–hull {faces}"),
            None => format!("{mover}–{}", target.kind().name().to_lowercase()),
        }
    }

    fn row(&self, name: &str, outcome: &Outcome) -> [String; 9] {
        let told = |contender| min_and_median(outcome.of(contender), Clock::Thread, NANO);
        // Everyone who could be the best: name, shortest pass, ratios of ours to theirs.
        let measured = PEERS.iter().filter_map(|&peer| {
            Some((peer.to_owned(), outcome.of(peer)?.min(Clock::Thread), self.over(outcome, peer, 1.0)?))
        });
        let listed = self.listed.as_ref().and_then(|listed| {
            let factor = listed.time / listed.its_time;
            let time = outcome.of(listed.beside)?.min(Clock::Thread) * factor;
            Some((listed.engine.to_owned() + "*", time, self.over(outcome, listed.beside, factor)?))
        });
        let listed_cell = listed.as_ref().map(|(name, time, _)| format!("{name} {}", digits(time / NANO)));
        let best = match outcome.of("floor") {
            Some(_) => outcome.ratio("Pong", "floor", Clock::Thread).map(|ratio| ("floor".to_owned(), ratio)),
            None => {
                let best = measured.chain(listed).min_by(|a, b| a.1.total_cmp(&b.1));
                best.map(|(name, _, ratio)| (name, ratio))
            }
        };
        [
            name.to_owned(),
            told("Pong"),
            told("floor"),
            told("parry"),
            told("MuJoCo"),
            told("ODE"),
            or_dash(listed_cell),
            or_dash(best.as_ref().map(|(name, ratio)| format!("{name}: {ratio}"))),
            at_most(self.wanted, best.map(|(_, ratio)| ratio.median())),
        ]
    }

    fn over(&self, outcome: &Outcome, peer: &str, factor: f64) -> Option<pong_bench::timing::Ratios> {
        Some(outcome.ratio("Pong", peer, Clock::Thread)?.times(1.0 / factor))
    }
}

/// Everyone must find the hits and misses that were made; what they find at hits is compared with ours.
fn check(
    case: &Case,
    name: &str,
    queries: &Queries,
    ours: &mut Ours,
    peers: &mut [Named],
    checks: &mut Vec<Difference>,
) -> Result<(), Box<dyn Error>> {
    let mut answers = vec![Answer::default(); queries.hits.len()];
    ours.pass(queries, &mut answers);
    require_hits(name, "Pong", queries, &answers)?;
    for (peer, pair) in peers {
        let mut theirs = vec![Answer::default(); answers.len()];
        pair.pass(queries, &mut theirs);
        require_hits(name, peer, queries, &theirs)?;
        // Of a bar Pong measures both ends, the others one depth.
        if case.mover != Mover::Segment {
            let pair = name.split(' ').next().unwrap_or(name);
            Difference::between(pair, peer, &answers, &theirs).join(checks);
        }
    }
    Ok(())
}

fn require_hits(name: &str, who: &str, queries: &Queries, answers: &[Answer]) -> Result<(), Box<dyn Error>> {
    let wrong = answers.iter().zip(&queries.hits).filter(|(answer, hit)| answer.hit() != **hit).count();
    match wrong {
        0 => Ok(()),
        _ => Err(format!("{name}: {who} takes {wrong} of {} for the opposite", answers.len()).into()),
    }
}
