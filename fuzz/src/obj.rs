//! OBJ files.

use crate::mesh;

/// Runs both readers.
pub fn run(data: &[u8]) {
    mesh::import(data, "obj");
    mesh::load(data, "obj");
}
