//! Options of building a model.

use crate::laws::DefaultSurface;
use crate::mesh::HullFinder;

/// Options of building a model.
pub struct Building<'a> {
    /// Name of the file in messages.
    pub file: String,
    /// Name of the model if the file gives none.
    pub name: String,
    /// Name of the root to take, if several are marked.
    pub root: Option<String>,
    /// Vertices nearer than this are merged, m; `None` merges only equal ones.
    pub weld_m: Option<f64>,
    /// True if the winding of triangles is made consistent and closed surfaces outward.
    pub outward: bool,
    /// True if holes are filled.
    pub close: bool,
    /// Metres in one unit of the file, for lengths in marks.
    pub unit_m: f64,
    pub surface: Option<DefaultSurface>,
    pub faces_max: usize,
    /// Meshes of more triangles are written to files beside the model.
    pub inline_max: usize,
    /// Convex hull function for unmarked parts that are not convex; `None` leaves them as they are.
    pub hull: Option<HullFinder>,
    /// Tolerance within which unmarked parts become round primitives, m; `None` leaves them as they are.
    pub round_m: Option<f64>,
    pub progress: &'a mut dyn FnMut(&str),
}
