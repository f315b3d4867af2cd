//! Helpers for writing models.

pub mod families;
pub mod held;
pub mod solids;

use pong_model::{Extensions, Model, ModelErrors};

/// Faces of [`cube_vertices`], counter-clockwise from outside: −z, +z, −y, +x, +y, −x.
pub const CUBE_FACES: &str = "[[0,3,2,1], [4,5,6,7], [0,1,5,4], [1,2,6,5], [2,3,7,6], [3,0,4,7]]";

/// Corners of a box.
pub fn cube_vertices(low: [f64; 3], high: [f64; 3]) -> String {
    let ([x, y, z], [u, v, w]) = (low, high);
    format!(
        "[({x:?},{y:?},{z:?}), ({u:?},{y:?},{z:?}), ({u:?},{v:?},{z:?}), ({x:?},{v:?},{z:?}), \
          ({x:?},{y:?},{w:?}), ({u:?},{y:?},{w:?}), ({u:?},{v:?},{w:?}), ({x:?},{v:?},{w:?})]"
    )
}

/// A box with some of its faces inactive.
pub fn cube(name: &str, low: [f64; 3], high: [f64; 3], inactive: &str) -> String {
    format!(
        "Polyhedron(name: \"{name}\", vertices: {}, faces: {CUBE_FACES}, inactive_faces: {inactive})",
        cube_vertices(low, high)
    )
}

/// A model with one group of primitives.
pub fn model_of(primitives: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"steel\": (stiffness: 1e6) }},\n\
         root: (name: \"root\", surface: \"steel\", primitives: [\n{primitives}\n]))"
    )
}

/// Reads a valid model.
pub fn load(text: &str) -> Model {
    match pong_model::parse(text, "test.ron", None, &Extensions::new()) {
        Ok(model) => model,
        Err(errors) => panic!("{errors}"),
    }
}

/// Reads an invalid model and returns its faults.
pub fn faults(text: &str) -> ModelErrors {
    match pong_model::parse(text, "test.ron", None, &Extensions::new()) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(errors) => errors,
    }
}
