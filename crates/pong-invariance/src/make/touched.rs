//! Touched bodies: every kind of B, and the ways in which its faces can meet.

use super::{meshes, solids};
use crate::cutting;
use crate::random::Random;
use crate::scene::{Mesh, Shape, Solid};
use pong_geometry::{Pose, Vec3};

/// Generator of the primitives of B, about 1 m large.
pub type Make = fn(&mut Random, bool) -> Vec<Shape>;

/// Every family of scenes.
pub const FAMILIES: &[(&str, Make)] = &[
    ("plane", plane),
    ("ball", ball),
    ("egg", egg),
    ("solid", solid),
    ("hull", |random, _| vec![Shape::Polyhedron(solids::random_hull(random))]),
    ("pieces", pieces),
    ("junction", junction),
    ("plate", |random, is_round| mesh(random, meshes::plate, is_round)),
    ("slivers", |random, is_round| mesh(random, |random, _| meshes::slivers(random), is_round)),
    ("valley", |random, is_round| mesh(random, valley, is_round)),
    ("ridge", |random, is_round| mesh(random, ridge, is_round)),
    ("bowl", |random, is_round| mesh(random, bowl, is_round)),
    ("skin", |random, is_round| mesh(random, skin, is_round)),
    ("sheet", |random, is_round| mesh(random, sheet, is_round)),
];

pub(super) fn plane(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let normal = if is_round { Vec3::z() } else { random.direction() };
    vec![Shape::Plane { normal, offset: if is_round { 0.0 } else { random.between(-1.0, 1.0) } }]
}

fn ball(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let radius = if is_round { 1.0 } else { random.between(0.3, 1.0) };
    vec![Shape::Sphere { center: if is_round { Vec3::zeros() } else { random.vector(0.5) }, radius }]
}

fn egg(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let semi_axes = match is_round {
        true => Vec3::new(1.0, 0.5, 0.25),
        false => Vec3::from_fn(|_, _| random.log_between(0.1, 1.0)),
    };
    vec![Shape::Ellipsoid {
        center: Vec3::zeros(),
        semi_axes,
        orientation: nalgebra::UnitQuaternion::identity(),
    }]
}

pub(super) fn solid(random: &mut Random, is_round: bool) -> Vec<Shape> {
    vec![Shape::Polyhedron(solids::any(random, is_round))]
}

/// A box or a prism cut by one to three planes.
pub(super) fn pieces(random: &mut Random, is_round: bool) -> Vec<Shape> {
    loop {
        let mut parts = vec![solids::any(random, is_round)];
        for _ in 0..1 + random.below(3) {
            let normal = match is_round || random.chance(0.3) {
                true => random.pick(&[Vec3::x(), Vec3::y(), Vec3::z()]),
                false => random.direction(),
            };
            let offset = if is_round { 0.0 } else { random.between(-0.3, 0.3) };
            if let Some(cut) = cutting::cut_all(&parts, &normal, offset) {
                parts = cut;
            }
        }
        if parts.len() > 1 {
            return parts.into_iter().map(Shape::Polyhedron).collect();
        }
    }
}

/// Two to eight wedges around a common line.
pub(super) fn junction(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let count = 2 + random.below(7);
    let half = if is_round { 0.5 } else { random.between(0.2, 1.0) };
    wedges(random, count, half, is_round).into_iter().map(Shape::Polyhedron).collect()
}

/// A prism about z divided into wedges that meet in its axis: each has one side, or two if there are two or
/// three.
pub fn wedges(random: &mut Random, count: usize, half: f64, is_round: bool) -> Vec<Solid> {
    // With two or three pieces, a wedge of one side would not be convex, or not contain the axis.
    let sides_each = if count < 4 { 2 } else { 1 };
    let sides = count * sides_each;
    // Two wedges meet in a plane through the axis; otherwise one of them would not be convex.
    let angles = solids::angles(random, sides, is_round || count == 2);
    let rim = |index: usize, z: f64| {
        let angle = angles[index % sides];
        Vec3::new(libm::cos(angle), libm::sin(angle), z)
    };
    (0..count)
        .map(|piece| {
            let first = piece * sides_each;
            let corners = sides_each + 2;
            let ring = |z: f64| {
                let rims: Vec<_> = (0..=sides_each).map(|k| rim(first + k, z)).collect();
                std::iter::once(Vec3::new(0.0, 0.0, z)).chain(rims)
            };
            let vertices: Vec<Vec3> = ring(-half).chain(ring(half)).collect();
            let mut faces = vec![(0..corners).rev().collect::<Vec<_>>(), (corners..2 * corners).collect()];
            faces.extend((0..corners).map(|i| {
                let j = (i + 1) % corners;
                vec![i, j, corners + j, corners + i]
            }));
            Solid { vertices, faces, inactive: vec![2, 1 + corners] }
        })
        .collect()
}

pub(super) fn mesh(random: &mut Random, make: fn(&mut Random, bool) -> Mesh, is_round: bool) -> Vec<Shape> {
    let mut mesh = make(random, is_round);
    mesh.two_sided = random.chance(0.2);
    if random.chance(0.3) {
        mesh.thickness = Some(random.log_between(0.01, 2.0));
    }
    vec![Shape::Mesh(mesh)]
}

/// Slopes from rounding-sized to steep.
fn slope(random: &mut Random, is_round: bool) -> f64 {
    match random.below(4) {
        0 => random.log_between(1e-10, 1e-3),
        1 => random.between(0.001, 0.5),
        2 if is_round => random.pick(&[0.5, 1.0, 2.0]),
        _ => random.between(0.5, 4.0),
    }
}

pub(super) fn valley(random: &mut Random, is_round: bool) -> Mesh {
    let slope = slope(random, is_round);
    meshes::fold(random, slope, is_round)
}

pub(super) fn ridge(random: &mut Random, is_round: bool) -> Mesh {
    let slope = -slope(random, is_round);
    meshes::fold(random, slope, is_round)
}

pub(super) fn bowl(random: &mut Random, is_round: bool) -> Mesh {
    let sign = random.pick(&[1.0, 1.0, -1.0]);
    let slope = sign * slope(random, is_round);
    meshes::fan(random, slope, is_round)
}

pub(super) fn skin(random: &mut Random, is_round: bool) -> Mesh {
    meshes::skin(&solids::any(random, is_round))
}

pub(super) fn sheet(random: &mut Random, _: bool) -> Mesh {
    // Two to a few hundred triangles, occasionally 20,000.
    let cells = if random.chance(2e-3) { 100 } else { random.log_between(1.0, 12.0) as usize };
    meshes::sheet(random, cells)
}

/// In some scenes, turns and moves the primitives in their group, and rounds their corners to single
/// precision.
pub fn tilt(random: &mut Random, shapes: &mut Vec<Shape>, is_round: bool) {
    if !is_round && random.chance(0.6) {
        let shift = if random.chance(0.5) { Vec3::zeros() } else { random.vector(1.0) };
        let pose = Pose { position: shift, orientation: random.orientation() };
        *shapes = shapes.iter().map(|shape| shape.carried(&pose)).collect();
    }
    if random.chance(0.3) {
        for shape in shapes {
            match shape {
                Shape::Round(part) => *part = part.in_single_precision(),
                _ => shape.vertices_mut().iter_mut().for_each(|v| *v = v.map(|x| f64::from(x as f32))),
            }
        }
    }
}
