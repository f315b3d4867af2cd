//! A folder of one's own for model files.

use crate::terrain::{Source, Terrain};
use std::path::PathBuf;

/// It goes when it is dropped.
pub struct Folder(PathBuf);

impl Folder {
    /// An empty one, named after the program.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn new(program: &str) -> std::io::Result<Self> {
        let path = std::env::temp_dir().join(format!("pong_{program}_{}", std::process::id()));
        std::fs::create_dir(&path)?;
        Ok(Self(path))
    }

    /// Writes a terrain: the model file, and the bytes of it and of the mesh file that it names. Another terrain from
    /// the same kind of file takes its place.
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
        // Nothing to be done about a folder that will not go.
        _ = std::fs::remove_dir_all(&self.0);
    }
}
