//! A checked convex piece.

use pong_geometry::Vec3;

/// Planes, walls and vertices count as one within this share of the diameter.
pub(crate) const PLANE_TOLERANCE: f64 = 1e-6;

/// A checked convex piece in the frame of its body.
pub(crate) struct Hull {
    /// Distinct positions, all in use.
    pub(crate) vertices: Vec<Vec3>,
    pub(crate) faces: Vec<HullFace>,
    /// Largest distance between two vertices, m.
    pub(crate) diameter: f64,
    /// What the author should know.
    pub(crate) remarks: Vec<String>,
}

impl Hull {
    /// The corners of a face, m.
    pub(crate) fn corners(&self, face: usize) -> Vec<Vec3> {
        self.faces[face].outline.iter().map(|&v| self.vertices[v as usize]).collect()
    }
}

/// A planar face.
#[derive(Clone)]
pub(crate) struct HullFace {
    pub(crate) normal: Vec3,
    pub(crate) offset: f64,
    pub(crate) active: bool,
    /// Whether its plane belongs to the piece (see `PolyhedronFace::closed`).
    pub(crate) closed: bool,
    /// Vertices counter-clockwise seen from outside.
    pub(crate) outline: Vec<u32>,
    /// For each edge of the outline the two vertices that its wall runs between; none where every wall runs along its edge.
    pub(crate) walls: Vec<[u32; 2]>,
    /// The lowest authored face that went into it.
    pub(crate) authored: u32,
}
