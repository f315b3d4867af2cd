//! Parts of a mesh.

use super::divided::divided;
use crate::solid::{SolidBox, SolidPart};
use pong_geometry::Vec3;
use pong_geometry::overlap::Surface;

/// Parts of a closed mesh. `primitive` and `element` are the lowest of the mesh.
pub(super) fn of_mesh(
    (primitive, element): (u32, u32),
    vertices: &[Vec3],
    triangles: &[[u32; 3]],
) -> Vec<SolidPart> {
    let mut surface = Surface::with_capacity(triangles.len());
    surface.add_vertices(vertices.iter().copied());
    triangles.iter().for_each(|triangle| surface.add_facet(triangle.iter().copied()));
    let part = |surface: Surface| {
        let bound = SolidBox::around(surface.vertices());
        SolidPart { primitive, element, bound, surface }
    };
    divided(surface).into_iter().map(part).collect()
}
