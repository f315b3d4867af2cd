//! Thin walls and high speed.

use super::extreme::{Answer, Extreme, Length};
use super::rig::{Rig, block, model, sheet};
use crate::case::{Failure, Outcome};
use crate::measure::rotation;
use crate::row::Row;
use pong_engine::StatusBits;
use pong_executive::{Quat, Vec3};
use pong_testkit::Random;

pub const SHOTS: Extreme = Extreme {
    id: "E11",
    asked: "10,000 shots at a wall of 1 mm, 0.1 to 1,000 m/s, frames of 10 ms: each one is stopped or reported.",
    set_up: "1 kg against 1e6 N/m, from any side within 70° of the normal, any phase, any attitude; a point, a \
             sphere, an ellipsoid and a line segment against a plate of 1 mm; a sphere against a sheet, one-sided \
             from the front and two-sided from both sides. Stopped: back on the side from which it came. Reported: \
             the flag `TUNNELLED`.",
    answer: Answer::Told,
    limit: "if something moves farther in a frame than half of the wall's thickness, the engine follows it along a \
            straight line; it misses, and does not report, a path that cuts an edge within that distance, and a \
            sphere that meets the wall only with its rim within a frame",
    also: "`crates/pong-engine/tests/it/tunnelling.rs`, `side_of_entry.rs`",
    rows: shots,
};

pub const MISSES: Extreme = Extreme {
    id: "E12",
    asked: "No false alarm in 10,000 near misses.",
    set_up: "As E11, but past the edge of the wall by 1e-9 m to 0.1 m, along its face at such a distance, turning \
             back before it, or through a one-sided sheet from behind.",
    answer: Answer::Safe,
    limit: "none found",
    also: "",
    rows: misses,
};

const FRAME: f64 = 0.01;
const HALF_WALL: f64 = 5e-4;
const STIFFNESS: f64 = 1e6;

/// Projectiles: name, primitive, and extent from the origin, m.
const BULLETS: [(&str, &str, f64); 4] = [
    ("point", "Point(name: \"x\", position: (0,0,0))", 0.0),
    ("sphere of 5 mm", "Sphere(name: \"x\", center: (0,0,0), radius: 0.005)", 0.005),
    (
        "ellipsoid of 6 × 4 × 3 mm",
        "Ellipsoid(name: \"x\", center: (0,0,0), semi_axes: (0.006,0.004,0.003))",
        0.006,
    ),
    ("line segment of 40 mm", "LineSegment(name: \"x\", ends: ((-0.02,0,0),(0.02,0,0)))", 0.02),
];

#[derive(Clone, Copy, Debug, PartialEq)]
enum Wall {
    Plate,
    OneSided,
    TwoSided,
}

impl Wall {
    /// Model text of a wall across x, about the origin, 1 m wide.
    fn text(self) -> String {
        let front = |x: f64, y: f64| Vec3::new(0.0, x, y);
        let shape = match self {
            Self::Plate => block("wall", Vec3::zeros(), Vec3::new(HALF_WALL, 0.5, 0.5), |p| p),
            Self::OneSided => sheet("wall", "", 8, front),
            Self::TwoSided => sheet("wall", "two_sided: true,", 8, front),
        };
        model("stiffness: inf, normal: Linear(damping: 0.0)", &shape)
    }
}

/// A body in flight.
struct Shot {
    place: Vec3,
    velocity: Vec3,
    turn: Quat,
}

/// Outcome of a shot.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Stopped,
    Told,
    /// On the other side, without a tunnelling report.
    Through,
    /// Back on its side, with a false tunnelling report.
    FalseAlarm,
}

fn set_up(bullet: &str, wall: Wall) -> Result<Rig, Failure> {
    let surface = format!("stiffness: {STIFFNESS:?}, normal: Linear(damping: 0.0)");
    Rig::new(&model(&surface, bullet), &wall.text())
}

fn speed(random: &mut Random) -> f64 {
    libm::pow(10.0, random.between(-1.0, 3.0))
}

/// A shot from the side `from` (±1) through a point of the wall.
fn aim(random: &mut Random, from: f64) -> Shot {
    let speed = speed(random);
    let tilt = random.between(0.0, 1.2);
    let round = random.between(0.0, std::f64::consts::TAU);
    let along = Vec3::new(
        -from * libm::cos(tilt),
        libm::sin(tilt) * libm::cos(round),
        libm::sin(tilt) * libm::sin(round),
    );
    let target = Vec3::new(0.0, random.between(-0.4, 0.4), random.between(-0.4, 0.4));
    // Starts three to four frames before contact, and clear of the wall in any case.
    let way = speed * FRAME * random.between(3.0, 4.0) + 0.05 / libm::cos(tilt);
    Shot { place: target - along * way, velocity: along * speed, turn: rotation(random.vector(3.0)) }
}

/// Flies until clear of the wall again, or for `frames`; returns whether tunnelling was reported, and the
/// position.
fn fly(rig: &mut Rig, shot: &Shot, clear: f64) -> Result<(bool, Vec3), Failure> {
    let (mut place, mut velocity, mut told) = (shot.place, shot.velocity, false);
    for interface in rig.sides {
        rig.world.clear_contact_history(rig.world.scene().object(if interface == rig.sides[0] {
            "a"
        } else {
            "b"
        })?)?;
    }
    let from = place.x.signum();
    for _ in 0..100_000 {
        let wrench = rig.step(place, shot.turn, velocity)?;
        told |= rig.world.report().status.contains(StatusBits::TUNNELLED);
        let past = place.x * from < -clear;
        let back = velocity.x * from > 0.0 && place.x * from > clear;
        if past || back {
            break;
        }
        velocity += wrench.force * FRAME;
        place += velocity * FRAME;
    }
    Ok((told, place))
}

fn shoot(rig: &mut Rig, shot: &Shot, reach: f64) -> Result<End, Failure> {
    let (told, place) = fly(rig, shot, HALF_WALL + reach + 0.001)?;
    let past = place.x * shot.place.x < 0.0;
    Ok(match (past, told) {
        (true, true) => End::Told,
        (true, false) => End::Through,
        (false, true) => End::FalseAlarm,
        (false, false) => End::Stopped,
    })
}

fn shots(_: Length) -> Outcome {
    const COUNT: usize = 10_000;
    let plates = BULLETS.map(|(name, text, reach)| (format!("{name} at a plate"), text, reach, Wall::Plate));
    let (_, ball, reach) = BULLETS[1];
    let sheets = [
        ("sphere at a one-sided sheet".to_owned(), ball, reach, Wall::OneSided),
        ("sphere at a two-sided sheet".to_owned(), ball, reach, Wall::TwoSided),
    ];
    let mut rows = Vec::new();
    for (name, text, reach, wall) in plates.into_iter().chain(sheets) {
        let mut random = Random(11);
        let mut rig = set_up(text, wall)?;
        let mut ends = [0; 4];
        for _ in 0..COUNT {
            let from = if wall != Wall::OneSided && random.unit() < 0.5 { -1.0 } else { 1.0 };
            let shot = aim(&mut random, from);
            ends[shoot(&mut rig, &shot, reach)? as usize] += 1;
        }
        let [stopped, told, through, false_alarms] = ends;
        rows.push(Row::count(
            format!("{name}: {stopped} of {COUNT} stopped, {told} reported; neither"),
            0,
            through,
        ));
        rows.push(Row::count(format!("{name}: reported though stopped"), 0, false_alarms));
    }
    Ok(rows)
}

/// A shot past the edge, along the face, or turning back before it.
fn near_miss(random: &mut Random, reach: f64) -> Shot {
    let gap = reach + libm::pow(10.0, random.between(-9.0, -1.0));
    let from = if random.unit() < 0.5 { -1.0 } else { 1.0 };
    let mut shot = aim(random, from);
    match (random.unit() * 2.0) as usize {
        0 => {
            // In the plane beside the edge y = 0.5, in both directions of x and z.
            shot.velocity.y = 0.0;
            shot.place = Vec3::new(shot.place.x, 0.5 + gap, shot.place.z);
        }
        _ => {
            // Along the face, from beyond one edge to beyond the other.
            let speed = shot.velocity.norm();
            shot.velocity = Vec3::y() * speed;
            let side = if random.unit() < 0.5 { -1.0 } else { 1.0 };
            shot.place = Vec3::new(
                side * (HALF_WALL + gap),
                -0.6 - speed * FRAME * random.unit(),
                random.between(-0.4, 0.4),
            );
        }
    }
    shot
}

fn misses(_: Length) -> Outcome {
    const COUNT: usize = 10_000;
    let mut rows = Vec::new();
    let walls = [(0, Wall::Plate), (1, Wall::Plate), (2, Wall::Plate), (3, Wall::Plate), (1, Wall::TwoSided)];
    for (bullet, wall) in walls {
        let (name, text, reach) = BULLETS[bullet];
        let mut random = Random(12);
        let mut rig = set_up(text, wall)?;
        let (mut alarms, mut touched) = (0, 0);
        for _ in 0..COUNT {
            let shot = near_miss(&mut random, reach);
            let (told, contact) = pass_by(&mut rig, &shot)?;
            alarms += usize::from(told);
            touched += usize::from(contact);
        }
        rows.push(Row::count(format!("{name} past a {wall:?}: false alarms of {COUNT}"), 0, alarms));
        rows.push(Row::count(format!("{name} past a {wall:?}: in contact"), 0, touched));
    }
    let mut random = Random(13);
    let mut rig = set_up(BULLETS[1].1, Wall::OneSided)?;
    let mut alarms = 0;
    for _ in 0..COUNT {
        let shot = aim(&mut random, -1.0);
        alarms += usize::from(fly(&mut rig, &shot, 0.01)?.0);
    }
    rows.push(Row::count(
        format!("sphere through a one-sided sheet from behind: false alarms of {COUNT}"),
        0,
        alarms,
    ));
    Ok(rows)
}

/// Flies straight until beyond the wall; returns whether tunnelling was reported, and whether there was a
/// contact.
fn pass_by(rig: &mut Rig, shot: &Shot) -> Result<(bool, bool), Failure> {
    for name in ["a", "b"] {
        rig.world.clear_contact_history(rig.world.scene().object(name)?)?;
    }
    let (mut told, mut touched) = (false, false);
    // The distance to the wall and as far again, at most a few hundred frames: slow shots begin close to it.
    let whole = (2.5 / (shot.velocity.norm() * FRAME)).min(300.0) as usize + 8;
    for frame in 0..whole {
        let place = shot.place + shot.velocity * (FRAME * frame as f64);
        rig.step(place, shot.turn, shot.velocity)?;
        told |= rig.world.report().status.contains(StatusBits::TUNNELLED);
        touched |= rig.world.contact_count() > 0;
    }
    Ok((told, touched))
}
