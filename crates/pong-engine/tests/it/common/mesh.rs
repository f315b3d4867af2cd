//! A mesh written by code, with what its author says of it.

use pong_geometry::{Quat, Vec3};
use pong_testkit::ron::{model, surface, triangle_mesh};

/// Of every surface of these tests, N/m.
const STIFFNESS: f64 = 1e5;
/// Of two such surfaces that touch, N/m.
pub const SERIES: f64 = 0.5 * STIFFNESS;

/// The surface of these tests.
pub fn steel() -> String {
    surface(STIFFNESS, "normal: Linear(damping: 0.0)")
}

/// A mesh and what its author says of it.
#[derive(Clone)]
pub struct Mesh {
    pub vertices: Vec<Vec3>,
    pub triangles: Vec<[usize; 3]>,
    pub two_sided: bool,
    pub thickness: Option<f64>,
}

impl Mesh {
    /// One-sided, of the default thickness.
    pub fn new(vertices: Vec<Vec3>, triangles: Vec<[usize; 3]>) -> Self {
        Self { vertices, triangles, two_sided: false, thickness: None }
    }

    /// In other axes.
    pub fn turned(&self, turn: &Quat, shift: &Vec3) -> Self {
        Self { vertices: self.vertices.iter().map(|v| turn * v + shift).collect(), ..self.clone() }
    }

    /// The model file.
    pub fn text(&self) -> String {
        let thickness = self.thickness.map_or(String::new(), |t| format!("thickness: {t:?},"));
        let more = format!("two_sided: {}, {thickness}", self.two_sided);
        model("mesh", &steel(), &triangle_mesh("m", &self.vertices, &self.triangles, &more))
    }
}
