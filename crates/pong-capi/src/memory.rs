//! Memory of set-up, asked for before it is taken.
//!
//! Rust's collections end the process where the system has no memory for them; a host is told by a status instead. So
//! every call of set-up first asks the system for one block of all that the call can take, and gives it back. Another
//! thread of the host's may take the memory between: that cannot be told.

use crate::failure::Outcome;
use pong_engine::require_memory;
use std::ffi::OsStr;
use std::path::Path;

/// What a call takes whose arguments do not grow: names, ids, a message. Bytes.
const SMALL: usize = 1 << 18;

/// What a value of a model's text (a number, a name, a list) takes at most while it is read and after, bytes, which is when it
/// is a fault to be told; a tenth of it where the text is good. `tests/memory.rs` measures it.
const PER_VALUE: usize = 900;
/// What a byte of text takes beside that: the text itself, names that become paths, messages.
const PER_BYTE: usize = 24;
/// What a byte of a mesh file takes: a vertex of an OBJ file has 20 bytes or more, a facet of an STL file 50.
const PER_MESH_BYTE: usize = 256;

/// For a call of set-up that takes little.
pub(crate) fn require_little() -> Outcome {
    Ok(require_memory("set-up", SMALL, "leave the process more memory")?)
}

/// For an Object with so many movable groups.
pub(crate) fn require_for_object(groups: usize) -> Outcome {
    const PER_GROUP: usize = 1024;
    let bytes = groups.saturating_mul(PER_GROUP).saturating_add(SMALL);
    Ok(require_memory("object", bytes, "leave the process more memory")?)
}

/// For a model in a text whose mesh files lie in a folder.
pub(crate) fn require_for_text(text: &[u8], mesh_dir: Option<&Path>) -> Outcome {
    let bytes = of_text(text).saturating_add(of_meshes(text, mesh_dir));
    Ok(require_memory("model", bytes, "leave the process more memory, or make the model smaller")?)
}

/// For a model in a file. What cannot be read is told by the one who reads it.
pub(crate) fn require_for_file(path: &Path) -> Outcome {
    require_little()?;
    if !path.is_file() {
        return Ok(());
    }
    let Ok(text) = std::fs::read(path) else { return Ok(()) };
    require_for_text(&text, path.parent())
}

/// A bound of the memory that reading a model from a text takes, bytes, meshes in files of their own apart.
pub fn of_text(text: &[u8]) -> usize {
    let values = text.iter().filter(|byte| matches!(byte, b',' | b':' | b'(' | b'[' | b'{')).count() + 1;
    let names = text.len().saturating_mul(PER_BYTE);
    values.saturating_mul(PER_VALUE).saturating_add(names).saturating_add(SMALL)
}

/// Likewise of the mesh files in a folder that a text names.
fn of_meshes(text: &[u8], folder: Option<&Path>) -> usize {
    let Some(entries) = folder.and_then(|folder| folder.read_dir().ok()) else { return 0 };
    // A text that is none, or a name that is none, is told by the one who reads it.
    let Ok(text) = std::str::from_utf8(text) else { return 0 };
    let named = |name: &OsStr| name.to_str().is_some_and(|name| text.contains(name));
    let is_mesh = |path: &Path| {
        let extension = path.extension().map(OsStr::to_ascii_lowercase);
        extension.is_some_and(|extension| extension == "obj" || extension == "stl")
    };
    let meshes = entries.flatten().filter(|entry| is_mesh(&entry.path()) && named(&entry.file_name()));
    let bytes = meshes.filter_map(|entry| entry.metadata().ok()).map(|file| file.len());
    bytes.fold(0, |sum, file| {
        let file = usize::try_from(file).unwrap_or(usize::MAX);
        sum.saturating_add(file.saturating_mul(PER_MESH_BYTE))
    })
}
