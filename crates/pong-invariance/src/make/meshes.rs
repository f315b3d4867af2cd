//! Triangle meshes: plates, valleys, ridges, bowls, sheets, surfaces of solids, slivers.

use crate::random::Random;
use crate::scene::{Mesh, Solid};
use pong_geometry::Vec3;

/// A rectangular grid of cells, each cut in two, with heights from a function of x and y.
pub fn grid(random: &mut Random, xs: &[f64], ys: &[f64], height: impl Fn(f64, f64) -> f64) -> Mesh {
    let mut mesh = Mesh::default();
    for y in ys {
        mesh.vertices.extend(xs.iter().map(|x| Vec3::new(*x, *y, height(*x, *y))));
    }
    let columns = xs.len();
    for row in 0..ys.len() - 1 {
        for column in 0..columns - 1 {
            let [a, b] = [0, 1].map(|i| row * columns + column + i);
            let [d, c] = [a + columns, b + columns];
            match random.chance(0.5) {
                true => mesh.triangles.extend([[a, b, c], [a, c, d]]),
                false => mesh.triangles.extend([[a, b, d], [b, c, d]]),
            }
        }
    }
    mesh
}

/// Rising coordinates from −1 to 1, evenly spaced or not.
pub fn places(random: &mut Random, cells: usize, is_round: bool) -> Vec<f64> {
    let jitter = if is_round { 0.0 } else { 0.35 };
    let place = |i: usize, off: f64| -1.0 + 2.0 * (i as f64 + off) / cells as f64;
    (0..=cells)
        .map(|i| place(i, if i == 0 || i == cells { 0.0 } else { random.between(-jitter, jitter) }))
        .collect()
}

/// A flat plate.
pub fn plate(random: &mut Random, is_round: bool) -> Mesh {
    let cells = [1 + random.below(3), 1 + random.below(3)];
    let [xs, ys] = cells.map(|count| places(random, count, is_round));
    grid(random, &xs, &ys, |_, _| 0.0)
}

/// Two flat halves that meet at an angle along y: up from the fold (a valley) or down (a ridge).
pub fn fold(random: &mut Random, slope: f64, is_round: bool) -> Mesh {
    let xs = if random.chance(0.7) { vec![-1.0, 0.0, 1.0] } else { vec![-1.0, -0.5, 0.0, 0.25, 1.0] };
    let cells = 1 + random.below(3);
    let ys = places(random, cells, is_round);
    grid(random, &xs, &ys, |x, _| slope * x.abs())
}

/// Triangles around one vertex, with the boundary higher or lower by a slope.
pub fn fan(random: &mut Random, slope: f64, is_round: bool) -> Mesh {
    let sides = 3 + random.below(6);
    let uneven = if is_round { 0.0 } else { 0.3 };
    let mut mesh = Mesh { vertices: vec![Vec3::zeros()], ..Mesh::default() };
    for angle in super::solids::angles(random, sides, is_round) {
        let height = slope * (1.0 + random.between(-uneven, uneven));
        mesh.vertices.push(Vec3::new(libm::cos(angle), libm::sin(angle), height));
    }
    mesh.triangles = (0..sides).map(|i| [0, i + 1, (i + 1) % sides + 1]).collect();
    mesh
}

/// A wavy sheet.
pub fn sheet(random: &mut Random, cells: usize) -> Mesh {
    let [xs, ys] = [0, 1].map(|_| places(random, cells, false));
    let [height, length, phase] =
        [random.between(0.01, 0.3), random.between(1.0, 6.0), random.between(0.0, 6.0)];
    grid(random, &xs, &ys, |x, y| height * libm::sin(length * x + phase) * libm::cos(length * y))
}

/// A flat plate with long thin triangles across it.
pub fn slivers(random: &mut Random) -> Mesh {
    let thin = random.log_between(1e-5, 1e-2);
    let middle = random.between(-0.5, 0.5);
    let mut ys = vec![-1.0, middle, middle + thin, 1.0];
    if random.chance(0.5) {
        ys.insert(3, middle + 2.0 * thin);
    }
    let xs = if random.chance(0.5) { vec![-1.0, 1.0] } else { vec![-1.0, random.between(-0.5, 0.5), 1.0] };
    grid(random, &xs, &ys, |_, _| 0.0)
}

/// The surface mesh of a solid.
pub fn skin(solid: &Solid) -> Mesh {
    let fan =
        |face: &Vec<usize>| -> Vec<_> { (2..face.len()).map(|i| [face[0], face[i - 1], face[i]]).collect() };
    Mesh {
        vertices: solid.vertices.clone(),
        triangles: solid.faces.iter().flat_map(fan).collect(),
        ..Mesh::default()
    }
}
