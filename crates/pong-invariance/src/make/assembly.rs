//! Scenes from the makers of their two bodies: surfaces, unit of length and history.

use super::toucher::toucher;
use super::{path, round, touched, volumes};
use crate::random::Random;
use crate::scene::{Body, Friction, Normal, Scene, Shape, Surface};
use pong_engine::SurfaceMotion;

/// The makers of a family, and the kinds that touch it if not all can.
pub(super) fn family(
    random: &mut Random,
    name: &'static str,
    make: touched::Make,
    kinds: Option<&[&'static str]>,
) -> Scene {
    // About a third of the scenes has round numbers: only these meet exact seams, right angles and ties.
    let is_round = random.chance(0.35);
    let mut touched = make(random, is_round);
    touched::tilt(random, &mut touched, is_round);
    let touching = match kinds {
        Some(kinds) => round::touching(random, kinds, &touched[0], is_round),
        None => touching(random, kinds_that_touch(&touched[0]), is_round),
    };
    let size = unit_of_length(random);
    let [a, b] = surfaces(random, size);
    let bodies = [Body::new(touching, a), Body::new(touched, b)];
    with_history(random, name, bodies, size, is_round)
}

/// A scene of two solids, or of a solid on a plane.
pub(super) fn of_solids(
    random: &mut Random,
    name: &'static str,
    make_b: touched::Make,
    make_a: touched::Make,
) -> Scene {
    let is_round = random.chance(0.35);
    let [mut b, mut a] = [make_b(random, is_round), make_a(random, is_round)];
    touched::tilt(random, &mut b, is_round);
    touched::tilt(random, &mut a, is_round);
    let size = unit_of_length(random);
    let surfaces = surfaces(random, size).map(volumes::linear);
    let mut bodies = [Body::new(a, surfaces[0]), Body::new(b, surfaces[1])];
    for body in &mut bodies {
        body.is_solid = !matches!(body.shapes[0], Shape::Plane { .. });
    }
    with_history(random, name, bodies, size, is_round)
}

pub(super) fn unit_of_length(random: &mut Random) -> f64 {
    if random.chance(0.3) { random.log_between(1e-3, 1e3) } else { 1.0 }
}

/// A scene of two bodies about 1 m large, in another unit of length.
pub(super) fn with_history(
    random: &mut Random,
    family: &'static str,
    bodies: [Body; 2],
    size: f64,
    is_round: bool,
) -> Scene {
    let swapped = random.chance(0.3);
    let mut scene = Scene { family, bodies, swapped, frames: Vec::new(), motions: Vec::new(), size: 1.0 };
    scene.frames = path::history(random, &scene, is_round);
    rescaled(&scene, size)
}

pub(super) fn touching(random: &mut Random, kinds: &[&str], is_round: bool) -> Vec<Shape> {
    let mut touching = vec![toucher(random, kinds, is_round)];
    while random.chance(0.2) {
        touching.push(toucher(random, kinds, is_round));
    }
    touching
}

/// Kinds that have a tester against this one.
fn kinds_that_touch(shape: &Shape) -> &'static [&'static str] {
    match shape {
        Shape::Plane { .. } | Shape::Polyhedron(_) => &["Point", "LineSegment", "Ray", "Sphere", "Ellipsoid"],
        Shape::Mesh(_) => &["Sphere", "Sphere", "Ellipsoid", "Ellipsoid", "Ray"],
        Shape::Sphere { .. } => &["Point", "Sphere"],
        _ => &["Point"],
    }
}

/// Two surfaces that may meet: the same laws of force and friction, different values. Damping forces are of
/// the order of the spring's.
pub(super) fn surfaces(random: &mut Random, size: f64) -> [Surface; 2] {
    // Half of the last two laws are power laws with one damping exponent each.
    let draw = random.below(48);
    let (law, damping_exponent) = (draw % 6, [0.0, 0.25, 0.6, 1.0].get(draw / 6).copied());
    let friction = random.below(4);
    let ramp = if random.chance(0.2) { random.log_between(1e-4, 1e-1) * size } else { 0.0 };
    let rigid = random.below(6);
    let scale = random.log_between(1e2, 1e7);
    let mut one = |index: usize| {
        let stiffness = if rigid == index { f64::INFINITY } else { scale * random.log_between(0.3, 3.0) };
        let spring = stiffness.min(scale);
        let normal = match law {
            0..=1 => Normal::Linear { damping: 0.0, ramp },
            2..=3 => Normal::Linear { damping: spring * random.between(0.0, 0.1), ramp },
            _ => {
                let exponent = if law == 4 { 1.0 } else { 1.5 };
                let dissipation = random.between(0.0, 1.0) / size;
                match damping_exponent {
                    None => Normal::HuntCrossley { dissipation, exponent },
                    Some(damping_exponent) => Normal::PowerLaw {
                        damping: spring * dissipation * libm::pow(size, exponent - damping_exponent),
                        exponent,
                        damping_exponent,
                    },
                }
            }
        };
        let excess = if random.chance(0.3) { random.between(0.0, 0.5) } else { 0.0 };
        let friction = match friction {
            0 => Friction::Smooth,
            1 | 2 => Friction::Bristle {
                mu: random.between(0.1, 1.0),
                excess,
                stiffness: spring * random.between(0.3, 1.0),
                damping: if random.chance(0.5) { spring * random.between(0.0, 0.05) } else { 0.0 },
            },
            _ => Friction::Coulomb { mu: random.between(0.1, 1.0), slip_speed: 1e-2 * size },
        };
        Surface { stiffness, normal, friction }
    };
    [one(0), one(1)]
}

/// The scene in another unit of length. Stiffness and friction are kept: forces scale with lengths where the
/// law is linear in them, see [`crate::twin`].
pub fn rescaled(scene: &Scene, s: f64) -> Scene {
    let mut scaled = scene.clone();
    scaled.size *= s;
    for body in &mut scaled.bodies {
        body.shapes = body.shapes.iter().map(|shape| shape.scaled(s)).collect();
        body.place.position *= s;
    }
    for state in scaled.frames.iter_mut().flatten() {
        state.position = state.position.map(|x| x * s);
        state.linear_velocity = state.linear_velocity.map(|x| x * s);
    }
    for motion in scaled.motions.iter_mut().flatten() {
        let SurfaceMotion { linear_velocity, belt_velocity, linear_travel, belt_travel, .. } = motion;
        for vector in [linear_velocity, belt_velocity, linear_travel, belt_travel] {
            *vector = vector.map(|x| x * s);
        }
    }
    scaled
}
