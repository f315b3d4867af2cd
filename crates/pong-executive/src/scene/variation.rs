//! Changes to a scene: another step, another integrator, other models.

use super::document::Document;
use super::error::Faults;
use crate::integrate::Integrator;
use pong_engine::WorkerSettings;
use pong_model::Model;
use std::path::Path;
use std::sync::Arc;

/// Rewrites a model; an error is a line of cause and cure.
type Rewrite<'a> = &'a dyn Fn(Model) -> Result<Model, String>;

/// Returns a ready model for a file, if there is one.
type Instead<'a> = &'a dyn Fn(&Path) -> Option<Arc<Model>>;

/// Changes to a scene file; none by default.
#[derive(Clone, Default)]
pub struct Variation<'a> {
    /// Another integrator.
    pub integrator: Option<Integrator>,
    /// Another step, s.
    pub step: Option<f64>,
    /// Workers of the world; the results are the same bits.
    pub workers: Option<WorkerSettings>,
    /// Entry of the scene's `alternatives` whose models replace the others.
    pub alternative: Option<&'a str>,
    /// Function that rewrites every model once loaded.
    pub rewrite: Option<Rewrite<'a>>,
    /// Source of ready models: where it has one for a file, the file is not read.
    pub instead: Option<Instead<'a>>,
}

impl Variation<'_> {
    /// The document with the changes that its fields can express.
    pub(super) fn document(&self, document: &Document, faults: &mut Faults<'_>) -> Document {
        let mut varied = document.clone();
        varied.step = self.step.unwrap_or(document.step);
        varied.integrator = self.integrator.unwrap_or(document.integrator);
        if let Some(wanted) = self.alternative {
            match document.alternatives.iter().find(|alternative| alternative.name == wanted) {
                Some(found) => take_models(&mut varied, &found.models),
                None => {
                    let known: Vec<&str> = document.alternatives.iter().map(|a| a.name.as_str()).collect();
                    let cure = format!("name one of those that the scene has: {}", known.join(", "));
                    faults.note("alternatives", format!("there is no alternative `{wanted}`"), cure);
                }
            }
        }
        varied
    }
}

fn take_models(document: &mut Document, instead: &[(String, String)]) {
    for (name, file) in &mut document.models {
        if let Some((_, other)) = instead.iter().find(|(other, _)| other == name) {
            file.clone_from(other);
        }
    }
}

/// Checks that alternatives have distinct names and replace existing models. Their files are read only on
/// use.
pub(super) fn check_alternatives(document: &Document, faults: &mut Faults<'_>) {
    for (index, alternative) in document.alternatives.iter().enumerate() {
        let thing = format!("alternatives/{}", alternative.name);
        if alternative.name.trim().is_empty() {
            faults.note(&thing, "it has no name", "name it");
        }
        if document.alternatives[..index].iter().any(|earlier| earlier.name == alternative.name) {
            faults.note(&thing, "the name is given twice", "rename one of them");
        }
        if alternative.models.is_empty() {
            faults.note(&thing, "it replaces no model", "give `models` the name and the other file of one");
        }
        for (place, (name, _)) in alternative.models.iter().enumerate() {
            if !document.models.iter().any(|(known, _)| known == name) {
                let known: Vec<&str> = document.models.iter().map(|(known, _)| known.as_str()).collect();
                let cure = format!("name one from `models`: {}", known.join(", "));
                faults.note(&thing, format!("there is no model `{name}`"), cure);
            }
            if alternative.models[..place].iter().any(|(earlier, _)| earlier == name) {
                faults.note(&thing, format!("model `{name}` is replaced twice"), "keep one of the files");
            }
        }
    }
}
