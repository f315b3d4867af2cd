//! Parts of a mesh.

use super::divided::divided;
use super::facets::Facet;
use crate::solid::{SolidFacet, SolidPart};
use crate::solid_box::SolidBox;
use crate::solid_tree::SolidTree;
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
        SolidPart { primitive, element, bound: SolidBox::around(surface.vertices()), surface, facets: 0..0 }
    };
    divided(surface).into_iter().enumerate().map(part).collect()
}

/// Gives each part the regions of the triangles whose middles lie in it. Returns the regions, part after part.
/// `regions` has them with their triangles, and `facets` has all triangles.
pub(super) fn with_facets(
    parts: &mut [SolidPart],
    facets: &[Facet],
    regions: Vec<(u32, SolidFacet)>,
    diameter: f64,
) -> Vec<SolidFacet> {
    let boxes: Vec<SolidBox> = parts.iter().map(|part| part.bound).collect();
    let tree = SolidTree::new(&boxes);
    let mut near = Vec::new();
    let mut part_of = |triangle: u32| {
        let middle: Vec3 = facets[triangle as usize].corners.iter().sum::<Vec3>() / 3.0;
        near.clear();
        tree.meeting(&SolidBox { center: middle, half: Vec3::repeat(1e-9 * diameter) }, &mut near);
        near.iter().copied().min().unwrap_or(0)
    };
    let mut placed: Vec<(u32, u32, SolidFacet)> =
        regions.into_iter().map(|(triangle, region)| (part_of(triangle), triangle, region)).collect();
    placed.sort_by_key(|(part, triangle, _)| (*part, *triangle));
    let mut first = 0;
    for (number, part) in (0..).zip(parts) {
        let end = first + placed[first..].iter().take_while(|(of, ..)| *of == number).count();
        part.facets = first as u32..end as u32;
        first = end;
    }
    placed.into_iter().map(|(.., region)| region).collect()
}

/// Box around a part and the regions of its facets.
pub(super) fn reach(part: &SolidPart, facets: &[SolidFacet]) -> SolidBox {
    let own = &facets[part.facets.start as usize..part.facets.end as usize];
    let boxes = || std::iter::once(&part.bound).chain(own.iter().map(|facet| &facet.bound));
    let corners: Vec<Vec3> = boxes().flat_map(|b| [b.center - b.half, b.center + b.half]).collect();
    SolidBox::around(&corners)
}
