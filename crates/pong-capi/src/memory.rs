//! Check of the memory of set-up before it is taken.
//!
//! Rust's collections abort the process where the system has no memory for them; a host gets a status
//! instead. So every call of set-up first allocates one block as large as the call can need, and frees it.
//! Another thread of the host may take the memory in between; that is not detected.

use crate::failure::Outcome;
use pong_arena::require_memory;
use std::ffi::OsStr;
use std::path::Path;

/// Memory of a call whose arguments do not grow: names, ids, a message. Bytes.
const SMALL: usize = 1 << 18;

/// Most memory per value of a model's text (a number, a name, a list) while it is read and after, bytes. A
/// value with a fault to report takes this much; a good one takes a tenth. `tests/memory.rs` measures it.
const PER_VALUE: usize = 900;
/// Memory per byte of text beside that: the text itself, names that become paths, messages.
const PER_BYTE: usize = 24;
/// Memory per byte of a mesh file: a vertex of an OBJ file has 20 bytes or more, a facet of an STL file 50.
const PER_MESH_BYTE: usize = 256;

/// Checks the memory of a call of set-up that takes at most `SMALL`.
pub(crate) fn require_small() -> Outcome {
    Ok(require_memory("set-up", SMALL, "leave the process more memory")?)
}

/// Checks the memory of an Object with this number of movable groups.
pub(crate) fn require_for_object(groups: usize) -> Outcome {
    const PER_GROUP: usize = 1024;
    let bytes = groups.saturating_mul(PER_GROUP).saturating_add(SMALL);
    Ok(require_memory("object", bytes, "leave the process more memory")?)
}

/// Checks the memory of a model from a text, with its mesh files in a folder.
pub(crate) fn require_for_text(text: &[u8], mesh_dir: Option<&Path>) -> Outcome {
    let bytes = of_text(text).saturating_add(of_meshes(text, mesh_dir));
    Ok(require_memory("model", bytes, "leave the process more memory, or make the model smaller")?)
}

/// Checks the memory of a model from a file. A file that cannot be read is reported by the reader.
pub(crate) fn require_for_file(path: &Path) -> Outcome {
    require_small()?;
    if !path.is_file() {
        return Ok(());
    }
    let Ok(text) = std::fs::read(path) else { return Ok(()) };
    require_for_text(&text, path.parent())
}

/// Upper bound of the memory that reading a model from a text takes, bytes, mesh files excluded.
pub fn of_text(text: &[u8]) -> usize {
    let values = text.iter().filter(|byte| matches!(byte, b',' | b':' | b'(' | b'[' | b'{')).count() + 1;
    let names = text.len().saturating_mul(PER_BYTE);
    values.saturating_mul(PER_VALUE).saturating_add(names).saturating_add(SMALL)
}

/// Upper bound of the memory for the mesh files in a folder that a text names, bytes.
fn of_meshes(text: &[u8], folder: Option<&Path>) -> usize {
    let Some(entries) = folder.and_then(|folder| folder.read_dir().ok()) else { return 0 };
    // Invalid text and invalid names are reported by the reader.
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
