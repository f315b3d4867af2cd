//! STL files, binary and text.

use crate::mesh;

/// Runs both readers.
pub fn run(data: &[u8]) {
    mesh::import(data, "stl");
    mesh::load(data, "stl");
}
