//! A triangle mesh: vertices, triangles and the look of each triangle.

use super::measures::bounds;
use nalgebra::Vector3;
use std::collections::HashMap;

/// Vertices and triangles, counter-clockwise seen from the front.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub vertices: Vec<Vector3<f64>>,
    pub triangles: Vec<[u32; 3]>,
    /// Look of each triangle (an index into the looks of the source).
    pub look_of: Vec<u16>,
}

impl Mesh {
    pub fn corners(&self, triangle: usize) -> [Vector3<f64>; 3] {
        self.triangles[triangle].map(|vertex| self.vertices[vertex as usize])
    }

    /// Adds the triangles of another mesh.
    pub fn append(&mut self, part: &Self) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(&part.vertices);
        self.triangles.extend(part.triangles.iter().map(|triangle| triangle.map(|vertex| first + vertex)));
        self.look_of.extend(&part.look_of);
    }

    /// Diagonal of the bounding box, m.
    pub fn size_m(&self) -> f64 {
        let (low, high) = bounds(&self.vertices);
        (high - low).norm()
    }

    /// The mesh without unused vertices, in the order of first use.
    pub fn compact(mut self) -> Self {
        let mut number = vec![u32::MAX; self.vertices.len()];
        let mut vertices = Vec::new();
        for vertex in self.triangles.iter_mut().flatten() {
            let slot = &mut number[*vertex as usize];
            if *slot == u32::MAX {
                *slot = vertices.len() as u32;
                vertices.push(self.vertices[*vertex as usize]);
            }
            *vertex = *slot;
        }
        self.vertices = vertices;
        self
    }

    /// The triangles of these indices, with the vertices they use.
    pub fn part(&self, triangles: &[u32]) -> Self {
        let mut number: HashMap<u32, u32> = HashMap::new();
        let mut part = Self::default();
        for &triangle in triangles {
            let corners = self.triangles[triangle as usize].map(|vertex| {
                *number.entry(vertex).or_insert_with(|| {
                    part.vertices.push(self.vertices[vertex as usize]);
                    (part.vertices.len() - 1) as u32
                })
            });
            part.triangles.push(corners);
            part.look_of.push(self.look_of[triangle as usize]);
        }
        part
    }
}
