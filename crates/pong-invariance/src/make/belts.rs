//! Scenes of surfaces that move along themselves (belts, tracks, turntables) and of flush solids that are declared one
//! surface.

use super::{assembly, solids, touched, volumes};
use crate::random::Random;
use crate::scene::{Body, Scene, Shape};
use pong_engine::SurfaceMotion;
use pong_geometry::{Pose, Vec3};

/// Common name of these families.
pub const ALL: &str = "surface";

/// Generator of a scene of a family.
pub type MakeScene = fn(&mut Random, &'static str) -> Scene;

/// Families by name.
pub const FAMILIES: &[(&str, MakeScene)] = &[
    ("belt", |random, name| driven(assembly::family(random, name, touched::plane, None), random)),
    ("track", |random, name| moving(assembly::family(random, name, touched::solid, None), random)),
    ("solid_on_belt", |random, name| {
        driven(assembly::of_solids(random, name, touched::plane, volumes::convex), random)
    }),
    ("solid_on_track", |random, name| {
        moving(assembly::of_solids(random, name, touched::solid, touched::solid), random)
    }),
    ("joint", joint),
];

/// Families in turn.
pub fn family(index: u64) -> &'static str {
    FAMILIES[(index % FAMILIES.len() as u64) as usize].0
}

/// Motions of a surface at random velocities, frame by frame, with travels by random steps.
fn motions(random: &mut Random, frames: usize, velocities: [Vec3; 3]) -> Vec<SurfaceMotion> {
    let [linear, angular, belt] = velocities;
    let mut motion = SurfaceMotion {
        linear_velocity: linear.into(),
        angular_velocity: angular.into(),
        belt_velocity: belt.into(),
        ..SurfaceMotion::default()
    };
    let mut next = || {
        motion.advance(random.log_between(1e-4, 0.1));
        motion
    };
    (0..frames).map(|_| next()).collect()
}

/// A plane that moves along itself: a belt or, without bristles, a turntable.
fn driven(mut scene: Scene, random: &mut Random) -> Scene {
    let Shape::Plane { normal, .. } = scene.bodies[1].shapes[0] else { return scene };
    let normal = normal.normalize();
    let speed = random.log_between(0.1, 2.0);
    let velocities = match random.chance(0.7) {
        true => [random.across(&normal) * (speed * scene.size), Vec3::zeros(), Vec3::zeros()],
        false => [Vec3::zeros(), normal * speed, Vec3::zeros()],
    };
    let of_b = motions(random, scene.frames.len(), velocities);
    scene.motions = of_b.into_iter().map(|of_b| [SurfaceMotion::default(), of_b]).collect();
    scene
}

/// Bodies whose surfaces move in every way.
fn moving(mut scene: Scene, random: &mut Random) -> Scene {
    let size = scene.size;
    let count = scene.frames.len();
    let mut of = || {
        let velocities = [random.vector(size), random.vector(1.0), random.vector(size)];
        let is_moving = [0.6, 0.4, 0.6].map(|probability| f64::from(u8::from(random.chance(probability))));
        motions(random, count, std::array::from_fn(|term| velocities[term] * is_moving[term]))
    };
    let (of_a, of_b) = (of(), of());
    scene.motions = of_a.into_iter().zip(of_b).map(|(a, b)| [a, b]).collect();
    scene
}

/// Two to eight boxes, flush with each other, that are declared one surface, under any toucher.
fn joint(random: &mut Random, name: &'static str) -> Scene {
    let is_round = random.chance(0.35);
    let half = solids::extents(random, is_round);
    let divided = [random.chance(0.8), random.chance(0.5), random.chance(0.3)];
    let seam = Vec3::from_fn(|axis, _| {
        let part = if is_round { 0.0 } else { random.between(-0.5, 0.5) };
        if divided[axis] || axis == 0 { half[axis] * part } else { half[axis] }
    });
    let mut touched = Vec::new();
    for corner in 0..8 {
        let is_upper = |axis: usize| corner >> axis & 1 == 1;
        let low = Vec3::from_fn(|axis, _| if is_upper(axis) { seam[axis] } else { -half[axis] });
        let high = Vec3::from_fn(|axis, _| if is_upper(axis) { half[axis] } else { seam[axis] });
        if (high - low).min() > 0.0 {
            touched.push(Shape::Polyhedron(solids::cuboid(&low, &high)));
        }
    }
    if !is_round && random.chance(0.6) {
        let pose = Pose { position: random.vector(1.0), orientation: random.orientation() };
        touched = touched.iter().map(|shape| shape.carried(&pose)).collect();
    }
    let touching = assembly::touching(random, &["Point", "LineSegment", "Sphere", "Ellipsoid"], is_round);
    let size = assembly::unit_of_length(random);
    let [a, b] = assembly::surfaces(random, size);
    let mut bodies = [Body::new(touching, a), Body::new(touched, b)];
    bodies[1].is_one_surface = true;
    assembly::with_history(random, name, bodies, size, is_round)
}
