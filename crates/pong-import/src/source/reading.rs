//! How a mesh file is to be read, and what its content is called if it gives no name.

use crate::affine::Up;
use std::path::{Path, PathBuf};

/// How a file is to be read.
pub struct Reading {
    /// `None` for what the format is known for: y in glTF, z in OBJ and STL, in Collada
    /// what the file says.
    pub up: Option<Up>,
    /// Metres in one unit of the file; a Collada file gives its unit, and this is a factor to it.
    pub unit_m: f64,
    /// Name of the scene to read; glTF only.
    pub scene: Option<String>,
    /// Triangles that a file may make by naming meshes several times.
    pub triangles_max: usize,
    /// Folders beside the file's own that files which it names may lie in.
    pub allowed: Vec<PathBuf>,
}

/// The file's name without folder and ending: what a model without a name is called.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}
