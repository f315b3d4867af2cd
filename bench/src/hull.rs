//! The convex polyhedra and the triangle of W1.

use crate::ron;
use pong_geometry::Vec3;
use std::f64::consts::PI;

/// Semi-axes of the ellipsoid through the vertices, m.
pub const SEMI_AXES: [f64; 3] = [0.5, 0.4, 0.3];

/// A convex polyhedron with triangular faces.
#[derive(Clone)]
pub struct Hull {
    /// Vertices, m.
    pub vertices: Vec<Vec3>,
    /// Vertex numbers, counter-clockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
}

impl Hull {
    /// Vertices of a Fibonacci sphere, scaled: 8, 18, 66 of them give 12, 32, 128 faces.
    pub fn fibonacci(vertices: usize) -> Self {
        let golden = PI * (3.0 - 5_f64.sqrt());
        let vertex = |i: usize| {
            let z = 1.0 - (2 * i + 1) as f64 / vertices as f64;
            let (sine, cosine) = (i as f64 * golden).sin_cos();
            let across = (1.0 - z * z).sqrt();
            Vec3::new(across * cosine, across * sine, z).component_mul(&Vec3::from(SEMI_AXES))
        };
        let vertices: Vec<_> = (0..vertices).map(vertex).collect();
        let count = vertices.len() as u32;
        let triples =
            (0..count).flat_map(|i| (i + 1..count).flat_map(move |j| (j + 1..count).map(move |k| [i, j, k])));
        let faces = triples.filter_map(|face| outward(&vertices, face)).collect();
        Self { vertices, faces }
    }

    /// A cone with this many sides along z, with base and tip at those of the round one.
    pub fn cone([base, tip]: [f64; 2], radius: f64, sides: u32) -> Self {
        let rim = |i: u32| {
            let (sine, cosine) = (2.0 * PI * f64::from(i) / f64::from(sides)).sin_cos();
            Vec3::new(radius * cosine, radius * sine, base)
        };
        let vertices = (0..sides).map(rim).chain([Vec3::new(0.0, 0.0, tip)]).collect();
        let wall = (0..sides).map(|i| [i, (i + 1) % sides, sides]);
        let below = (2..sides).map(|i| [0, i, i - 1]);
        Self { vertices, faces: wall.chain(below).collect() }
    }

    /// Unit normals and offsets of the faces: inside is where normal · p < offset for all.
    pub fn planes(&self) -> Vec<(Vec3, f64)> {
        let plane = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|v| self.vertices[v as usize]);
            let normal = (b - a).cross(&(c - a)).normalize();
            (normal, normal.dot(&a))
        };
        self.faces.iter().map(plane).collect()
    }

    /// Model file.
    pub fn model(&self) -> String {
        let faces = self.faces.iter().map(|face| format!("{face:?}")).collect::<Vec<_>>().join(",");
        let vertices = ron::vectors(&self.vertices);
        ron::model("hull", &format!("Polyhedron(name: \"hull\", vertices: [{vertices}], faces: [{faces}])"))
    }
}

/// A triangle of vertices of which no four lie in one plane, counter-clockwise seen from outside, if it is a face of their hull.
fn outward(vertices: &[Vec3], face: [u32; 3]) -> Option<[u32; 3]> {
    let [a, b, c] = face.map(|v| vertices[v as usize]);
    let normal = (b - a).cross(&(c - a));
    let mut others =
        (0..).zip(vertices).filter(|(v, _)| !face.contains(v)).map(|(_, p)| normal.dot(&(p - a)) < 0.0);
    let below = others.next()?;
    let [i, j, k] = face;
    others.all(|other| other == below).then_some(if below { [i, j, k] } else { [i, k, j] })
}

/// Corners of the triangle, counter-clockwise seen from +z, m.
pub const TRIANGLE: [[f64; 3]; 3] = [[-0.25, -0.2, 0.0], [0.35, -0.2, 0.0], [-0.1, 0.4, 0.0]];

/// Model file of the triangle.
pub fn triangle_model() -> String {
    let vertices = ron::vectors(&TRIANGLE.map(Vec3::from));
    ron::model(
        "triangle",
        &format!("TriangleMesh(name: \"t\", vertices: [{vertices}], triangles: [(0,1,2)])"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    /// A closed surface of triangles has 2n − 4 of them, each edge once in each direction (Euler).
    #[test]
    fn the_hull_of_points_on_an_ellipsoid_is_closed_and_convex() {
        for count in [8, 18, 66] {
            let hull = Hull::fibonacci(count);
            assert_eq!(hull.faces.len(), 2 * count - 4);
            let edges: HashSet<_> =
                hull.faces.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
            assert_eq!(edges.len(), 3 * hull.faces.len());
            assert!(edges.iter().all(|&(from, to)| edges.contains(&(to, from))));
            for (normal, offset) in hull.planes() {
                assert!(hull.vertices.iter().all(|vertex| normal.dot(vertex) < offset + 1e-12));
                assert!(offset > 0.0);
            }
        }
    }

    #[test]
    fn a_cone_of_many_sides_is_convex_closed_and_nearly_as_large_as_the_round_one() {
        let (ends, radius, sides) = ([-0.3, 0.5], 0.4, 64);
        let cone = Hull::cone(ends, radius, sides);
        for (normal, offset) in cone.planes() {
            assert!(cone.vertices.iter().all(|vertex| normal.dot(vertex) < offset + 1e-12));
        }
        let signed = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|v| cone.vertices[v as usize]);
            a.dot(&b.cross(&c)) / 6.0
        };
        let volume: f64 = cone.faces.iter().map(signed).sum();
        let base = 0.5 * f64::from(sides) * radius * radius * (2.0 * PI / f64::from(sides)).sin();
        assert!((volume - base * (ends[1] - ends[0]) / 3.0).abs() < 1e-12);
    }
}
