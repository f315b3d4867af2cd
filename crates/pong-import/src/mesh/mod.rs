//! Triangle meshes: cleaning, connected parts, planar faces, and whether a part is a convex solid.

mod adjacency;
mod clean;
mod facets;
mod junctions;
mod parts;
mod solid;
mod weld;

pub use adjacency::Adjacency;
pub(crate) use clean::clean;
pub(crate) use facets::{Facets, facets};
pub(crate) use junctions::mend;
pub use parts::parts;
pub use solid::{Flaw, Polyhedron, polyhedron, volume_m3};
pub(crate) use weld::{weld, weld_equal};

use nalgebra::Vector3;

/// Vertices and triangles, counter-clockwise seen from the front.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub vertices: Vec<Vector3<f64>>,
    pub triangles: Vec<[u32; 3]>,
    /// What distinguishes triangles (an index into the looks of the source); as many as triangles.
    pub look_of: Vec<u16>,
}

/// Finds the convex hull of a mesh and how far its deepest vertex lies within it, m; `None` if it has no thickness.
pub type HullFinder = fn(&Mesh) -> Option<(Polyhedron, f64)>;

impl Mesh {
    pub fn corners(&self, triangle: usize) -> [Vector3<f64>; 3] {
        self.triangles[triangle].map(|vertex| self.vertices[vertex as usize])
    }

    /// Diagonal of the bounding box, m.
    pub fn size_m(&self) -> f64 {
        let (low, high) = bounds(&self.vertices);
        (high - low).norm()
    }

    /// The same without vertices that no triangle uses, in the order of first use.
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

    /// The triangles of these numbers, with the vertices they use.
    pub fn part(&self, triangles: &[u32]) -> Self {
        let mut number: std::collections::HashMap<u32, u32> = std::collections::HashMap::new();
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

/// Lowest and highest coordinates; zeros for no places.
pub fn bounds(places: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let first = places.first().copied().unwrap_or_default();
    places.iter().fold((first, first), |(low, high), place| (low.inf(place), high.sup(place)))
}

/// Twice the area along the normal.
pub fn area_vector([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a))
}

/// Each corner of an outline with the next one.
pub fn ring<T: Copy>(outline: &[T]) -> impl Iterator<Item = (T, T)> + '_ {
    outline.iter().copied().zip(outline.iter().copied().cycle().skip(1))
}
