//! Readers of mesh files (glTF, Collada, OBJ, STL), all with the same result: a tree of nodes with geometry.

mod budget;
mod collada;
mod faces;
mod format_fault;
mod gltf;
mod guesses;
mod obj;
mod reading;
mod stl;
mod tree;
mod welder;

use crate::findings::{Finding, Findings};
use std::path::Path;

pub use reading::Reading;
pub use tree::{Look, Node, Shape, Source};

/// Reads a file by the extension of its name.
pub fn read(path: &Path, reading: &Reading, findings: &mut Findings) -> Option<Source> {
    let file = path.display().to_string();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !matches!(ending.as_str(), "dae" | "glb" | "gltf" | "obj" | "stl") {
        let cause = "the name ends in none of .glb, .gltf, .dae, .obj and .stl";
        return findings.refuse(&file, "unknown-format", cause, "export the mesh in one of these formats");
    }
    let bytes = findings.ok(bytes_of(path, &file))?;
    let source = match ending.as_str() {
        "obj" => obj::read(&bytes, path, reading, findings),
        "stl" => stl::read(&bytes, path, reading, findings),
        "dae" => return collada::read(&bytes, path, reading, findings),
        _ => return gltf::read(&bytes, path, reading, findings),
    }?;
    guesses::tell(&source, reading, &file, findings);
    Some(source)
}

/// The bytes of the file that the caller named.
fn bytes_of(path: &Path, called: &str) -> Result<Vec<u8>, Finding> {
    let unreadable = |reason: String| Finding {
        path: called.to_owned(),
        rule: "unreadable",
        cause: format!("it cannot be read: {reason}"),
        cure: "name a mesh file that can be read".to_owned(),
    };
    pong_model::files::read(path).map_err(|reason| unreadable(reason.to_string()))
}
