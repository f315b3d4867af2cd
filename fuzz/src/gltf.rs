//! glTF files: JSON, and the binary container.

use crate::mesh;

/// Runs an import; the container is recognised by its first bytes.
pub fn run(data: &[u8]) {
    mesh::import(data, if data.starts_with(b"glTF") { "glb" } else { "gltf" });
}
