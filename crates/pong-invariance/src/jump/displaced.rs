//! Small displacements of a scene: of its states and of the numbers of its shapes.

use crate::random::Random;
use crate::scene::{Scene, Shape};
use pong_engine::State;
use pong_geometry::{Pose, Quat, Vec3};
use std::collections::BTreeMap;

/// The history with A displaced by `step` sizes of the scene and rotated by `step` rad, the same in all
/// frames or different in each.
pub fn beside(
    frames: &[[State; 2]],
    step: f64,
    size: f64,
    is_same: bool,
    random: &mut Random,
) -> Vec<[State; 2]> {
    let mut any = || (random.vector(step * size), random.vector(step));
    let same = any();
    let shifted = |state: &State, (shift, turn): (Vec3, Vec3)| {
        let pose = state.pose();
        let pose =
            Pose { position: pose.position + shift, orientation: little_turn(&turn) * pose.orientation };
        State::from_motion(&pose, &state.twist())
    };
    frames.iter().map(|[a, b]| [shifted(a, if is_same { same } else { any() }), *b]).collect()
}

/// The scene with every length of its shapes displaced by up to `longest` sizes, and every direction rotated
/// by as much; solids stay as they are. Bit-equal corners are displaced alike, which keeps adjacent shapes
/// connected. Some are displaced by much less than others, down to `shortest`: of two coincident surfaces,
/// one then moves alone.
pub fn reshaped(scene: &Scene, (shortest, longest): (f64, f64), random: &mut Random) -> Scene {
    let mut reshaped = scene.clone();
    let step = |random: &mut Random| random.log_between(shortest, longest);
    let length = |random: &mut Random| step(random) * scene.size;
    let point = |p: &mut Vec3, random: &mut Random| {
        let length = length(random);
        *p += random.vector(length);
    };
    let mut moved: BTreeMap<[u64; 3], Vec3> = BTreeMap::new();
    let mut corner = |p: &mut Vec3, random: &mut Random| {
        let place = [p.x, p.y, p.z].map(f64::to_bits);
        *p = *moved.entry(place).or_insert_with(|| {
            point(p, random);
            *p
        });
    };
    let longer = |x: &mut f64, random: &mut Random| {
        let length = length(random);
        *x += random.between(-length, length);
    };
    // A cylinder's two radii are equal, and holes that meet share one.
    let mut widened: BTreeMap<u64, f64> = BTreeMap::new();
    let mut wider = |radius: &mut f64, random: &mut Random| {
        let told = *radius;
        *radius = *widened.entry(told.to_bits()).or_insert_with(|| {
            let mut other = told;
            longer(&mut other, random);
            if told > 0.0 { other } else { told }
        });
    };
    let turn = |random: &mut Random| {
        let step = step(random);
        little_turn(&random.vector(step))
    };
    for shape in reshaped.bodies.iter_mut().flat_map(|body| &mut body.shapes) {
        match shape {
            Shape::Point { position } => point(position, random),
            Shape::Segment { ends } => ends.iter_mut().for_each(|end| point(end, random)),
            Shape::Ray { origin, direction, length, .. } => {
                point(origin, random);
                *direction = turn(random) * *direction;
                longer(length, random);
            }
            Shape::Sphere { center, radius } => {
                point(center, random);
                longer(radius, random);
            }
            Shape::Ellipsoid { center, semi_axes, orientation } => {
                point(center, random);
                semi_axes.iter_mut().for_each(|axis| longer(axis, random));
                *orientation = turn(random) * *orientation;
            }
            Shape::Plane { normal, offset } => {
                *normal = turn(random) * *normal;
                longer(offset, random);
            }
            // Displaced corners would leave faces non-planar and open cracks between pieces.
            Shape::Polyhedron(_) => {}
            Shape::Mesh(_) | Shape::Round(_) => {
                if let Shape::Round(part) = shape {
                    part.radii.iter_mut().for_each(|radius| wider(radius, random));
                }
                shape.vertices_mut().iter_mut().for_each(|vertex| corner(vertex, random));
            }
        }
    }
    reshaped
}

fn little_turn(turn: &Vec3) -> Quat {
    Quat::new_normalize(nalgebra::Quaternion::new(1.0, 0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z))
}
