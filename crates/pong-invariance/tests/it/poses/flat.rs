//! A flat face that presses on another, or on a plane, like a punch.

use super::solid_pair::{Bodies, Kind, SolidWorld, Start, Variant};
use super::{LEVER, PUNCH, difference, survey};
use pong_geometry::{Pose, Quat, Vec3, Wrench};
use pong_invariance::make::path;
use pong_invariance::random::{Random, rotation_about, rotation_between};
use pong_invariance::scene::Shape;

/// Corners of a random face of a body.
fn face(shapes: &[Shape], random: &mut Random) -> Vec<Vec3> {
    let Shape::Polyhedron(solid) = &shapes[0] else { panic!("a solid") };
    solid.faces[random.below(solid.faces.len())].iter().map(|index| solid.vertices[*index]).collect()
}

/// Part of a flat polygon within another in the same plane, whose outward normal is `normal`.
fn within(polygon: &[Vec3], other: &[Vec3], normal: &Vec3) -> Vec<Vec3> {
    let mut part = polygon.to_vec();
    for (at, from) in other.iter().enumerate() {
        let inward = normal.cross(&(other[(at + 1) % other.len()] - from));
        let height = |x: &Vec3| inward.dot(&(x - from));
        let mut cut = Vec::new();
        for (at, x) in part.iter().enumerate() {
            let next = part[(at + 1) % part.len()];
            let (here, there) = (height(x), height(&next));
            if here >= 0.0 {
                cut.push(*x);
            }
            if here * there < 0.0 {
                cut.push(x + (next - x) * (here / (here - there)));
            }
        }
        part = cut;
    }
    part
}

/// Area of a flat polygon, m², its centroid, and for lines u in its plane through it the second moment u·(J·u), m⁴.
fn moments(polygon: &[Vec3], normal: &Vec3) -> (f64, Vec3, pong_geometry::Mat3) {
    let start = polygon[0];
    let triangle = |at: usize| [start, polygon[at], polygon[at + 1]];
    let area_of = |[p, q, r]: [Vec3; 3]| 0.5 * (q - p).cross(&(r - p)).dot(normal).abs();
    let triangles = || (1..polygon.len() - 1).map(triangle);
    let area: f64 = triangles().map(area_of).sum();
    let centroid = triangles().map(|[p, q, r]| (p + q + r) * (area_of([p, q, r]) / 3.0)).sum::<Vec3>() / area;
    // Three points in the middle of the sides integrate a square exactly.
    let second = triangles()
        .map(|[p, q, r]| {
            let arms = [p + q, q + r, r + p].map(|sum| (sum * 0.5 - centroid).cross(normal));
            arms.iter().map(|arm| arm * arm.transpose()).sum::<pong_geometry::Mat3>()
                * (area_of([p, q, r]) / 3.0)
        })
        .sum();
    (area, centroid, second)
}

/// A flat face of area a at a depth δ carries K·a·δ through the centroid, and tilted by θ has the moment K·I·θ. The error is
/// that of both, relative to K·a·δ and over δ/√a.
fn measure(
    bodies: &Bodies,
    world: &mut SolidWorld,
    frame: &Pose,
    depth: f64,
    random: &mut Random,
) -> Option<f64> {
    let of_a = face(&bodies.shapes[0].whole, random);
    let of_b = match &bodies.shapes[1].whole[0] {
        Shape::Plane { .. } => {
            [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]].map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec()
        }
        _ => face(&bodies.shapes[1].whole, random),
    };
    let normal = path::normal_of(&of_b);
    let flat = rotation_between(&path::normal_of(&of_a), &-normal);
    let orientation = rotation_about(&normal, random.between(-3.0, 3.0)) * flat;
    let weights: Vec<f64> = of_b.iter().map(|_| random.between(0.1, 1.0)).collect();
    let place = of_b.iter().zip(&weights).map(|(corner, weight)| corner * *weight).sum::<Vec3>()
        / weights.iter().sum::<f64>();
    let middle = of_a.iter().sum::<Vec3>() / of_a.len() as f64;
    let position = place - orientation * middle;
    let here = Pose { position, orientation };
    let turned: Vec<Vec3> = of_a.iter().map(|corner| here.orientation * corner + here.position).collect();
    let shared = within(&turned, &of_b, &normal);
    if shared.len() < 3 {
        return None;
    }
    let (area, centroid, second) = moments(&shared, &normal);
    if area < 1e-3 {
        return None;
    }
    let depth = depth * area.sqrt();
    // Turned about the centroid.
    let theta = random.across(&normal) * (0.3 * random.unit() * depth / area.sqrt());
    let tilt = Quat::from_scaled_axis(theta);
    let arm = tilt * (position - centroid);
    let tilted = Pose { position: centroid + arm - normal * depth, orientation: tilt * orientation };
    let poses = [frame.compose(&tilted), *frame];
    if bodies.remembers {
        world.begin(&Start { here: poses, normal: frame.orientation * normal });
    }
    let (found, _) = world.at(&poses);
    let force = normal * (bodies.modulus() * area * depth);
    let about_centroid = second * theta * -bodies.modulus();
    let expected = Wrench {
        force: frame.orientation * force,
        moment: frame.orientation * (about_centroid - arm.cross(&force)),
    };
    let rounding = 64.0 * f64::EPSILON * (frame.position.norm() + 2.0) * bodies.modulus() * bodies.area();
    let error = (difference(&found, &expected) - rounding).max(0.0) / force.norm();
    Some(error / (depth / area.sqrt()) / LEVER)
}

/// Largest error over δ/√a. The volume beside the rim, ½·δ²·cot α for each length of an edge of the inner angle α, grows
/// without bound where a neighbouring face is nearly in the plane of the face: 90 is reached by one pose of a hundred.
const RIM: f64 = 1e5;

/// A flat face presses like a punch.
fn punch(kind: Kind) {
    survey(PUNCH, kind, RIM, |bodies, [world, _], start: &Start, random| {
        // Single precision bends a face by up to 1e-7 of its size.
        let is_bent = bodies.variant == Variant::SinglePrecision;
        measure(bodies, world, &start.here[1], if is_bent { 1e-4 } else { 1e-6 }, random)
    });
}

#[test]
fn flat_face_presses_on_a_plane_like_a_punch() {
    punch(Kind::OnPlane);
}

#[test]
fn flat_faces_of_boxes_press_like_a_punch() {
    punch(Kind::BoxOnBox);
}

#[test]
fn flat_faces_of_hulls_press_like_a_punch() {
    punch(Kind::HullOnHull);
}
