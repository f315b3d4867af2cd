//! How a model is to be built.

use crate::laws::DefaultSurface;
use crate::mesh::HullFinder;

/// How a model is to be built.
pub struct Building<'a> {
    /// What messages call the file.
    pub file: String,
    /// Name of the model if the file gives none.
    pub name: String,
    /// Name of the root to take, if there are several.
    pub root: Option<String>,
    /// Vertices nearer than this are one, m; `None` joins only equal ones.
    pub weld_m: Option<f64>,
    /// Whether triangles are made to run alike, and closed surfaces to face outwards.
    pub outward: bool,
    /// Whether holes are filled.
    pub close: bool,
    /// Metres in one unit of the file, for lengths in marks.
    pub unit_m: f64,
    pub surface: Option<DefaultSurface>,
    pub faces_max: usize,
    /// Meshes of more triangles go to files beside the model.
    pub inline_max: usize,
    /// What unmarked parts that are not convex become, if anything: their convex hulls.
    pub hull: Option<HullFinder>,
    /// Unmarked parts that are round within this distance become round primitives, m; `None` leaves them as they are.
    pub round_m: Option<f64>,
    pub progress: &'a mut dyn FnMut(&str),
}
