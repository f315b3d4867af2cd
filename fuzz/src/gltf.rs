//! glTF files: JSON, and the binary container.

use crate::mesh;

/// The container tells itself by its first bytes.
pub fn run(data: &[u8]) {
    mesh::import(data, if data.starts_with(b"glTF") { "glb" } else { "gltf" });
}
