//! Errors, each with thing, cause and cure.

use pong_engine::EngineError;
use pong_executive::ExecutiveError;
use pong_executive::scene::SceneErrors;
use pong_record::LogError;
use std::fmt::Display;

/// An error of an identification. Its text has a line for each fault.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct FitError(pub String);

/// Result of an identification.
pub type Result<T, E = FitError> = std::result::Result<T, E>;

impl FitError {
    /// Error of a thing, from cause and cure.
    pub(crate) fn new(thing: impl Display, cause: impl Display, cure: impl Display) -> Self {
        Self(format!("{thing}: {cause}; {cure}"))
    }
}

/// Converts errors whose text already has thing, cause and cure.
macro_rules! complete_text {
    ($($error:ty),*) => {
        $(impl From<$error> for FitError {
            fn from(error: $error) -> Self {
                Self(error.to_string())
            }
        })*
    };
}

complete_text!(EngineError, ExecutiveError, LogError, SceneErrors);
