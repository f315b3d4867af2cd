//! Where models may read files: an option of every command that reads models. Where changed models of a log go.

use pong_geometry::extension::Extensions;
use std::path::{Path, PathBuf};

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

/// For what is made of the models of a log, which keeps copies of them for itself: `<log>_<what>` in the working folder.
pub(crate) fn beside_a_log(run: &Path, what: &str) -> Option<PathBuf> {
    let name = run.file_name().unwrap_or_default().to_string_lossy();
    run.is_dir().then(|| PathBuf::from(format!("{name}_{what}")))
}
