//! Histories: contact point of A on B in each frame, and depth.

pub use super::round_path::Foot;
use super::round_path::{first_orientation_of_round, foot_on_round};
use crate::random::{Random, rotation_between};
use crate::scene::{Scene, Shape};
use pong_engine::State;
use pong_geometry::{Pose, Quat, Twist, Vec3};

/// A point of a primitive: in a face, on an edge (a seam, the end of an internal face), on a corner (a
/// junction).
pub fn foot(random: &mut Random, shapes: &[Shape], is_round: bool) -> Foot {
    let shape = &shapes[random.below(shapes.len())];
    match shape {
        Shape::Plane { normal, offset } => {
            let normal = normal.normalize();
            let along = random.across(&normal) * if is_round { 0.0 } else { random.between(0.0, 1.0) };
            Foot { place: normal * *offset + along, normal }
        }
        Shape::Sphere { center, radius } => {
            let normal = if is_round { Vec3::z() } else { random.direction() };
            Foot { place: center + normal * *radius, normal }
        }
        Shape::Ellipsoid { center, semi_axes, orientation } => {
            let n = if is_round { Vec3::z() } else { random.direction() };
            Foot { place: center + orientation * support(semi_axes, &n), normal: orientation * n }
        }
        Shape::Polyhedron(solid) => {
            let active: Vec<_> =
                (0..solid.faces.len()).filter(|face| !solid.inactive.contains(face)).collect();
            let face = &solid.faces[random.pick(&active)];
            on_face(random, shapes, &corners(&solid.vertices, face), is_round)
        }
        Shape::Mesh(mesh) => {
            let triangle = random.pick(&mesh.triangles);
            on_face(random, shapes, &corners(&mesh.vertices, &triangle), is_round)
        }
        Shape::Round(part) => foot_on_round(random, part, is_round),
        Shape::Point { .. } | Shape::Segment { .. } | Shape::Ray { .. } => {
            Foot { place: Vec3::zeros(), normal: Vec3::z() }
        }
    }
}

fn corners(vertices: &[Vec3], face: &[usize]) -> Vec<Vec3> {
    face.iter().map(|index| vertices[*index]).collect()
}

/// The unit normal of a polygon.
pub fn normal_of(corners: &[Vec3]) -> Vec3 {
    let sum = |at: usize| (corners[at] - corners[0]).cross(&(corners[at + 1] - corners[0]));
    (1..corners.len() - 1).map(sum).sum::<Vec3>().normalize()
}

fn on_face(random: &mut Random, shapes: &[Shape], corners: &[Vec3], is_round: bool) -> Foot {
    let at = random.below(corners.len());
    let (from, to) = (corners[at], corners[(at + 1) % corners.len()]);
    let t = if is_round { random.pick(&[0.25, 0.5, 0.75]) } else { random.unit() };
    let mut normal = normal_of(corners);
    let place = match random.below(5) {
        0 | 1 => {
            let weights: Vec<f64> =
                corners.iter().map(|_| if is_round { 1.0 } else { random.between(0.01, 1.0) }).collect();
            let sum: f64 = weights.iter().sum();
            corners.iter().zip(&weights).map(|(corner, weight)| corner * (weight / sum)).sum()
        }
        2 | 3 => from + (to - from) * t,
        _ => from,
    };
    // On a boundary edge the contact normal may lie between the normals of the adjacent faces.
    if random.chance(0.3) {
        let others = faces_at(shapes, &from);
        let mix: Vec3 = others.iter().map(|n| n * random.unit()).sum::<Vec3>() + normal * 0.1;
        if mix.norm() > 0.1 {
            normal = mix.normalize();
        }
    }
    Foot { place, normal }
}

/// Normals of all active faces that share a corner.
fn faces_at(shapes: &[Shape], corner: &Vec3) -> Vec<Vec3> {
    let mut normals = Vec::new();
    for shape in shapes {
        match shape {
            Shape::Polyhedron(solid) => {
                for (index, face) in solid.faces.iter().enumerate() {
                    let corners = corners(&solid.vertices, face);
                    if !solid.inactive.contains(&index) && corners.contains(corner) {
                        normals.push(normal_of(&corners));
                    }
                }
            }
            // Large meshes are skipped: the search would take longer than the scene.
            Shape::Mesh(mesh) if mesh.triangles.len() < 1000 => {
                let all = mesh.triangles.iter().map(|triangle| self::corners(&mesh.vertices, triangle));
                normals.extend(all.filter(|corners| corners.contains(corner)).map(|c| normal_of(&c)));
            }
            _ => {}
        }
    }
    normals
}

/// Support point of an origin-centred ellipsoid along a direction, in its own axes.
pub fn support(semi_axes: &Vec3, n: &Vec3) -> Vec3 {
    let scaled = semi_axes.component_mul(n);
    semi_axes.component_mul(&scaled) / scaled.norm()
}

/// Largest reasonable depth of A, m.
fn depth_size(shape: &Shape) -> f64 {
    match shape {
        Shape::Sphere { radius, .. } => *radius,
        Shape::Ellipsoid { semi_axes, .. } => semi_axes.min(),
        Shape::Ray { length, .. } => *length,
        Shape::Round(part) => part.widest(),
        _ => 0.2,
    }
}

/// Pose of A's group relative to B's for which its first primitive touches a contact point at a depth.
pub fn stand(shape: &Shape, orientation: &Quat, foot: &Foot, depth: f64, end: usize) -> Pose {
    let down = orientation.inverse() * -foot.normal;
    let lowest = match shape {
        Shape::Point { position } => *position,
        Shape::Segment { ends } => match end {
            0 | 1 => ends[end],
            _ => (ends[0] + ends[1]) * 0.5,
        },
        Shape::Ray { origin, direction, length, .. } => origin + direction.normalize() * *length,
        Shape::Sphere { center, radius } => center + down * *radius,
        Shape::Ellipsoid { center, semi_axes, orientation } => {
            center + orientation * support(semi_axes, &(orientation.inverse() * down))
        }
        Shape::Round(part) => part.lowest(&down, end),
        Shape::Polyhedron(solid) => {
            let heights = |p: &&Vec3, q: &&Vec3| down.dot(p).total_cmp(&down.dot(q));
            solid.vertices.iter().max_by(heights).copied().unwrap_or_default()
        }
        Shape::Mesh(mesh) => {
            let heights = |p: &&Vec3, q: &&Vec3| down.dot(p).total_cmp(&down.dot(q));
            mesh.vertices.iter().max_by(heights).copied().unwrap_or_default()
        }
        Shape::Plane { .. } => Vec3::zeros(),
    };
    let position = foot.place - foot.normal * depth - orientation * lowest;
    Pose { position, orientation: *orientation }
}

/// First orientation of A: a plunger against the face, a bar often along it.
fn first_orientation(random: &mut Random, shape: &Shape, foot: &Foot, is_round: bool) -> Quat {
    match shape {
        Shape::Ray { direction, .. } => {
            let tilt = if is_round { Quat::identity() } else { random.small_rotation(1.0) };
            rotation_between(&(tilt * direction.normalize()), &-foot.normal) * tilt
        }
        Shape::Segment { ends } if random.chance(0.7) => {
            let along = (ends[1] - ends[0]).normalize();
            let across = random.across(&foot.normal);
            let tilt = if random.chance(0.3) { 0.0 } else { random.between(-0.3, 0.3) };
            rotation_between(&along, &(across + foot.normal * tilt).normalize())
        }
        // A face of a solid flush with the face below it.
        Shape::Polyhedron(solid) if !is_round && random.chance(0.5) => {
            let face = corners(&solid.vertices, &solid.faces[random.below(solid.faces.len())]);
            rotation_between(&normal_of(&face), &-foot.normal)
        }
        _ if is_round => Quat::identity(),
        _ => random.orientation(),
    }
}

/// States of both groups, frame by frame.
pub fn history(random: &mut Random, scene: &Scene, is_round: bool) -> Vec<[State; 2]> {
    let shape = &scene.bodies[0].shapes[0];
    let shapes = &scene.bodies[1].shapes;
    let mut here = foot(random, shapes, is_round);
    let mut orientation = first_orientation_of_round(random, [shape, &shapes[0]], &here, is_round)
        .unwrap_or_else(|| first_orientation(random, shape, &here, is_round));
    let mut x_wb = match is_round || random.chance(0.4) {
        true => Pose::identity(),
        false => Pose { position: random.vector(1.0), orientation: random.orientation() },
    };
    let moves_b = !is_round && random.chance(0.5);
    let is_moving = random.chance(0.6);
    let depth_size = depth_size(shape);
    let end = random.below(3);
    let count = 1 + random.below(6);
    let comes_from_outside = random.chance(0.6);
    (0..count)
        .map(|frame| {
            let depth = match frame {
                0 if comes_from_outside => -random.between(0.01, 0.5),
                _ => depth_size * depth_part(random, is_round),
            };
            let x_ba = stand(shape, &orientation, &here, depth, end);
            let mut twist = || match is_moving {
                true => Twist { linear: random.vector(1.0), angular: random.vector(1.0) },
                false => Twist { linear: Vec3::zeros(), angular: Vec3::zeros() },
            };
            let twists = [twist(), twist()];
            let states =
                [State::from_motion(&x_wb.compose(&x_ba), &twists[0]), State::from_motion(&x_wb, &twists[1])];
            match random.below(5) {
                0 | 1 => {}
                2 => here = foot(random, shapes, is_round),
                3 => {
                    // A small slide, along which friction sticks and breaks away.
                    let slide = random.across(&here.normal) * random.log_between(1e-4, 0.1);
                    here.place += slide;
                }
                _ if is_round => {}
                _ => orientation = random.small_rotation(0.3) * orientation,
            }
            if moves_b {
                x_wb.position += random.vector(0.05);
                x_wb.orientation = random.small_rotation(0.1) * x_wb.orientation;
            }
            states
        })
        .collect()
}

fn depth_part(random: &mut Random, is_round: bool) -> f64 {
    match random.below(8) {
        0 => random.log_between(1e-6, 1e-2),
        1..=4 if is_round => random.pick(&[0.125, 0.25, 0.5]),
        1..=4 => random.between(0.01, 0.5),
        5 => random.between(0.5, 1.5),
        6 => -random.between(0.001, 0.1),
        _ => random.between(0.1, 1.0),
    }
}
