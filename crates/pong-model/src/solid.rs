//! Solids: closed parts of a rigid body that touch by the volume they share with others (docs/theory.md, 2.11).

use crate::solid_box::SolidBox;
use crate::solid_tree::SolidTree;
use pong_geometry::Vec3;
use pong_geometry::overlap::{HalfSpace, Surface};
use std::ops::Range;

/// Closed part of a movable group whose interior counts: a polyhedron, several joined by internal faces, or a
/// closed mesh of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Lowest of its primitives (index into [`MovableGroup::primitives`](crate::MovableGroup::primitives)).
    pub primitive: u32,
    /// Shell of that primitive.
    pub shell: u32,
    /// Index into [`Model::surfaces`](crate::Model::surfaces).
    pub surface: u32,
    /// Node of the group's tree that has its lowest primitive.
    pub leaf: u32,
    /// Box around the solid.
    pub bound: SolidBox,
    /// Area of its outer surface, m².
    pub area: f64,
    /// Closed parts without common volume, of any shape; together they are the solid.
    pub parts: Vec<SolidPart>,
    /// Convex solids that together are the solid, each with its faces and walls. One if the solid is convex,
    /// however it is divided; empty if it is a mesh that is not convex.
    pub fields: Vec<SolidField>,
    /// Regions below the facets of a mesh that is not convex, part after part; empty for all other solids.
    pub facets: Vec<SolidFacet>,
    /// Walls of the regions.
    pub facet_walls: Vec<HalfSpace>,
    /// Tree of the parts, with the regions of their facets. A convex solid is one item.
    pub tree: SolidTree,
}

/// Closed part of a solid.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidPart {
    /// Primitive that the part belongs to (index into
    /// [`MovableGroup::primitives`](crate::MovableGroup::primitives)).
    pub primitive: u32,
    /// Index into the array of the primitive's kind: the polyhedron, or a triangle of the part.
    pub element: u32,
    /// Box around the part.
    pub bound: SolidBox,
    /// Surface of the part in the group frame, internal faces included.
    pub surface: Surface,
    /// Facets that belong to the part (indices into [`Solid::facets`]).
    pub facets: Range<u32>,
}

/// Convex region below a facet of a mesh that is not convex, in the group frame. The facet is the face nearest to
/// all points of the region (docs/theory.md, 2.12).
#[derive(Clone, Debug, PartialEq)]
pub struct SolidFacet {
    /// Box around the region.
    pub bound: SolidBox,
    /// Plane of the facet.
    pub face: HalfSpace,
    /// Planes that bound the region (indices into [`Solid::facet_walls`]).
    pub walls: Range<u32>,
    /// Depth at which the region is cut off, because another side of the solid is as near there, m; +∞ if its
    /// walls meet above that depth.
    pub height: f64,
}

/// Convex part of a solid by its planes in the group frame.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidField {
    /// Box around the part.
    pub bound: SolidBox,
    /// Planes of the outer faces; a plane is listed once.
    pub faces: Vec<HalfSpace>,
    /// Planes of the internal faces.
    pub walls: Vec<HalfSpace>,
    /// Edges between faces whose normals are far apart, in the order of the faces; only if the field is that of the
    /// whole solid.
    pub edges: Vec<FieldEdge>,
}

/// Edge between two faces of a convex solid, in the group frame.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldEdge {
    /// Its faces (indices into [`SolidField::faces`]), the lower one first.
    pub faces: [u32; 2],
    /// Point of the edge, m.
    pub point: Vec3,
}

impl Solid {
    /// Returns `true` if one field describes the whole solid, which is then convex.
    pub fn is_convex(&self) -> bool {
        self.fields.len() == 1
    }

    /// Returns `true` if every part is convex.
    pub fn has_convex_parts(&self) -> bool {
        !self.fields.is_empty()
    }

    /// Lower bound of the least width of its convex parts, m: twice the volume over the area. A convex body of
    /// width w and area S has at most the volume w·S/2, since no section of it is larger than S/2.
    pub fn thinnest_m(&self) -> f64 {
        let volume = |part: &SolidPart| part.surface.moments(&part.bound.center).volume;
        if self.is_convex() {
            return 2.0 * self.parts.iter().map(volume).sum::<f64>() / self.area;
        }
        self.parts.iter().map(|part| 2.0 * volume(part) / part.surface.area()).fold(f64::INFINITY, f64::min)
    }

    /// Returns `true` if the solid has a field: convex pieces, or regions below its facets.
    pub fn has_field(&self) -> bool {
        !self.fields.is_empty() || !self.facets.is_empty()
    }

    /// Least depth at which a region of a facet is cut off, m; `None` if none is.
    pub fn least_height(&self) -> Option<f64> {
        self.facets
            .iter()
            .map(|facet| facet.height)
            .filter(|height| height.is_finite())
            .min_by(f64::total_cmp)
    }

    /// Area that takes the place of a surface's `area` where the file gives none, m²: a sixth of the outer
    /// surface, which is one face if the solid is a cube.
    pub fn reference_area(&self) -> f64 {
        self.area / 6.0
    }
}
