//! Where models may read files: an option of every command that reads models.

use pong_geometry::extension::Extensions;
use std::path::PathBuf;

/// The folders that files may be read from beside the one that names them.
#[derive(clap::Args)]
pub(crate) struct AllowedFolders {
    /// Lets files that a model or mesh file names (meshes, buffers of glTF) be read from this folder too, through links;
    /// without it only from the folder of the file that names them. May be given several times.
    #[arg(long = "allow-files-below", value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
}

impl AllowedFolders {
    /// For what loads models.
    pub(crate) fn extensions(&self) -> Extensions {
        let mut extensions = Extensions::new();
        self.folders.iter().for_each(|folder| extensions.allow_files_below(folder));
        extensions
    }
}
