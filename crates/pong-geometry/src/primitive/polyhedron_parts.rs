//! The parts of a polyhedron: faces, outlines, edges and vertices with their surface topology.

use crate::Vec3;

/// All that a polyhedron consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyhedronParts {
    /// Faces; the lower index wins ties.
    pub faces: Vec<PolyhedronFace>,
    /// The edges of all face outlines, face after face, counter-clockwise seen from outside.
    pub rims: Vec<RimEdge>,
    /// Every edge once.
    pub edges: Vec<PolyhedronEdge>,
    /// Every vertex once.
    pub vertices: Vec<PolyhedronVertex>,
    /// Unit directions of the surface's edges away from a vertex, grouped by vertex: its normal cone is where
    /// all of them have a negative product with the normal.
    pub cone_edges: Vec<Vec3>,
    /// Largest distance between two vertices, m: the size that tolerances are relative to.
    pub diameter: f64,
}

/// A planar face: the solid is `normal · x ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronFace {
    /// Unit outward normal.
    pub normal: Vec3,
    /// Distance of the plane from the frame's origin along the normal, m.
    pub offset: f64,
    /// Whether the face can push. An inactive face is an inner wall between pieces of one body.
    pub active: bool,
    /// Whether a point exactly on this plane still belongs to this piece: true for an inactive wall whose twin
    /// belongs to a piece with a higher index.
    pub closed: bool,
    /// First entry of this face's outline in [`PolyhedronParts::rims`].
    pub first_rim: u32,
    /// Number of entries of the outline.
    pub rim_count: u32,
}

/// One edge of a face's outline, as that face sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RimEdge {
    /// Where the edge starts, walking the outline counter-clockwise (index into [`PolyhedronParts::vertices`]).
    pub start: u32,
    /// The edge (index into [`PolyhedronParts::edges`]).
    pub edge: u32,
    /// The face on the other side (index into [`PolyhedronParts::faces`]).
    pub neighbor: u32,
    /// The end of the edge that comes first in (x, y, z) order, so that every face and piece measures from the
    /// same point, m.
    pub anchor: Vec3,
    /// Unit vector in the face's plane, across the edge, out of the face.
    pub outward: Vec3,
}

/// An edge of one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronEdge {
    /// Its two ends in (x, y, z) order (indices into [`PolyhedronParts::vertices`]).
    pub vertices: [u32; 2],
    /// The two faces of this piece that meet here.
    pub faces: [u32; 2],
    /// Unit direction from the first to the second end.
    pub direction: Vec3,
    /// Whether the edge may push, and within which normals: two active faces of the surface (possibly of two
    /// pieces) meet here convexly, and this piece is the lowest that has the edge.
    pub push: Option<EdgePush>,
    /// The same for every piece that has the edge: for what crosses it from one piece into another.
    pub convex: Option<EdgePush>,
}

/// The normals between which a convex edge pushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePush {
    /// Outward unit normals of the two active faces that meet at the edge.
    pub normals: [Vec3; 2],
    /// For each of them the unit vector in its plane, across the edge, out of the face.
    pub outwards: [Vec3; 2],
}

/// A vertex of one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronVertex {
    /// Place in the movable group's frame, m.
    pub position: Vec3,
    /// Whether the vertex may push: active faces of the surface meet here, and this piece is the lowest that has
    /// the vertex.
    pub pushes: bool,
    /// First entry of its cone in [`PolyhedronParts::cone_edges`].
    pub first_cone: u32,
    /// Number of entries of its cone.
    pub cone_count: u32,
}

impl PolyhedronParts {
    /// The outline of a face.
    #[inline]
    pub fn rim(&self, face: usize) -> &[RimEdge] {
        self.rims_of(&self.faces[face])
    }

    /// The outline of a face, told by itself.
    #[inline]
    pub fn rims_of(&self, face: &PolyhedronFace) -> &[RimEdge] {
        &self.rims[face.first_rim as usize..(face.first_rim + face.rim_count) as usize]
    }

    /// The surface's edge directions away from a vertex.
    #[inline]
    pub fn cone(&self, vertex: usize) -> &[Vec3] {
        let vertex = &self.vertices[vertex];
        &self.cone_edges[vertex.first_cone as usize..(vertex.first_cone + vertex.cone_count) as usize]
    }

    /// Signed distance of a point above a face's plane (positive outside), m.
    #[inline]
    pub fn height(&self, face: usize, p: &Vec3) -> f64 {
        self.faces[face].height(p)
    }
}

impl PolyhedronFace {
    /// Signed distance of a point above the plane (positive outside), m.
    #[inline]
    pub fn height(&self, p: &Vec3) -> f64 {
        self.normal.dot(p) - self.offset
    }
}
