//! Convex solids.

use crate::random::Random;
use crate::scene::Solid;
use pong_geometry::Vec3;

/// A box between two corners.
pub fn cuboid(low: &Vec3, high: &Vec3) -> Solid {
    let corner = |i: usize| Vec3::from_fn(|axis, _| if i >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]].map(Vec::from);
    Solid { vertices: (0..8).map(corner).collect(), faces: faces.to_vec(), inactive: Vec::new() }
}

/// A prism (or frustum, where `taper` is not 1) about z with one side per angle, from `low` to `high`.
pub fn prism(angles: &[f64], radius: f64, [low, high]: [f64; 2], taper: f64) -> Solid {
    let n = angles.len();
    let ring = |z: f64, r: f64| {
        angles.iter().map(move |angle| Vec3::new(r * libm::cos(*angle), r * libm::sin(*angle), z))
    };
    let vertices = ring(low, radius).chain(ring(high, radius * taper)).collect();
    let mut faces = vec![(0..n).rev().collect::<Vec<_>>(), (n..2 * n).collect()];
    faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
    Solid { vertices, faces, inactive: Vec::new() }
}

/// Convex hull of points, with triangular faces. `None` if the points are coplanar or nearly so.
pub fn hull(points: &[Vec3]) -> Option<Solid> {
    let size = points.iter().map(|p| p.norm()).fold(0.0, f64::max);
    let mut faces = Vec::new();
    for i in 0..points.len() {
        for j in i + 1..points.len() {
            for k in i + 1..points.len() {
                if k == j {
                    continue;
                }
                let normal = (points[j] - points[i]).cross(&(points[k] - points[i]));
                let height = |p: &Vec3| normal.dot(&(p - points[i])) / normal.norm();
                let others = (0..points.len()).filter(|l| ![i, j, k].contains(l));
                let highest = others.map(|l| height(&points[l])).fold(f64::NEG_INFINITY, f64::max);
                // A point nearly in the plane of a face would merge two faces: such hulls are left to makers
                // that intend them.
                if highest.abs() < 1e-3 * size || normal.norm() < 1e-3 * size * size {
                    return None;
                }
                if highest < 0.0 {
                    faces.push(vec![i, j, k]);
                }
            }
        }
    }
    let mut used: Vec<usize> = faces.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    (faces.len() == 2 * used.len() - 4).then_some(())?;
    let place = |vertex: &usize| used.binary_search(vertex).ok();
    let faces = faces.iter().map(|face| face.iter().filter_map(place).collect()).collect();
    Some(Solid { vertices: used.iter().map(|index| points[*index]).collect(), faces, inactive: Vec::new() })
}

/// Sorted angles of a polygon's corners, no two far apart or close together.
pub fn angles(random: &mut Random, sides: usize, is_round: bool) -> Vec<f64> {
    let step = std::f64::consts::TAU / sides as f64;
    let jitter = if is_round { 0.0 } else { 0.25 };
    (0..sides).map(|i| step * (i as f64 + random.between(-jitter, jitter))).collect()
}

/// Any convex solid of size about 1.
pub fn any(random: &mut Random, is_round: bool) -> Solid {
    match random.below(5) {
        0 | 1 => {
            let half = extents(random, is_round);
            cuboid(&-half, &half)
        }
        2 => {
            let sides = 3 + random.below(8);
            let angles = angles(random, sides, is_round);
            let taper = if random.chance(0.5) { 1.0 } else { random.between(0.3, 1.0) };
            let half = random.between(0.2, 1.0);
            prism(&angles, random.between(0.4, 1.0), [-half, half], taper)
        }
        _ => random_hull(random),
    }
}

/// Half extents of a box.
pub fn extents(random: &mut Random, is_round: bool) -> Vec3 {
    Vec3::from_fn(
        |_, _| {
            if is_round { random.pick(&[0.125, 0.25, 0.5, 1.0]) } else { random.log_between(0.1, 1.0) }
        },
    )
}

/// Convex hull of 4 to 12 random points.
pub fn random_hull(random: &mut Random) -> Solid {
    loop {
        let count = 4 + random.below(9);
        let stretch = Vec3::from_fn(|_, _| random.between(0.4, 1.0));
        let is_on_ball = random.chance(0.5);
        let mut point = || match is_on_ball {
            true => random.direction().component_mul(&stretch),
            false => random.vector(1.0).component_mul(&stretch),
        };
        let points: Vec<_> = (0..count).map(|_| point()).collect();
        if let Some(solid) = hull(&points) {
            return solid;
        }
    }
}
