//! Times of the overlap of two solids. To print the table:
//! `cargo test --release -p pong-geometry --test it overlap_timing -- --ignored --nocapture`

use crate::common::{Random, cuboid, hull};
use crate::overlap::{half_spaces, surface};
use pong_geometry::overlap::{Field, HalfSpace, Overlap, Surface};
use pong_geometry::primitive::Polyhedron;
use pong_geometry::{Mat3, Transform, Twist, Vec3};
use std::hint::black_box;
use std::time::Instant;

/// Runs per pose.
const PASSES: usize = 60;

/// Solid with its surface and its faces, both in its own frame.
struct Shape {
    surface: Surface,
    faces: Vec<HalfSpace>,
}

fn shape(polyhedron: &Polyhedron) -> Shape {
    Shape { surface: surface(polyhedron, &Transform::identity()), faces: half_spaces(polyhedron) }
}

/// Hull of triangles whose corners lie on a unit sphere: `2·points − 4` faces.
fn round(points: usize, seed: u64) -> Shape {
    let mut random = Random::new(47, 0, seed);
    let corners: Vec<Vec3> = crate::common::fibonacci_sphere(points)
        .iter()
        .map(|corner| (corner + 0.2 * random.direction()).normalize())
        .collect();
    shape(&hull(&corners))
}

/// Returns the mean over the poses of the least time of several runs, ns. Other programs that run meanwhile
/// disturb the least time of a single pose less than that of all poses together.
fn time(poses: &[Transform], mut run: impl FnMut(&Transform)) -> f64 {
    let mut least = vec![f64::INFINITY; poses.len()];
    for _ in 0..PASSES {
        for (pose, least) in poses.iter().zip(&mut least) {
            let start = Instant::now();
            run(pose);
            *least = least.min(start.elapsed().as_secs_f64() * 1e9);
        }
    }
    least.iter().sum::<f64>() / poses.len() as f64
}

/// Prints the time of both fields of pairs, `distance` between their centres.
fn row(name: &str, [a, b]: [&Shape; 2], distance: f64, turned: bool) {
    if std::env::var("ROW").is_ok_and(|row| !name.contains(&row)) {
        return;
    }
    let mut random = Random::new(47, 1, 0);
    let pose = |_| {
        let rotation = if turned { random.rotation_matrix() } else { Mat3::identity() };
        let direction = if turned { random.direction() } else { Vec3::z() };
        Transform { translation: direction * distance, rotation }
    };
    let poses: Vec<Transform> = (0..32).map(pose).collect();
    let mut overlap = Overlap::with_capacity(a.faces.len() + b.faces.len());
    let mut count = 0;
    let velocity = Twist::zero();
    let cells = time(&poses, |x| {
        let b_field = Field { faces: &b.faces, walls: &[] };
        let a_field = Field { faces: &a.faces, walls: &[] };
        count += overlap.cells(&a.surface, x, &b_field, &velocity).len();
        count += overlap.cells(&b.surface, &x.inverse(), &a_field, &velocity).len();
    });
    let apart = time(&poses, |x| {
        black_box(Overlap::apart(&a.surface, x, &Field { faces: &b.faces, walls: &[] }));
    });
    let count = count as f64 / (PASSES * poses.len()) as f64;
    println!("{name:32} {cells:9.0} ns, {count:5.1} cells; apart {apart:6.0} ns");
}

#[test]
#[ignore = "prints times"]
fn times_of_both_fields() {
    let cube = shape(&cuboid(Vec3::repeat(-0.5), Vec3::repeat(0.5)));
    row("boxes, flat, flush", [&cube, &cube], 0.99, false);
    let foot = shape(&cuboid(Vec3::new(-0.2, -0.3, -0.5), Vec3::new(0.2, 0.3, 0.5)));
    row("boxes, flat, one inside", [&foot, &cube], 0.99, false);
    row("boxes, turned, shallow", [&cube, &cube], 1.1, true);
    row("boxes, apart", [&cube, &cube], 3.0, true);
    for faces in [12, 32, 64] {
        let (a, b) = (round(faces / 2 + 2, 1), round(faces / 2 + 2, 2));
        for (name, distance) in [("shallow", 1.9), ("typical", 1.8), ("deep", 1.0), ("centred", 0.1)] {
            let shrunk = if faces == 12 { distance * 0.85 } else { distance * 0.95 };
            row(&format!("hulls of {faces} faces, {name}"), [&a, &b], shrunk, true);
        }
    }
}
