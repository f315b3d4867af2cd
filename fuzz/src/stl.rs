//! STL files, binary and text.

use crate::mesh;

/// Through both readers.
pub fn run(data: &[u8]) {
    mesh::import(data, "stl");
    mesh::load(data, "stl");
}
