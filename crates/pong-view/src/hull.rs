//! Drawing of a primitive given by its support function alone: its convex hull.

use pong_geometry::Vec3;
use pong_geometry::primitive::CustomPrimitive;

/// Number of directions along each edge of the cube that is projected onto the sphere of directions.
const STEPS: usize = 12;
/// Step of the finite differences that give the support point.
const DIFFERENCE: f64 = 1e-5;

/// Vertices and triangles of the convex hull; empty if the primitive is unbounded.
///
/// The support point along d is the gradient of h(d) = max d·x, extended to all lengths of d.
pub(crate) fn hull(primitive: &dyn CustomPrimitive) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (directions, triangles) = directions();
    let corners: Vec<Vec3> = directions.iter().map(|direction| farthest(primitive, direction)).collect();
    let is_bounded = corners.iter().all(|corner| corner.iter().all(|x| x.is_finite()));
    if is_bounded { (corners, triangles) } else { (Vec::new(), Vec::new()) }
}

fn farthest(primitive: &dyn CustomPrimitive, direction: &Vec3) -> Vec3 {
    let height = |d: &Vec3| d.norm() * primitive.support(&d.normalize());
    Vec3::from_fn(|axis, _| {
        let mut step = Vec3::zeros();
        step[axis] = DIFFERENCE;
        (height(&(direction + step)) - height(&(direction - step))) / (2.0 * DIFFERENCE)
    })
}

/// Directions all around, and triangles between them, counter-clockwise seen from outside.
fn directions() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (mut directions, mut triangles) = (Vec::new(), Vec::new());
    let row = STEPS as u32 + 1;
    for face in 0..6 {
        let (axis, sign) = (face % 3, if face < 3 { 1.0 } else { -1.0 });
        let base = directions.len() as u32;
        for (i, j) in (0..=STEPS).flat_map(|i| (0..=STEPS).map(move |j| (i, j))) {
            let along = |k: usize| 2.0 * k as f64 / STEPS as f64 - 1.0;
            let mut d = Vec3::zeros();
            (d[axis], d[(axis + 1) % 3], d[(axis + 2) % 3]) = (sign, sign * along(i), along(j));
            directions.push(d.normalize());
        }
        for (i, j) in (0..row - 1).flat_map(|i| (0..row - 1).map(move |j| (i, j))) {
            let at = base + i * row + j;
            triangles.extend([[at, at + row, at + row + 1], [at, at + row + 1, at + 1]]);
        }
    }
    (directions, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug)]
    struct Capsule;

    impl CustomPrimitive for Capsule {
        fn kind_name(&self) -> &str {
            "capsule"
        }
        fn support(&self, direction: &Vec3) -> f64 {
            0.5 + direction.x.abs()
        }
        fn as_any(&self) -> &dyn std::any::Any {
            self
        }
    }

    /// Distance to the capsule of radius ½ m around the segment from (−1, 0, 0) to (1, 0, 0).
    fn distance(p: &Vec3) -> f64 {
        (p - Vec3::new(p.x.clamp(-1.0, 1.0), 0.0, 0.0)).norm()
    }

    #[test]
    fn corners_lie_on_a_capsule_and_the_volume_is_nearly_its_own() {
        let (corners, triangles) = hull(&Capsule);
        for corner in &corners {
            assert!((distance(corner) - 0.5).abs() < 1e-4, "{corner}");
        }
        let of = |t: &[u32; 3]| t.map(|v| corners[v as usize]);
        let volume: f64 = triangles.iter().map(of).map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum();
        let exact = std::f64::consts::PI * 0.25 * (2.0 + 4.0 / 3.0 * 0.5);
        assert!(volume > 0.97 * exact && volume < exact, "{volume} of {exact}");
    }
}
