//! What can go wrong, told as thing, cause and cure.

use std::path::Path;

/// An error of a study.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TradeError(pub String);

impl TradeError {
    /// From the thing and a line that holds cause and cure.
    pub(crate) fn new(thing: &str, line: &str) -> Self {
        Self(format!("{thing}: {line}"))
    }

    pub(crate) fn file(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self(format!("{}: {reason}; name another folder with -o", path.display()))
    }
}

impl std::fmt::Display for TradeError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for TradeError {}
