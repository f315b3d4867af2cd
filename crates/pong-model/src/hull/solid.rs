//! Checked convex piece.

use pong_geometry::Vec3;

/// Distance, relative to the diameter, within which planes, internal faces and vertices coincide.
pub(crate) const PLANE_TOLERANCE: f64 = 1e-6;

/// Checked convex piece in the frame of its body.
pub(crate) struct Hull {
    /// Distinct positions, all in use.
    pub(crate) vertices: Vec<Vec3>,
    pub(crate) faces: Vec<HullFace>,
    /// Largest distance between two vertices, m.
    pub(crate) diameter: f64,
    /// Remarks for the author.
    pub(crate) remarks: Vec<String>,
}

impl Hull {
    /// Corners of a face, m.
    pub(crate) fn corners(&self, face: usize) -> Vec<Vec3> {
        self.faces[face].outline.iter().map(|&v| self.vertices[v as usize]).collect()
    }
}

/// Planar face.
#[derive(Clone)]
pub(crate) struct HullFace {
    pub(crate) normal: Vec3,
    pub(crate) offset: f64,
    pub(crate) active: bool,
    /// True if its plane belongs to the piece (see `PolyhedronFace::closed`).
    pub(crate) closed: bool,
    /// Vertices, counter-clockwise seen from outside.
    pub(crate) outline: Vec<u32>,
    /// For each edge of the outline, the two vertices that define its lateral plane; empty if every lateral
    /// plane runs along its edge.
    pub(crate) walls: Vec<[u32; 2]>,
    /// Lowest authored face that was merged into it.
    pub(crate) authored: u32,
}
