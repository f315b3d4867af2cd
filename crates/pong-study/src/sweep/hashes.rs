//! Hashes of all inputs of a study: a kept run is used again only while they are the same.

use crate::{Result, StudyError};
use pong_executive::scene::Scene;
use pong_model::{Extensions, Fnv};
use std::io::Read;
use std::path::Path;

/// A hash of a scene's text and of every model that it names.
pub(crate) fn hash_of_scene(scene: &Scene, text: &str) -> Result<Fnv> {
    let mut hash = Fnv::default();
    hash.text(env!("CARGO_PKG_VERSION"));
    hash.text(text);
    for file in scene.model_files() {
        hash_model(&mut hash, &file, scene.extensions())?;
    }
    Ok(hash)
}

/// Adds the text of a model, and the model's own hash for its mesh files. Faults of a model are reported when
/// it is run.
pub(crate) fn hash_model(hash: &mut Fnv, file: &Path, extensions: &Extensions) -> Result<()> {
    let unreadable = |reason| StudyError::file(file, reason);
    hash.text(&pong_model::files::read_text(file).map_err(unreadable)?);
    let model = pong_model::load(file, extensions);
    hash.word(model.map_or(0, |model| model.hash));
    Ok(())
}

/// Adds the bytes of a file, a piece at a time.
pub(crate) fn hash_file(hash: &mut Fnv, path: &Path) -> Result<()> {
    let unreadable = |reason: std::io::Error| StudyError::file(path, reason);
    let mut file = pong_model::files::open(path).map_err(unreadable)?;
    let mut piece = vec![0; 1 << 20];
    loop {
        let read = file.read(&mut piece).map_err(unreadable)?;
        if read == 0 {
            return Ok(());
        }
        hash.bytes(&piece[..read]);
    }
}
