//! Problems that prevent authored faces from forming a convex piece.

use pong_geometry::Vec3;

/// Problem of a polyhedron.
#[derive(Debug)]
pub(crate) struct Problem {
    /// Index of the authored face, if the problem concerns one.
    pub(crate) face: Option<usize>,
    pub(crate) rule: &'static str,
    pub(crate) cause: String,
    pub(crate) cure: &'static str,
    /// Vertices that the problem concerns.
    pub(crate) places: Vec<Vec3>,
    /// Distance by which a plane or a line is missed, m; 0 if not applicable.
    pub(crate) off: f64,
}

impl Problem {
    pub(super) fn new(face: Option<usize>, rule: &'static str, cause: String, cure: &'static str) -> Self {
        Self { face, rule, cause, cure, places: Vec::new(), off: 0.0 }
    }

    pub(super) fn at(self, places: &[Vec3]) -> Self {
        Self { places: places.to_vec(), ..self }
    }

    pub(super) fn off(self, off: f64) -> Self {
        Self { off, ..self }
    }
}
