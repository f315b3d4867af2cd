//! A temporary folder for model files.

use crate::terrain::{Source, Terrain};
use std::path::PathBuf;

/// Removed when it is dropped.
pub struct Folder(PathBuf);

impl Folder {
    /// Creates an empty folder named after the program.
    ///
    /// # Errors
    /// The folder cannot be created.
    pub fn new(program: &str) -> std::io::Result<Self> {
        let path = std::env::temp_dir().join(format!("pong_{program}_{}", std::process::id()));
        std::fs::create_dir(&path)?;
        Ok(Self(path))
    }

    /// Writes a terrain as a model file and its mesh file, and returns the path and their bytes. Replaces an
    /// earlier terrain from the same kind of file.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, terrain: Terrain, source: Source) -> std::io::Result<(PathBuf, usize)> {
        let (text, mesh) = terrain.files(source);
        let path = self.0.join(format!("terrain_{source:?}.ron"));
        let mut bytes = text.len();
        std::fs::write(&path, text)?;
        if let Some((name, content)) = mesh {
            bytes += content.len();
            std::fs::write(self.0.join(name), content)?;
        }
        Ok((path, bytes))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that cannot be removed is left.
        _ = std::fs::remove_dir_all(&self.0);
    }
}
