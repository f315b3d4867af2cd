//! Faults of a scene file: place, cause and cure.

use pong_model::{printable, printable_lines};

/// One fault of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// The file as the caller named it.
    pub file: String,
    /// Line and column, from 1, for a fault of the notation.
    pub at: Option<(usize, usize)>,
    /// The thing, `objects/ball/bodies[0]`.
    pub thing: String,
    /// The fault; the full report of another reader if that found it.
    pub cause: String,
    /// The remedy.
    pub cure: String,
}

impl std::fmt::Display for SceneError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // The cause may be the whole report of the model's reader: a line for each fault, each printable
        // already.
        write!(f, "{}", printable(&self.file))?;
        if let Some((line, column)) = self.at {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}: {}", printable(&self.thing), printable_lines(&self.cause))?;
        if self.cure.is_empty() { Ok(()) } else { write!(f, "; {}", printable(&self.cure)) }
    }
}

impl std::error::Error for SceneError {}

/// Every fault of a scene, in the order of the file's sections.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
pub struct SceneErrors(pub Vec<SceneError>);

/// Collects faults of one file.
pub(crate) struct Faults<'a> {
    file: &'a str,
    pub list: Vec<SceneError>,
}

impl<'a> Faults<'a> {
    pub fn new(file: &'a str) -> Self {
        Self { file, list: Vec::new() }
    }

    pub fn note(&mut self, thing: impl Into<String>, cause: impl Into<String>, cure: impl Into<String>) {
        let (file, thing, cause, cure) = (self.file.to_owned(), thing.into(), cause.into(), cure.into());
        self.list.push(SceneError { file, at: None, thing, cause, cure });
    }

    /// Notes a fault from a line with cause and cure.
    pub fn note_line(&mut self, thing: impl Into<String>, line: &str) {
        let (cause, cure) = line.split_once("; ").unwrap_or((line, ""));
        self.note(thing, cause, cure);
    }

    /// Collector for the faults of one thing.
    pub fn at(&mut self, thing: impl Into<String>) -> At<'_, 'a> {
        At { thing: thing.into(), faults: self }
    }

    /// Returns the value if there are no faults.
    ///
    /// # Errors
    /// All faults, if there are any.
    pub fn unless_any<T>(self, value: Option<T>) -> Result<T, SceneErrors> {
        match value {
            Some(value) if self.list.is_empty() => Ok(value),
            _ => Err(SceneErrors(self.list)),
        }
    }
}

/// Collects faults of one thing in a file.
pub(crate) struct At<'f, 'a> {
    thing: String,
    pub faults: &'f mut Faults<'a>,
}

impl At<'_, '_> {
    pub fn note(&mut self, cause: impl Into<String>, cure: impl Into<String>) {
        self.faults.note(&self.thing, cause, cure);
    }

    /// Notes a fault from a line with cause and cure.
    pub fn note_line(&mut self, line: &str) {
        self.faults.note_line(&self.thing, line);
    }

    pub fn finite(&mut self, name: &str, values: &[f64]) -> bool {
        let found = values.iter().find(|value| !value.is_finite());
        if let Some(value) = found {
            self.note(format!("`{name}` holds {value}"), "give finite numbers");
        }
        found.is_none()
    }
}
