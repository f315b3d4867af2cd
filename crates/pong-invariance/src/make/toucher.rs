//! Touching primitives: point, segment, ray, sphere, ellipsoid.

use crate::random::Random;
use crate::scene::Shape;
use pong_geometry::{Quat, Vec3};

/// A primitive of one of these kinds, of size about 1.
pub fn toucher(random: &mut Random, kinds: &[&str], is_round: bool) -> Shape {
    let place = if is_round || random.chance(0.5) { Vec3::zeros() } else { random.vector(0.5) };
    let size = if is_round { random.pick(&[0.25, 0.5, 1.0]) } else { random.log_between(0.05, 1.0) };
    match random.pick(kinds) {
        "Point" => Shape::Point { position: place },
        "LineSegment" => {
            let along = if is_round { Vec3::x() } else { random.direction() };
            Shape::Segment { ends: [place - along * size, place + along * size] }
        }
        "Ray" => {
            let direction = if is_round { -Vec3::z() } else { random.direction() };
            Shape::Ray { origin: place, direction, length: size, axial: random.chance(0.4) }
        }
        "Sphere" => Shape::Sphere { center: place, radius: size },
        _ => {
            let part = |random: &mut Random| {
                if is_round { random.pick(&[0.5, 0.75, 1.0]) } else { random.between(0.25, 1.0) }
            };
            let semi_axes = Vec3::from_fn(|_, _| size * part(random));
            let orientation = if is_round { Quat::identity() } else { random.orientation() };
            Shape::Ellipsoid { center: place, semi_axes, orientation }
        }
    }
}
