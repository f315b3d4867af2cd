//! Parts of a polyhedron: faces, face outlines, edges and vertices, and how these are connected.

use crate::Vec3;

/// All parts of a polyhedron.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyhedronParts {
    /// Faces; if two faces are equal in a comparison, the lower index counts.
    pub faces: Vec<PolyhedronFace>,
    /// Edges of all face outlines, face after face, counter-clockwise seen from outside.
    pub rims: Vec<RimEdge>,
    /// Edges, each once.
    pub edges: Vec<PolyhedronEdge>,
    /// Vertices, each once.
    pub vertices: Vec<PolyhedronVertex>,
    /// Unit directions of the surface's edges away from a vertex, grouped by vertex. The normal cone of the
    /// vertex consists of the normals that have a negative dot product with all these directions.
    pub cone_edges: Vec<Vec3>,
    /// Largest distance between two vertices, m: the reference size of tolerances.
    pub diameter: f64,
}

/// Planar face: the solid is `normal · x ≤ offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronFace {
    /// Unit outward normal.
    pub normal: Vec3,
    /// Distance of the plane from the frame's origin along the normal, m.
    pub offset: f64,
    /// True if the face can push. An inactive face is an internal face (inner wall) between pieces of one
    /// body.
    pub active: bool,
    /// True if a point exactly on this plane belongs to this piece. That is so for an internal face whose
    /// opposite face belongs to a piece with a higher index.
    pub closed: bool,
    /// First entry of this face's outline in [`PolyhedronParts::rims`].
    pub first_rim: u32,
    /// Number of entries of the outline.
    pub rim_count: u32,
}

/// Edge of a face's outline, as seen from that face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RimEdge {
    /// Start of the edge, walking the outline counter-clockwise (index into [`PolyhedronParts::vertices`]).
    pub start: u32,
    /// Edge (index into [`PolyhedronParts::edges`]).
    pub edge: u32,
    /// Face on the other side (index into [`PolyhedronParts::faces`]).
    pub neighbor: u32,
    /// End of the edge from which distances are measured, m: the first in (x, y, z) order, so that every face
    /// and piece measures from the same point.
    pub anchor: Vec3,
    /// Unit vector that lies in the face's plane, is perpendicular to the edge and points out of the face.
    pub outward: Vec3,
}

/// Edge of one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronEdge {
    /// Its two ends in (x, y, z) order (indices into [`PolyhedronParts::vertices`]).
    pub vertices: [u32; 2],
    /// The two faces of this piece that meet at the edge.
    pub faces: [u32; 2],
    /// Unit direction from the first to the second end.
    pub direction: Vec3,
    /// Normals along which the edge pushes; `None` if it cannot push. It pushes if two conditions hold: two
    /// active faces of the surface (possibly of two pieces) meet here convexly, and this piece has the lowest
    /// index of the pieces with the edge.
    pub push: Option<EdgePush>,
    /// Same as `push`, but set in every piece that has the edge. It is used for shapes that cross the edge
    /// from one piece into another.
    pub convex: Option<EdgePush>,
}

/// Range of normals along which a convex edge pushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePush {
    /// Outward unit normals of the two active faces that meet at the edge.
    pub normals: [Vec3; 2],
    /// For each of the two faces, the unit vector that lies in the face's plane, is perpendicular to the edge
    /// and points out of the face.
    pub outwards: [Vec3; 2],
}

/// Vertex of one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolyhedronVertex {
    /// Position in the group frame, m.
    pub position: Vec3,
    /// True if the vertex may push. Two conditions must hold: active faces of the surface meet here, and this
    /// piece has the lowest index of the pieces with the vertex.
    pub pushes: bool,
    /// First entry of its cone in [`PolyhedronParts::cone_edges`].
    pub first_cone: u32,
    /// Number of entries of its cone.
    pub cone_count: u32,
}

impl PolyhedronParts {
    /// Returns the outline of a face, given by its index.
    #[inline]
    pub fn rim(&self, face: usize) -> &[RimEdge] {
        self.rims_of(&self.faces[face])
    }

    /// Returns the outline of a face, given by reference.
    #[inline]
    pub fn rims_of(&self, face: &PolyhedronFace) -> &[RimEdge] {
        &self.rims[face.first_rim as usize..(face.first_rim + face.rim_count) as usize]
    }

    /// Returns the directions of the surface's edges away from a vertex, which define the normal cone of the
    /// vertex.
    #[inline]
    pub fn cone(&self, vertex: usize) -> &[Vec3] {
        let vertex = &self.vertices[vertex];
        &self.cone_edges[vertex.first_cone as usize..(vertex.first_cone + vertex.cone_count) as usize]
    }

    /// Returns the height of a point above a face's plane, m; positive outside.
    #[inline]
    pub fn height(&self, face: usize, p: &Vec3) -> f64 {
        self.faces[face].height(p)
    }
}

impl PolyhedronFace {
    /// Returns the height of a point above the face's plane, m; positive outside.
    #[inline]
    pub fn height(&self, p: &Vec3) -> f64 {
        self.normal.dot(p) - self.offset
    }
}
