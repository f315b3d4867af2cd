//! Extensions of models by a Rust user, and the folders that models may read.

use std::ops::{Deref, DerefMut};
use std::path::{Path, PathBuf};

/// Kinds and tests registered by a user, to which it dereferences, and the folders that models may read.
#[derive(Clone, Debug, Default)]
pub struct Extensions {
    kinds: pong_geometry::extension::Extensions,
    /// Folders outside a model's own in which files named by the model may lie.
    folders: Vec<PathBuf>,
}

impl Extensions {
    /// No extensions.
    pub fn new() -> Self {
        Self::default()
    }

    /// Allows models to read the mesh files they name from this folder and its subfolders too. Otherwise a
    /// file outside the model's own folder, even through a link, is refused.
    pub fn allow_files_below(&mut self, folder: impl Into<PathBuf>) {
        self.folders.push(folder.into());
    }

    /// Folders allowed in addition to a model's own.
    pub fn folders_allowed(&self) -> impl Iterator<Item = &Path> {
        self.folders.iter().map(PathBuf::as_path)
    }
}

impl Deref for Extensions {
    type Target = pong_geometry::extension::Extensions;

    fn deref(&self) -> &Self::Target {
        &self.kinds
    }
}

impl DerefMut for Extensions {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.kinds
    }
}
