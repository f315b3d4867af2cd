//! What can go wrong, told as thing, cause and cure.

use std::path::Path;

/// An error of a tuning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TuneError(pub String);

impl TuneError {
    /// From the thing and a line that holds cause and cure.
    pub(crate) fn new(thing: &str, line: impl std::fmt::Display) -> Self {
        Self(format!("{thing}: {line}"))
    }

    /// From a file and a line that holds cause and cure.
    pub(crate) fn file(path: &Path, line: impl std::fmt::Display) -> Self {
        Self::new(&path.display().to_string(), line)
    }
}

impl std::fmt::Display for TuneError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for TuneError {}
