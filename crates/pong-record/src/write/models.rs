//! The models of a log: their files as they were loaded, with their meshes.

use crate::error::LogError;
use crate::run::{RunModel, is_inside};
use pong_engine::World;
use pong_model::{Extensions, Model};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Source of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ModelSource {
    /// A file; meshes lie beside it.
    File(PathBuf),
    /// A text in memory.
    Text {
        /// The text.
        text: String,
        /// Folder of its meshes.
        mesh_dir: Option<PathBuf>,
    },
}

/// Folder of the models in a log.
pub(super) const FOLDER: &str = "models";

/// Copies the models of a world into the folder of a log, and checks that the copies give the world's models.
pub(super) fn keep(world: &World, sources: &[ModelSource], folder: &Path) -> Result<Vec<RunModel>, LogError> {
    if sources.len() != world.scene().models().len() {
        let cause =
            format!("{} sources are given for {} models", sources.len(), world.scene().models().len());
        return Err(LogError::refused(
            cause,
            "give one for each model, in the order in which they were added",
        ));
    }
    let mut taken = BTreeSet::new();
    let models = world.scene().models().zip(sources);
    models
        .map(|((_, model), source)| keep_one(world.scene().extensions(), model, source, folder, &mut taken))
        .collect()
}

fn keep_one(
    extensions: &Extensions,
    model: &Model,
    source: &ModelSource,
    folder: &Path,
    taken: &mut BTreeSet<String>,
) -> Result<RunModel, LogError> {
    let fails = |cause: String, cure: &str| {
        let (name, cure) = (model.name.clone(), cure.to_owned());
        LogError::Model { name, cause, cure }
    };
    let (text, base, name) = match source {
        ModelSource::File(path) => {
            let text = pong_model::files::read_text(path).map_err(|reason| {
                fails(format!("{}: {reason}", path.display()), "keep its file where it was")
            })?;
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            (text, Some(path.parent().unwrap_or(Path::new("")).to_owned()), name)
        }
        ModelSource::Text { text, mesh_dir } => {
            (text.clone(), mesh_dir.clone(), format!("{}.ron", plain(&model.name)))
        }
    };
    let file = format!("{FOLDER}/{}/{name}", free_name(&plain(&model.name), taken));
    let path = folder.join(&file);
    let home = path.parent().unwrap_or(folder);
    let written = std::fs::create_dir_all(home).and_then(|()| std::fs::write(&path, &text));
    written.map_err(|reason| LogError::unwritable(&path, &reason))?;
    if let Some(base) = &base {
        copy_meshes(&text, base, home)?;
    }
    match pong_model::load(&path, extensions) {
        Ok(copy) if copy.hash == model.hash => {
            Ok(RunModel { name: model.name.clone(), file, hash: model.hash })
        }
        Ok(_) => Err(fails(
            "its file was changed since it was loaded".to_owned(),
            "load it again, or leave it as it is until the log is begun",
        )),
        Err(errors) => {
            Err(fails(format!("its copy cannot be read: {errors}"), "leave its files as they were"))
        }
    }
}

/// Copies the mesh files that the text of a model may name: every quoted name of an existing file of such a
/// type.
fn copy_meshes(text: &str, base: &Path, home: &Path) -> Result<(), LogError> {
    let is_mesh = |quoted: &&str| {
        let lower = quoted.to_lowercase();
        (lower.ends_with(".obj") || lower.ends_with(".stl")) && is_inside(quoted)
    };
    // Tries the text inside and outside of quotes, because a quote in a comment may swap the two.
    for mesh in text.split('"').filter(is_mesh) {
        let (from, to) = (base.join(mesh), home.join(mesh));
        if from.is_file() {
            let copied = std::fs::create_dir_all(to.parent().unwrap_or(home))
                .and_then(|()| pong_model::files::read(&from))
                .and_then(|bytes| std::fs::write(&to, bytes));
            copied.map_err(|reason| LogError::unwritable(&to, &reason))?;
        }
    }
    Ok(())
}

/// A file name that any file system accepts.
fn plain(name: &str) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() || "_-".contains(c) { c } else { '_' };
    let plain: String = name.chars().take(80).map(kept).collect();
    if plain.is_empty() { "model".to_owned() } else { plain }
}

fn free_name(name: &str, taken: &mut BTreeSet<String>) -> String {
    let numbered = (2..).map(|number| format!("{name}_{number}"));
    let free = std::iter::once(name.to_owned()).chain(numbered).find(|name| !taken.contains(name));
    let free = free.expect("there are more numbers than models");
    taken.insert(free.clone());
    free
}
