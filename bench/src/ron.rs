//! Model files as text.

use pong_geometry::Vec3;

/// Surface of every benchmark model.
const SURFACE: &str =
    "\"metal\": (stiffness: 1e5, normal: Linear(damping: 50.0), friction: Bristle(mu: 0.2))";

/// A model of one movable group that holds `primitives`.
pub fn model(name: &str, primitives: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"{name}\", surfaces: {{ {SURFACE} }},\n\
         root: (name: \"{name}\", surface: \"metal\", primitives: [\n{primitives}\n]))\n"
    )
}

/// A vector with all digits.
pub fn vector(v: &Vec3) -> String {
    format!("({:?},{:?},{:?})", v.x, v.y, v.z)
}

/// Vectors, separated by commas.
pub fn vectors(list: &[Vec3]) -> String {
    list.iter().map(vector).collect::<Vec<_>>().join(",")
}
