//! W1: one pair of primitives per query, from two poses to depth, normal and point. W1b: one pose, many primitives.

use pong_bench::difference::Difference;
use pong_bench::floor::{Level, planes};
use pong_bench::hull::Hull;
use pong_bench::options::Options;
use pong_bench::ours::{Elements, Ours};
use pong_bench::pairs::{Answer, Mover, Queries, Target, along_y};
use pong_bench::peer::parry_pairs::Parry;
use pong_bench::peer::{AnswerFrame, PairPeer};
use pong_bench::race::{Outcome, Race};
use pong_bench::table::{Table, min_and_median, or_dash, ratio_at_most};
use pong_bench::timing::{Clock, Ratios};
use pong_geometry::Vec3;
use std::cell::RefCell;
use std::error::Error;
use std::hint::black_box;

const POSES: usize = 4096;
const NANO: f64 = 1e-9;
const PONG: &str = "Pong";
const FLOOR: &str = "floor";
const PEERS: [&str; 3] = ["parry", "MuJoCo", "ODE"];

/// One row of each table.
struct Case {
    mover: Mover,
    on: On,
    /// Target times in W1 and in W1b, relative to the floor's for points, else to the best peer's.
    wanted: [Option<f64>; 2],
}

#[derive(Clone, Copy)]
enum On {
    /// A hull with this many vertices.
    Hull(usize),
    Triangle,
    Capsule,
    Cylinder,
    Cone,
    Ellipsoid,
}

const fn hull(mover: Mover, vertices: usize, wanted: Option<f64>) -> Case {
    Case { mover, on: On::Hull(vertices), wanted: [wanted, None] }
}

const fn triangle(mover: Mover, wanted: Option<f64>) -> Case {
    Case { mover, on: On::Triangle, wanted: [None, wanted] }
}

const fn round(mover: Mover, on: On) -> Case {
    Case { mover, on, wanted: [None, None] }
}

const CASES: [Case; 46] = [
    hull(Mover::Point, 8, Some(2.0)),
    hull(Mover::Point, 18, Some(2.0)),
    hull(Mover::Point, 66, Some(2.0)),
    hull(Mover::Segment, 8, Some(0.15)),
    hull(Mover::Segment, 18, Some(0.15)),
    hull(Mover::Segment, 66, Some(0.15)),
    hull(Mover::Sphere, 8, None),
    hull(Mover::Sphere, 18, None),
    hull(Mover::Sphere, 66, None),
    hull(Mover::Ellipsoid, 8, Some(0.15)),
    hull(Mover::Ellipsoid, 18, Some(0.15)),
    hull(Mover::Ellipsoid, 66, Some(0.15)),
    hull(Mover::Capsule, 8, None),
    hull(Mover::Capsule, 18, None),
    hull(Mover::Capsule, 66, None),
    hull(Mover::Ray, 8, None),
    hull(Mover::Ray, 18, None),
    hull(Mover::Ray, 66, None),
    triangle(Mover::Sphere, Some(0.5)),
    triangle(Mover::Ray, Some(0.5)),
    triangle(Mover::Capsule, None),
    round(Mover::Point, On::Capsule),
    round(Mover::Point, On::Cylinder),
    round(Mover::Point, On::Cone),
    round(Mover::Segment, On::Capsule),
    round(Mover::Segment, On::Cylinder),
    round(Mover::Segment, On::Cone),
    round(Mover::Sphere, On::Capsule),
    round(Mover::Sphere, On::Cylinder),
    round(Mover::Sphere, On::Cone),
    round(Mover::Capsule, On::Capsule),
    round(Mover::Capsule, On::Cylinder),
    round(Mover::Capsule, On::Cone),
    round(Mover::Ray, On::Capsule),
    round(Mover::Ray, On::Cylinder),
    round(Mover::Ray, On::Cone),
    round(Mover::Ellipsoid, On::Ellipsoid),
    round(Mover::Ellipsoid, On::Capsule),
    round(Mover::Ellipsoid, On::Cylinder),
    round(Mover::Ellipsoid, On::Cone),
    hull(Mover::Cylinder, 8, None),
    hull(Mover::Cylinder, 18, None),
    hull(Mover::Cylinder, 66, None),
    triangle(Mover::Cylinder, None),
    round(Mover::Cylinder, On::Cylinder),
    round(Mover::Cylinder, On::Cone),
];

struct Tables {
    one_pair: Table,
    one_pose: Table,
    checks: Vec<Difference>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let poses = if options.smoke { 64 } else { POSES };
    let mut tables = Tables {
        one_pair: Table::new(&["pair", PONG, FLOOR, PEERS[0], PEERS[1], PEERS[2], "Pong over", "wanted"]),
        one_pose: Table::new(&["pair", PONG, FLOOR, PEERS[0], "Pong over", "wanted"]),
        checks: Vec::new(),
    };
    for (_, case) in CASES.iter().enumerate().filter(|(number, _)| options.wants(*number)) {
        run(case, poses, &options, &mut tables)?;
    }
    let passes = options.rounds;
    println!("W1, ns per query, shortest / middle of {passes} passes over {poses} pairs of poses\n");
    println!("{}", tables.one_pair);
    println!("All find the same hits and misses. Greatest differences from Pong at hits:\n");
    println!("{}", Difference::table(&tables.checks));
    println!(
        "W1b, ns per primitive, shortest / middle of {passes} passes over {poses} primitives of one pose\n"
    );
    println!("{}", tables.one_pose);
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

fn run(case: &Case, poses: usize, options: &Options, tables: &mut Tables) -> Result<(), Box<dyn Error>> {
    let target = case.target();
    let mut ours = Ours::new(case.mover, &target);
    let queries = Queries::new(poses, case.mover, &target, |x| ours.touches(x));
    let mut all: Vec<Named> = if options.alone { Vec::new() } else { peers(case, &target) };
    let name = case.name(&target);
    check(case, &name, &queries, &mut ours, &mut all, &mut tables.checks)?;
    all.insert(0, (PONG, Box::new(ours)));

    let floor = match (case.mover, &target) {
        (Mover::Point, Target::Hull(hull)) => Some(planes::blocks(&hull.planes())),
        _ => None,
    };
    let queries = RefCell::new(queries);
    let outcome = one_pair(&mut all, floor.as_deref(), &queries).run(options.rounds, poses);
    tables.one_pair.row(case.row(&name, &outcome, &PEERS, case.wanted[0]));
    let elements = RefCell::new(Elements::new(&queries.borrow()));
    let outcome = one_pose(&mut all, floor.as_deref(), &queries, &elements).run(options.rounds, poses);
    tables.one_pose.row(case.row(&name, &outcome, &PEERS[..1], case.wanted[1]));
    Ok(())
}

/// W1: every pass has the pairs in another order.
fn one_pair<'a>(
    all: &'a mut [Named],
    floor: Option<&'a [planes::Block]>,
    queries: &'a RefCell<Queries>,
) -> Race<'a> {
    let mut race = Race::new();
    for (name, engine) in all {
        let mut answers = vec![Answer::default(); queries.borrow().hits.len()];
        let pass = move || engine.pass(&queries.borrow(), black_box(&mut answers));
        race.enter_prepared(name, || queries.borrow_mut().shuffle(), pass);
    }
    if let Some(blocks) = floor {
        let mut out = vec![0.0; queries.borrow().hits.len()];
        let pass = move || {
            let (origin, poses) = (Vec3::zeros(), &queries.borrow().poses);
            planes::heights(Level::detect(), blocks, black_box(&origin), poses, black_box(&mut out));
        };
        race.enter_prepared(FLOOR, || queries.borrow_mut().shuffle(), pass);
    }
    race
}

/// W1b: every pass has the primitives in another order.
fn one_pose<'a>(
    all: &'a mut [Named],
    floor: Option<&'a [planes::Block]>,
    queries: &'a RefCell<Queries>,
    elements: &'a RefCell<Elements>,
) -> Race<'a> {
    let another_order = || {
        queries.borrow_mut().shuffle();
        *elements.borrow_mut() = Elements::new(&queries.borrow());
    };
    let mut race = Race::new();
    for (name, engine) in all {
        let mut answers = vec![Answer::default(); queries.borrow().hits.len()];
        if engine.pass_over_elements(&elements.borrow(), &mut answers) {
            let pass = move || _ = engine.pass_over_elements(&elements.borrow(), black_box(&mut answers));
            race.enter_prepared(name, another_order, pass);
        }
    }
    if let Some(blocks) = floor {
        let mut out = vec![0.0; queries.borrow().hits.len()];
        let pass = move || {
            let (x_ba, points) = (elements.borrow().pose_ba.transform(), &elements.borrow().positions);
            planes::heights_of_many(Level::detect(), blocks, points, black_box(&x_ba), black_box(&mut out));
        };
        race.enter_prepared(FLOOR, another_order, pass);
    }
    race
}

impl Case {
    fn target(&self) -> Target {
        match self.on {
            On::Hull(vertices) => Target::Hull(Hull::fibonacci(vertices)),
            On::Triangle => Target::Triangle,
            On::Capsule => Target::Capsule,
            On::Cylinder => Target::Cylinder,
            On::Cone => Target::Cone,
            On::Ellipsoid => Target::Ellipsoid,
        }
    }

    /// True if all engines define depth alike: for a segment on a hull Pong measures both ends, the others
    /// one depth.
    fn depths_compare(&self) -> bool {
        !matches!((self.mover, self.on), (Mover::Segment, On::Hull(_)))
    }

    fn name(&self, target: &Target) -> String {
        let mover = format!("{:?}", self.mover).to_lowercase();
        match target.faces() {
            Some(faces) => format!("{mover}–hull {faces}"),
            None => format!("{mover}–{}", target.kind().name().to_lowercase()),
        }
    }

    /// Times of all engines, and the ratio of ours to the floor's or to the best peer's.
    fn row(&self, name: &str, outcome: &Outcome, peers: &[&str], wanted: Option<f64>) -> Vec<String> {
        let shortest = |who: &str| outcome.of(who).map(|times| times.min(Clock::Thread));
        let best = peers.iter().copied().filter(|who| shortest(who).is_some());
        let best = best.min_by(|a, b| shortest(a).unwrap_or(0.0).total_cmp(&shortest(b).unwrap_or(0.0)));
        let best = outcome.of(FLOOR).map(|_| FLOOR).or(best);
        let over = best.and_then(|who| Some((who, outcome.ratio(PONG, who, Clock::Thread)?)));
        let verdict = wanted
            .map(|wanted| ratio_at_most(wanted, over.as_ref().map(|(_, ratios)| Ratios::halves(ratios))));
        let told = [PONG, FLOOR].iter().chain(peers);
        let told = told.map(|who| min_and_median(outcome.of(who), Clock::Thread, NANO));
        let over = or_dash(over.map(|(who, ratios)| format!("{who}: {ratios}")));
        std::iter::once(name.to_owned()).chain(told).chain([over, or_dash(verdict)]).collect()
    }
}

/// Checks that every engine finds the constructed hits and misses, and compares their answers at hits with
/// ours.
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
        if case.depths_compare() {
            in_target_frame(pair.frame_of_answers(), queries, &mut theirs);
            let pair = name.split(' ').next().unwrap_or(name);
            Difference::between(pair, peer, &answers, &theirs).join(checks);
        }
    }
    Ok(())
}

/// Transforms normals and points to the target's frame.
fn in_target_frame(from: AnswerFrame, queries: &Queries, answers: &mut [Answer]) {
    for (answer, [_, target]) in answers.iter_mut().zip(&queries.poses) {
        let x = match from {
            AnswerFrame::Target => return,
            AnswerFrame::TargetAlongY => along_y(),
            AnswerFrame::Common => target.inverse(),
        };
        answer.normal = (x.orientation * Vec3::from(answer.normal)).into();
        answer.point = x.transform().point(&Vec3::from(answer.point)).into();
    }
}

fn require_hits(name: &str, who: &str, queries: &Queries, answers: &[Answer]) -> Result<(), Box<dyn Error>> {
    let wrong = answers.iter().zip(&queries.hits).filter(|(answer, hit)| answer.hit() != **hit).count();
    match wrong {
        0 => Ok(()),
        _ => Err(format!("{name}: {who} takes {wrong} of {} for the opposite", answers.len()).into()),
    }
}
