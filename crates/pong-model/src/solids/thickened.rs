//! Triangles of a solid as a closed surface, and the layer behind an open mesh.

use crate::weld::WordMap;
use pong_geometry::Vec3;
use pong_geometry::primitive::TriangleSet;

/// Triangles over vertices of their own, counter-clockwise seen from outside.
pub(super) struct Triangles {
    pub(super) vertices: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Number of the first triangles, which push; the others only close the surface.
    pub(super) outer: usize,
}

impl Triangles {
    /// Some triangles of a set.
    pub(super) fn new(set: &TriangleSet, which: &[u32]) -> Self {
        let mut numbers: WordMap<u32, u32> = WordMap::default();
        let mut vertices = Vec::new();
        let mut number = |vertex: u32| {
            *numbers.entry(vertex).or_insert_with(|| {
                vertices.push(set.vertices[vertex as usize]);
                vertices.len() as u32 - 1
            })
        };
        let triangles = which.iter().map(|&t| set.triangles[t as usize].vertices.map(&mut number)).collect();
        Self { vertices, triangles, outer: which.len() }
    }

    /// Enclosed volume if the triangles are closed, m³; negative if they face inwards.
    pub(super) fn volume(&self) -> f64 {
        let Some(origin) = self.vertices.first() else { return 0.0 };
        let six = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| self.vertices[vertex as usize] - origin);
            a.dot(&b.cross(&c))
        };
        self.triangles.iter().map(six).sum::<f64>() / 6.0
    }

    fn corners(&self, triangle: &[u32; 3]) -> [Vec3; 3] {
        triangle.map(|vertex| self.vertices[vertex as usize])
    }

    /// Edges of a single triangle, in the direction of that triangle.
    fn border(&self) -> Vec<[u32; 2]> {
        let edges = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
        let mut balance: WordMap<[u32; 2], i32> = WordMap::default();
        for [a, b] in self.triangles.iter().flat_map(edges) {
            *balance.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
        let has_side = |&[a, b]: &[u32; 2]| {
            let sum = balance[&[a.min(b), a.max(b)]];
            if a < b { sum > 0 } else { sum < 0 }
        };
        self.triangles.iter().flat_map(edges).filter(has_side).collect()
    }
}

/// Closed layer between the triangles and their images, whose vertices are moved by `thickness` (m) against the
/// normals of the vertices. The error is a place at which an image is turned over.
pub(super) fn thickened(mesh: &Triangles, thickness: f64) -> Result<Triangles, Vec3> {
    let count = mesh.vertices.len() as u32;
    let normals = vertex_normals(mesh);
    let moved = mesh.vertices.iter().zip(&normals).map(|(place, normal)| place - normal * thickness);
    let vertices: Vec<Vec3> = mesh.vertices.iter().copied().chain(moved).collect();
    let mut triangles = mesh.triangles.clone();
    triangles.extend(mesh.triangles.iter().map(|[a, b, c]| [count + a, count + c, count + b]));
    for [a, b] in mesh.border() {
        triangles.extend([[b, a, count + a], [b, count + a, count + b]]);
    }
    let layer = Triangles { vertices, triangles, outer: mesh.outer };
    for triangle in &mesh.triangles {
        let image = triangle.map(|vertex| vertex + count);
        let normal = |triangle| {
            let [a, b, c] = layer.corners(&triangle);
            (b - a).cross(&(c - a))
        };
        let along = normal(*triangle).dot(&normal(image));
        // Not a number if a vertex has no normal.
        if along.is_nan() || along <= 0.0 {
            return Err(layer.vertices[triangle[0] as usize]);
        }
    }
    Ok(layer)
}

/// Means of the normals of the triangles at each vertex, weighted by the angle at the vertex.
fn vertex_normals(mesh: &Triangles) -> Vec<Vec3> {
    let mut sums = vec![Vec3::zeros(); mesh.vertices.len()];
    for triangle in &mesh.triangles {
        let corners = mesh.corners(triangle);
        for k in 0..3 {
            let [to, from] = [(k + 1) % 3, (k + 2) % 3].map(|other| corners[other] - corners[k]);
            let across = to.cross(&from);
            let angle = libm::atan2(across.norm(), to.dot(&from));
            sums[triangle[k] as usize] += across.normalize() * angle;
        }
    }
    sums.into_iter().map(|sum| sum.normalize()).collect()
}
