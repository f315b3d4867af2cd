//! Scenes with round parts: touched rods, shafts, cones and holes, and touching capsules, cylinders and
//! cones.

use super::solids;
use super::touched::{self, Make};
use super::toucher::toucher;
use crate::random::Random;
use crate::round_part::{RoundKind, RoundPart};
use crate::scene::Shape;
use pong_geometry::Vec3;

/// Common name of all families of round parts.
pub const ALL: &str = "round";

const ALL_ROUND: &[&str] = &["Point", "LineSegment", "Ray", "Sphere", "Capsule", "Capsule"];

/// Families by name, maker and touching kinds: every pair with a round part that has a tester.
pub const FAMILIES: &[(&str, Make, &[&str])] = &[
    ("rod", rods, ALL_ROUND),
    ("shaft", shaft, ALL_ROUND),
    ("cone", cone, ALL_ROUND),
    ("hole", hole, &["Point", "LineSegment", "Ray", "Sphere", "Capsule", "Cylinder", "Cylinder"]),
    ("floor", touched::plane, &["Capsule", "Cylinder", "Cone"]),
    ("rod_on_solid", solid, &["Capsule"]),
    ("rod_on_mesh", mesh, &["Capsule"]),
    ("egg_on_egg", egg, &["Sphere", "Ellipsoid", "Ellipsoid"]),
    ("egg_on_round", round_solid, &["Ellipsoid"]),
    ("wheel_on_solid", solid, &["Cylinder", "Cone"]),
    ("wheel_on_mesh", mesh, &["Cylinder", "Cone"]),
    ("wheel_on_wheel", wheel, &["Cylinder", "Cone"]),
];

/// Families of a run of all: the first ones in turn. The others are made by name alone, so that scenes keep their numbers.
pub fn family(index: u64) -> &'static str {
    const IN_TURN: u64 = 7;
    FAMILIES[(index % IN_TURN) as usize].0
}

/// Ratio of radius to length, from a thin wire to a disc.
fn slenderness(random: &mut Random, is_round: bool) -> f64 {
    match is_round {
        true => random.pick(&[0.125, 0.25, 0.5, 1.0]),
        false => random.log_between(2e-3, 2.0),
    }
}

/// Two ends of an axis about its middle.
fn ends(random: &mut Random, middle: &Vec3, half: f64, is_round: bool) -> [Vec3; 2] {
    let axis = if is_round { random.pick(&[Vec3::x(), Vec3::z(), -Vec3::z()]) } else { random.direction() };
    [middle - axis * half, middle + axis * half]
}

/// A round part of size about 1.
fn part(random: &mut Random, kind: RoundKind, is_round: bool) -> RoundPart {
    let half = if is_round { random.pick(&[0.25, 0.5, 1.0]) } else { random.between(0.2, 1.0) };
    let radius = half * slenderness(random, is_round);
    let ends = ends(random, &Vec3::zeros(), half, is_round);
    RoundPart::new(kind, ends, radii(random, kind, radius, is_round))
}

/// Radii at both ends; those of a cone or hole differ: sharp, blunt, nearly straight.
fn radii(random: &mut Random, kind: RoundKind, radius: f64, is_round: bool) -> [f64; 2] {
    if let RoundKind::Capsule | RoundKind::Cylinder = kind {
        return [radius; 2];
    }
    let ratio = match random.below(4) {
        0 if kind == RoundKind::Cone => 0.0,
        0 => 1.0,
        1 => 1.0 - random.log_between(1e-9, 1e-2),
        _ if is_round => 0.5,
        _ => random.between(0.05, 1.0),
    };
    if random.chance(0.5) { [radius, radius * ratio] } else { [radius * ratio, radius] }
}

/// A single rod, or a chain of two to four.
fn rods(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let mut rods = vec![part(random, RoundKind::Capsule, is_round)];
    while rods.len() < 4 && random.chance(0.25) {
        let last = rods[rods.len() - 1].clone();
        let next = last.ends[1] + (last.axis() + random.vector(0.7)) * 0.5;
        rods.push(RoundPart { ends: [last.ends[1], next], ..last });
    }
    rods.into_iter().map(Shape::Round).collect()
}

fn egg(random: &mut Random, is_round: bool) -> Vec<Shape> {
    vec![toucher(random, &["Ellipsoid"], is_round)]
}

/// A capsule, a cylinder or a cone.
fn round_solid(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let kind = random.pick(&[RoundKind::Capsule, RoundKind::Cylinder, RoundKind::Cone]);
    vec![Shape::Round(part(random, kind, is_round))]
}

fn wheel(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let kind = random.pick(&[RoundKind::Cylinder, RoundKind::Cone]);
    vec![Shape::Round(part(random, kind, is_round))]
}

fn shaft(random: &mut Random, is_round: bool) -> Vec<Shape> {
    vec![Shape::Round(part(random, RoundKind::Cylinder, is_round))]
}

fn cone(random: &mut Random, is_round: bool) -> Vec<Shape> {
    vec![Shape::Round(part(random, RoundKind::Cone, is_round))]
}

/// A hole, possibly a socket below a funnel.
fn hole(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let mut hole = part(random, RoundKind::Bore, is_round);
    hole.thickness = random.chance(0.5).then(|| hole.widest() * random.log_between(0.05, 2.0));
    if random.chance(0.3) {
        hole.mouths = [random.chance(0.5), random.chance(0.5)];
    }
    if random.chance(0.7) {
        return vec![Shape::Round(hole)];
    }
    hole.mouths[1] = false;
    let [from, to] = hole.ends;
    let funnel = RoundPart {
        ends: [to, to + (to - from) * random.between(0.2, 1.0)],
        radii: [hole.radii[1], hole.radii[1] * random.between(1.1, 3.0)],
        mouths: [false, true],
        ..hole.clone()
    };
    vec![Shape::Round(hole), Shape::Round(funnel)]
}

fn solid(random: &mut Random, is_round: bool) -> Vec<Shape> {
    match random.below(4) {
        0 => touched::pieces(random, is_round),
        1 => touched::junction(random, is_round),
        2 => vec![Shape::Polyhedron(solids::random_hull(random))],
        _ => touched::solid(random, is_round),
    }
}

fn mesh(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let make = random.pick(&[
        super::meshes::plate,
        touched::valley,
        touched::ridge,
        touched::bowl,
        touched::skin,
        touched::sheet,
    ]);
    touched::mesh(random, make, is_round)
}

/// Touching primitives: about as wide as a touched hole, otherwise of size about 1; some in single precision.
pub fn touching(random: &mut Random, kinds: &[&str], touched: &Shape, is_round: bool) -> Vec<Shape> {
    let mut touching = Vec::new();
    while touching.is_empty() || (touching.len() < 3 && random.chance(0.2)) {
        let kind = random.pick(kinds);
        let kind_of_round = match kind {
            "Capsule" => Some(RoundKind::Capsule),
            "Cylinder" => Some(RoundKind::Cylinder),
            "Cone" => Some(RoundKind::Cone),
            _ => None,
        };
        let shape = match kind_of_round {
            Some(kind) => Shape::Round(part(random, kind, is_round)),
            None => toucher(random, &[kind], is_round),
        };
        touching.push(fitted(random, shape, touched, is_round));
    }
    if random.chance(0.3) {
        for shape in &mut touching {
            if let Shape::Round(part) = shape {
                *part = part.in_single_precision();
            }
        }
    }
    touching
}

/// A sphere or pin of about the width of its hole: loose, snug, or too large.
///
/// Kept as a separate function: in a loop the compiler may evaluate the width before the match, and undefined
/// fields of other variants could trap.
#[inline(never)]
fn fitted(random: &mut Random, shape: Shape, touched: &Shape, is_round: bool) -> Shape {
    let Shape::Round(hole) = touched else { return shape };
    if hole.kind != RoundKind::Bore || random.chance(0.2) {
        return shape;
    }
    let fit = match random.below(3) {
        0 if is_round => random.pick(&[0.5, 1.0]),
        0 => 1.0 + random.log_between(1e-6, 0.3) * random.pick(&[-1.0, 1.0]),
        _ => random.between(0.1, 0.99),
    };
    let radius = fit * hole.radii[random.below(2)].max(0.1 * hole.widest());
    match shape {
        Shape::Sphere { center, .. } => Shape::Sphere { center, radius },
        Shape::Round(part) => Shape::Round(RoundPart { radii: [radius; 2], ..part }),
        other => other,
    }
}
