//! What is studied: a scene, whose motion follows from its wrenches, or a log, whose motion is what it is.

use crate::StudyError;
use crate::sweep::level::Level;
use crate::sweep::open_loop::LoggedRun;
use crate::sweep::run::{self, Ended, Frames};
use pong_executive::scene::Scene;
use pong_geometry::extension::Extensions;
use pong_model::Fnv;
use std::path::Path;

/// A scene or a log.
pub(crate) enum Subject {
    Scene(Box<Scene>),
    Log(Box<LoggedRun>),
}

impl Subject {
    /// Runs a level and records it.
    pub fn record(&mut self, level: &Level, frames: &Frames) -> Result<Ended, StudyError> {
        match self {
            Self::Scene(scene) => run::record(scene, level, frames),
            Self::Log(log) => log.record(level, frames).map(Ended::Whole),
        }
    }

    /// Runs a level that is known to reach the end, and times every frame, ns.
    pub fn time(&mut self, level: &Level, frames: &Frames) -> Result<Vec<u64>, StudyError> {
        match self {
            Self::Scene(scene) => run::time(scene, level, frames),
            Self::Log(log) => log.time(level, frames),
        }
    }

    pub fn name(&self) -> &str {
        match self {
            Self::Scene(scene) => scene.name(),
            Self::Log(log) => log.name(),
        }
    }

    pub fn alternatives(&self) -> Vec<String> {
        match self {
            Self::Scene(scene) => scene.alternatives().map(str::to_owned).collect(),
            Self::Log(log) => log.alternatives(),
        }
    }
}

/// A hash of a scene's text and of every model that it names.
pub(crate) fn hash_of_scene(scene: &Scene, text: &str) -> Result<Fnv, StudyError> {
    let mut hash = Fnv::default();
    hash.text(env!("CARGO_PKG_VERSION"));
    hash.text(text);
    for file in scene.model_files() {
        hash_model(&mut hash, &file, scene.extensions())?;
    }
    Ok(hash)
}

/// The text of a model and the model's own hash: meshes lie in files of their own. What is wrong with a model is told
/// when it is run.
pub(crate) fn hash_model(hash: &mut Fnv, file: &Path, extensions: &Extensions) -> Result<(), StudyError> {
    let unreadable = |reason| StudyError::file(file, reason);
    hash.text(&pong_model::files::read_text(file).map_err(unreadable)?);
    let model = pong_model::load(file, extensions);
    hash.word(model.map_or(0, |model| model.hash));
    Ok(())
}
