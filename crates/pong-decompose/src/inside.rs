//! A closed mesh as a solid: inside test and distance to its surface.

use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::{TriMesh, TriMeshFlags};
use pong_import::mesh::Mesh;

/// A closed mesh in a bounding volume tree, with pseudo-normals for the inside test.
pub(crate) struct Solid(TriMesh);

impl Solid {
    /// `None` if the mesh is empty.
    pub(crate) fn new(mesh: &Mesh) -> Option<Self> {
        let vertices = mesh.vertices.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
        TriMesh::with_flags(vertices, mesh.triangles.clone(), TriMeshFlags::ORIENTED).ok().map(Self)
    }

    pub(crate) fn holds(&self, place: &Vector3<f64>) -> bool {
        self.0.project_local_point(Vector::new(place.x, place.y, place.z), false).is_inside
    }

    /// Distance to the solid, 0 inside.
    pub(crate) fn outside_by_m(&self, place: &Vector3<f64>) -> f64 {
        let place = Vector::new(place.x, place.y, place.z);
        let nearest = self.0.project_local_point(place, false);
        if nearest.is_inside { 0.0 } else { (place - nearest.point).length() }
    }

    /// Distance to its surface.
    pub(crate) fn surface_distance_m(&self, place: &Vector3<f64>) -> f64 {
        let place = Vector::new(place.x, place.y, place.z);
        (place - self.0.project_local_point(place, false).point).length()
    }

    /// Nearest point of its surface.
    pub(crate) fn nearest(&self, place: &Vector3<f64>) -> Vector3<f64> {
        let nearest = self.0.project_local_point(Vector::new(place.x, place.y, place.z), false).point;
        Vector3::new(nearest.x, nearest.y, nearest.z)
    }
}
