//! Model files that become one model: reading, free names, and paths of meshes around [`join`].

use crate::authored::{self, Node};
use crate::error::ModelErrors;
use crate::extensions::Extensions;
use crate::join::{Source, join};
use crate::model::Model;
use crate::write;
use pong_geometry::Pose;
use std::path::{Path, PathBuf};

/// Model file, and the pose of its root in the frame of the joined model.
#[derive(Clone, Debug)]
pub struct PlacedFile {
    /// Model file. Several placed files may name the same one.
    pub path: PathBuf,
    /// Pose of its root.
    pub pose: Pose,
}

/// Reason why model files cannot be joined.
#[derive(Clone, Debug, thiserror::Error)]
pub enum JoinError {
    /// Faults of one of the files.
    #[error("{0}")]
    Model(#[from] ModelErrors),
    /// Cause and cure.
    #[error("{0}")]
    Cause(String),
}

/// Text of one model that joins model files, as a file of `folder`: meshes are named from there. With `one_surface`
/// all faces of the root's rigid body are one surface.
///
/// The root of each file becomes a group named after its model, with a number behind it where the name is taken.
///
/// # Errors
/// A file has faults, or its mesh is not below `folder`; or as [`join`].
pub fn join_files(
    name: &str,
    files: &[PlacedFile],
    folder: &Path,
    one_surface: bool,
    extensions: &Extensions,
) -> Result<String, JoinError> {
    let mut read: Vec<(String, Node, Model)> = Vec::new();
    for placed in files {
        let document = authored::load(&placed.path)?;
        let model = crate::load(&placed.path, extensions)?;
        read.push((free_name(&read, &model.name), document, model));
    }
    let meshes: Vec<Option<String>> = files.iter().map(|placed| below(folder, &placed.path)).collect();
    let sources: Vec<Source<'_>> = read
        .iter()
        .zip(files.iter().zip(&meshes))
        .map(|((name, document, model), (placed, meshes))| Source {
            name,
            document,
            model,
            pose: placed.pose,
            meshes: meshes.as_deref(),
        })
        .collect();
    Ok(write::text(&join(name, &sources, one_surface).map_err(JoinError::Cause)?))
}

/// The deepest folder that all files are below, links resolved; `None` without one, or if a file is missing.
pub fn common_folder(files: &[PlacedFile]) -> Option<PathBuf> {
    let mut folders = files.iter().map(|placed| whole(placed.path.parent()?));
    let first = folders.next()??;
    folders.try_fold(first, |common, folder| {
        let folder = folder?;
        let found = common.ancestors().find(|ancestor| folder.starts_with(ancestor));
        found.map(Path::to_path_buf)
    })
}

/// Name of a group that no earlier model has: that of the model, with a number if it is taken.
fn free_name(earlier: &[(String, Node, Model)], name: &str) -> String {
    let own = name.replace('/', "_");
    let numbered = (2..).map(|number| format!("{own}_{number}"));
    let mut names = std::iter::once(own.clone()).chain(numbered);
    names.find(|name| earlier.iter().all(|(taken, _, _)| taken != name)).unwrap_or_default()
}

/// Path from a folder to the folder of a file, ending in `/`; empty for the same folder. `None` if the file is not
/// below the folder.
fn below(folder: &Path, file: &Path) -> Option<String> {
    let (folder, of_file) = (whole(folder)?, whole(file.parent()?)?);
    let names =
        of_file.strip_prefix(folder).ok()?.iter().map(|name| name.to_str().map(|name| format!("{name}/")));
    names.collect()
}

/// Absolute path of a folder without links.
fn whole(folder: &Path) -> Option<PathBuf> {
    let here = if folder == Path::new("") { Path::new(".") } else { folder };
    std::fs::canonicalize(here).ok()
}
