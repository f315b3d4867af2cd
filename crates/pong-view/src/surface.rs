//! Triangles and the edges drawn on them.

use pong_geometry::Vec3;
use pong_geometry::primitive::{NO_NEIGHBOR, Polyhedron, TriangleSet};
use pong_model::{MovableGroup, PrimitiveInfo};

/// Cosine of 25°: an edge is drawn between neighbouring triangles whose normals differ by more.
const CREASE: f64 = 0.906_307_787;

/// All triangles of a body.
#[derive(Default)]
pub(crate) struct Surface {
    pub vertices: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
    pub edges: Vec<[u32; 2]>,
}

impl Surface {
    /// Adds the vertices of the meshes first, so that they keep their indices.
    pub fn take_vertices(&mut self, meshes: &TriangleSet) {
        debug_assert!(self.vertices.is_empty());
        self.vertices.clone_from(&meshes.vertices);
    }

    /// Adds the triangles of one primitive, without the reversed copies of a two-sided one; returns their
    /// range.
    pub fn add_mesh(&mut self, meshes: &TriangleSet, info: &PrimitiveInfo) -> (u32, u32) {
        let records = &meshes.triangles[info.elements.start as usize..info.first_mirror as usize];
        self.add_all(|surface| surface.triangles.extend(records.iter().map(|record| record.vertices)))
    }

    /// Adds the active faces; internal faces are left out.
    pub fn add_polyhedron(&mut self, solid: &Polyhedron) -> (u32, u32) {
        let base = self.vertices.len() as u32;
        self.vertices.extend(solid.vertices.iter().map(|vertex| vertex.position));
        let is_drawn = |edge: &&pong_geometry::primitive::PolyhedronEdge| {
            edge.push.is_some() || edge.faces.iter().all(|&face| solid.faces[face as usize].active)
        };
        self.edges.extend(solid.edges.iter().filter(is_drawn).map(|edge| edge.vertices.map(|v| base + v)));
        self.add_all(|surface| {
            for face in (0..solid.faces.len()).filter(|&face| solid.faces[face].active) {
                let rim = solid.rim(face);
                let corner = |index: usize| base + rim[index].start;
                surface.triangles.extend((2..rim.len()).map(|i| [corner(0), corner(i - 1), corner(i)]));
            }
        })
    }

    /// Adds a separate closed surface; does nothing without triangles.
    pub fn add_hull(&mut self, hull: &(Vec<Vec3>, Vec<[u32; 3]>)) -> (u32, u32) {
        let base = self.vertices.len() as u32;
        self.vertices.extend(&hull.0);
        self.add_all(|surface| {
            surface.triangles.extend(hull.1.iter().map(|corners| corners.map(|v| base + v)));
        })
    }

    /// Adds the free edges and the creases of the body's meshes, each once.
    pub fn add_creases(&mut self, body: &MovableGroup) {
        let meshes = &body.triangles;
        let fronts = body.primitives.iter().filter(|info| info.first_mirror > info.elements.start);
        let fronts = fronts.filter(|info| info.kind == pong_geometry::primitive::PrimitiveKind::Triangle);
        for triangle in fronts.flat_map(|info| info.elements.start..info.first_mirror) {
            let record = &meshes.triangles[triangle as usize];
            for side in 0..3 {
                if is_crease(meshes, triangle, record.neighbors[side]) {
                    self.edges.push([record.vertices[side], record.vertices[(side + 1) % 3]]);
                }
            }
        }
    }

    /// Largest distance of a vertex from the origin, m.
    pub fn radius(&self) -> f64 {
        self.vertices.iter().map(Vec3::norm_squared).fold(0.0, f64::max).sqrt()
    }

    fn add_all(&mut self, add: impl FnOnce(&mut Self)) -> (u32, u32) {
        let first = self.triangles.len();
        add(self);
        (first as u32, (self.triangles.len() - first) as u32)
    }
}

fn is_crease(meshes: &TriangleSet, triangle: u32, neighbor: u32) -> bool {
    neighbor == NO_NEIGHBOR
        || (triangle < neighbor && meshes.normal(triangle).dot(&meshes.normal(neighbor)) < CREASE)
}
