//! Sides of a pair of solids: a convex body, a part of another body, or a plane.

use super::relative::Relative;
use pong_geometry::Transform;
use pong_geometry::overlap::HalfSpace;
use pong_model::{FieldEdge, MovableGroup, Solid, SolidBox, SolidFacet, SolidNode, SolidPart};

/// One side of a patch: a convex solid with all its parts, one part of another solid, or a plane. A side has
/// one bristle with each other side.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    /// Closed parts; none for a plane.
    pub parts: &'a [SolidPart],
    /// Planes of the field: outer faces, and internal faces. Empty without a field.
    pub faces: &'a [HalfSpace],
    pub walls: &'a [HalfSpace],
    /// Edges between `faces` whose normals are far apart.
    pub edges: &'a [FieldEdge],
    /// Regions below the facets of a mesh that is not convex, which are its field instead of `faces` and `walls`.
    pub regions: Regions<'a>,
    /// True if the field describes the whole body, which then remembers the side of entry.
    pub is_whole: bool,
    pub primitive: u32,
    pub element: u32,
    pub shell: u32,
    /// Index among the sides of its solid.
    pub unit: u32,
}

/// Regions of the facets of a part.
#[derive(Clone, Copy, Default)]
pub(super) struct Regions<'a> {
    pub facets: &'a [SolidFacet],
    /// Index of the first of `facets` in its solid.
    pub first: u32,
    /// Walls of all regions of the solid.
    walls: &'a [HalfSpace],
}

impl<'a> Regions<'a> {
    fn of(solid: &'a Solid, part: &SolidPart) -> Self {
        let facets = &solid.facets[part.facets.start as usize..part.facets.end as usize];
        Self { facets, first: part.facets.start, walls: &solid.facet_walls }
    }

    /// Walls of a region.
    pub fn walls(&self, facet: &SolidFacet) -> &'a [HalfSpace] {
        &self.walls[facet.walls.start as usize..facet.walls.end as usize]
    }
}

/// Half space of a plane.
pub(super) fn half_space(body: &MovableGroup, primitive: u32) -> [HalfSpace; 1] {
    let plane = &body.planes[body.primitives[primitive as usize].elements.start as usize];
    [HalfSpace { normal_b: plane.normal, offset: plane.offset }]
}

impl<'a> Side<'a> {
    /// Side number `unit` of a solid.
    pub fn unit(solid: &'a Solid, unit: usize) -> Self {
        let is_whole = solid.is_convex();
        let parts = if is_whole { &solid.parts[..] } else { &solid.parts[unit..=unit] };
        let field = solid.fields.get(unit);
        let regions = if is_whole { Regions::default() } else { Regions::of(solid, &parts[0]) };
        Self {
            parts,
            faces: field.map_or(&[], |field| &field.faces),
            walls: field.map_or(&[], |field| &field.walls),
            edges: field.map_or(&[], |field| &field.edges),
            regions,
            is_whole,
            primitive: parts[0].primitive,
            element: parts[0].element,
            shell: solid.shell,
            unit: unit as u32,
        }
    }

    /// Side of a plane, whose half space is `plane`.
    pub fn plane(body: &MovableGroup, primitive: u32, plane: &'a [HalfSpace]) -> Self {
        let info = &body.primitives[primitive as usize];
        Self {
            parts: &[],
            faces: plane,
            walls: &[],
            edges: &[],
            regions: Regions::default(),
            is_whole: true,
            primitive,
            element: info.elements.start,
            shell: info.shell,
            unit: 0,
        }
    }
}

/// Calls `meet` with the numbers of the sides of two solids whose boxes meet.
pub(super) fn for_each_meeting(
    relative: &Relative,
    (a, b): (&Solid, &Solid),
    (node_a, node_b): (SolidNode, SolidNode),
    meet: &mut impl FnMut(usize, usize),
) {
    let (bound_a, bound_b) = (a.tree.bound(&node_a), b.tree.bound(&node_b));
    if !boxes_meet(&relative.x_ba, bound_a, bound_b) {
        return;
    }
    // The larger box is divided first.
    let divides_a = bound_a.half.norm_squared() >= bound_b.half.norm_squared();
    match (node_a.halves(), node_b.halves()) {
        (None, None) => meet(a.tree.item(&node_a), b.tree.item(&node_b)),
        (Some(halves), of_b) if divides_a || of_b.is_none() => {
            halves.iter().for_each(|half| for_each_meeting(relative, (a, b), (*half, node_b), meet));
        }
        (_, Some(halves)) => {
            halves.iter().for_each(|half| for_each_meeting(relative, (a, b), (node_a, *half), meet));
        }
        (Some(_), None) => {}
    }
}

/// Calls `meet` with the numbers of the sides of a solid whose boxes reach below the plane B.
pub(super) fn for_each_below(
    relative: &Relative,
    (a, plane): (&Solid, &HalfSpace),
    node: SolidNode,
    meet: &mut impl FnMut(usize),
) {
    let bound = a.tree.bound(&node);
    let center = relative.x_ba.point(&bound.center);
    let along = relative.x_ba.rotation.tr_mul(&plane.normal_b).abs().dot(&bound.half);
    if plane.depth(&center) + along <= 0.0 {
        return;
    }
    match node.halves() {
        Some(halves) => halves.iter().for_each(|half| for_each_below(relative, (a, plane), *half, meet)),
        None => meet(a.tree.item(&node)),
    }
}

/// Returns false if two boxes are apart along an axis of either frame. `x_ba` carries A's frame into B's.
pub(super) fn boxes_meet(x_ba: &Transform, a: &SolidBox, b: &SolidBox) -> bool {
    let turned = x_ba.rotation.abs();
    let apart = x_ba.point(&a.center) - b.center;
    let along_b = apart.abs() - turned * a.half - b.half;
    if along_b.max() > 0.0 {
        return false;
    }
    let along_a = x_ba.rotation.tr_mul(&apart).abs() - turned.tr_mul(&b.half) - a.half;
    along_a.max() <= 0.0
}
