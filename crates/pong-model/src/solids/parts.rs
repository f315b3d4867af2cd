//! Parts of a mesh.

use super::divided::divided;
use crate::solid::{SolidBox, SolidPart};
use pong_geometry::Vec3;
use pong_geometry::overlap::Surface;

/// Parts of a closed mesh. `owner` returns primitive and element of a triangle by its index in the mesh.
///
/// Contacts name a part by one triangle, so part number k has triangle k of the mesh. It need not touch the part.
pub(super) fn of_mesh(
    owner: impl Fn(usize) -> (u32, u32),
    vertices: &[Vec3],
    triangles: &[[u32; 3]],
) -> Vec<SolidPart> {
    let mut surface = Surface::with_capacity(triangles.len());
    surface.add_vertices(vertices.iter().copied());
    triangles.iter().for_each(|triangle| surface.add_facet(triangle.iter().copied()));
    let part = |(number, surface): (usize, Surface)| {
        let (primitive, element) = owner(number);
        SolidPart { primitive, element, bound: SolidBox::around(surface.vertices()), surface }
    };
    divided(surface).into_iter().enumerate().map(part).collect()
}
