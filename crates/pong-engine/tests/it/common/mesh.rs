//! A mesh with its author's settings.

use pong_geometry::{Quat, Vec3};
use pong_testkit::ron::{model, surface, triangle_mesh};

/// Stiffness of every surface of these tests, N/m.
const STIFFNESS: f64 = 1e5;
/// Stiffness of two such surfaces in series, N/m.
pub const SERIES: f64 = 0.5 * STIFFNESS;

/// The surface of these tests.
pub fn steel() -> String {
    surface(STIFFNESS, "normal: Linear(damping: 0.0)")
}

/// A mesh with its author's settings.
#[derive(Clone)]
pub struct Mesh {
    pub vertices: Vec<Vec3>,
    pub triangles: Vec<[usize; 3]>,
    pub two_sided: bool,
    pub thickness: Option<f64>,
}

impl Mesh {
    /// A one-sided mesh of the default thickness.
    pub fn new(vertices: Vec<Vec3>, triangles: Vec<[usize; 3]>) -> Self {
        Self { vertices, triangles, two_sided: false, thickness: None }
    }

    /// The mesh in other axes.
    pub fn turned(&self, turn: &Quat, shift: &Vec3) -> Self {
        Self { vertices: self.vertices.iter().map(|v| turn * v + shift).collect(), ..self.clone() }
    }

    /// Text of the model file.
    pub fn text(&self) -> String {
        let thickness = self.thickness.map_or(String::new(), |t| format!("thickness: {t:?},"));
        let more = format!("two_sided: {}, {thickness}", self.two_sided);
        model("mesh", &steel(), &triangle_mesh("m", &self.vertices, &self.triangles, &more))
    }
}
