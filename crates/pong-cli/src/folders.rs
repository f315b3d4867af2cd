//! Folders from which models may read files, an option of every command that reads models; and the output
//! folder for models of a log.

use pong_model::Extensions;
use std::path::{Path, PathBuf};

/// Additional folders from which files may be read.
#[derive(clap::Args)]
pub(crate) struct AllowedFolders {
    /// Lets files that a model or mesh file names (meshes, buffers of glTF) be read from this folder too, through links;
    /// without it only from the folder of the file that names them. May be given several times.
    #[arg(long = "allow-files-below", value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
}

impl AllowedFolders {
    /// Extensions that allow these folders.
    pub(crate) fn extensions(&self) -> Extensions {
        let mut extensions = Extensions::new();
        self.folders.iter().for_each(|folder| extensions.allow_files_below(folder));
        extensions
    }
}

/// Output folder for files made from the models of a log, `<log>_<what>` in the working folder, because a
/// log's own folder is left alone. `None` for a scene.
pub(crate) fn beside_a_log(run: &Path, what: &str) -> Option<PathBuf> {
    let name = run.file_name().unwrap_or_default().to_string_lossy();
    run.is_dir().then(|| PathBuf::from(format!("{name}_{what}")))
}
