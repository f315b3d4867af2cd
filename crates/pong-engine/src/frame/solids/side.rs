//! Sides of a pair of solids: a convex body, a part of another body, or a plane.

use super::relative::Relative;
use pong_geometry::overlap::HalfSpace;
use pong_model::{MovableGroup, Solid, SolidBox, SolidPart};

/// One side of a patch: a convex solid with all its parts, one part of another solid, or a plane. A side has
/// one bristle with each other side.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    /// Closed parts; none for a plane.
    pub parts: &'a [SolidPart],
    /// Planes of the field: outer faces, and internal faces. Empty without a field.
    pub faces: &'a [HalfSpace],
    pub walls: &'a [HalfSpace],
    /// True if the field describes the whole body, which then remembers the side of entry.
    pub is_whole: bool,
    /// Box around the parts; `None` for a plane.
    pub bound: Option<SolidBox>,
    pub primitive: u32,
    pub element: u32,
    pub shell: u32,
    /// Index among the sides of its solid.
    pub unit: u32,
}

/// Number of sides of a solid.
pub(super) fn unit_count(solid: &Solid) -> usize {
    if solid.is_convex() { 1 } else { solid.parts.len() }
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
        Self {
            parts,
            faces: field.map_or(&[], |field| &field.faces),
            walls: field.map_or(&[], |field| &field.walls),
            is_whole,
            bound: Some(if is_whole { solid.bound } else { parts[0].bound }),
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
            is_whole: true,
            bound: None,
            primitive,
            element: info.elements.start,
            shell: info.shell,
            unit: 0,
        }
    }
}

/// Returns false if the boxes of two sides, or the box of A and the plane B, cannot overlap.
pub(super) fn sides_meet(relative: &Relative, a: &Side<'_>, b: &Side<'_>) -> bool {
    let Some(bound_a) = &a.bound else { return true };
    match &b.bound {
        Some(bound_b) => boxes_meet(relative, bound_a, bound_b),
        None => {
            let plane = &b.faces[0];
            let center = relative.x_ba.point(&bound_a.center);
            let along = relative.x_ba.rotation.tr_mul(&plane.normal_b).abs().dot(&bound_a.half);
            plane.depth(&center) + along > 0.0
        }
    }
}

/// Returns false if two boxes are apart along an axis of either frame.
pub(super) fn boxes_meet(relative: &Relative, a: &SolidBox, b: &SolidBox) -> bool {
    let turned = relative.x_ba.rotation.abs();
    let apart = relative.x_ba.point(&a.center) - b.center;
    let along_b = apart.abs() - turned * a.half - b.half;
    if along_b.max() > 0.0 {
        return false;
    }
    let along_a = relative.x_ba.rotation.tr_mul(&apart).abs() - turned.tr_mul(&b.half) - a.half;
    along_a.max() <= 0.0
}
