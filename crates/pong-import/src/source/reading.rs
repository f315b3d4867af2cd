//! Options of reading a mesh file, and default names of its content.

use crate::affine::Up;
use std::path::{Path, PathBuf};

/// Options of reading a file.
pub struct Reading {
    /// Upward axis; `None` for the convention of the format: y in glTF, z in OBJ and STL, the file's own in
    /// Collada.
    pub up: Option<Up>,
    /// Metres in one unit of the file; a Collada file gives its unit, and this is a factor to it.
    pub unit_m: f64,
    /// Name of the scene to read; glTF only.
    pub scene: Option<String>,
    /// Most triangles that a file may create by instancing its meshes.
    pub triangles_max: usize,
    /// Folders, besides the file's own, from which referenced files may be read.
    pub allowed: Vec<PathBuf>,
}

/// File name without folder and extension: name of a model that has none.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}
