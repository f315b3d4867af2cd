//! Errors, each with thing, cause and cure.

use pong_executive::scene::SceneErrors;
use pong_model::ModelErrors;
use pong_record::LogError;
use std::fmt::Display;
use std::path::Path;

/// An error of a study.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct StudyError(pub String);

/// Result of a study.
pub type Result<T, E = StudyError> = std::result::Result<T, E>;

impl StudyError {
    /// Error of a thing, from a line with cause and cure.
    pub(crate) fn new(thing: &str, line: impl Display) -> Self {
        Self(format!("{thing}: {line}"))
    }

    /// Error of a file, from a line with cause and cure.
    pub(crate) fn file(path: &Path, line: impl Display) -> Self {
        Self::new(&path.display().to_string(), line)
    }

    /// Error of an output file that cannot be written.
    pub(crate) fn output(path: &Path, reason: impl Display) -> Self {
        Self::file(path, format!("{reason}; name another folder with -o"))
    }
}

/// Converts errors whose text already has thing, cause and cure.
macro_rules! told_already {
    ($($error:ty),*) => {
        $(impl From<$error> for StudyError {
            fn from(error: $error) -> Self {
                Self(error.to_string())
            }
        })*
    };
}

told_already!(LogError, ModelErrors, SceneErrors);
