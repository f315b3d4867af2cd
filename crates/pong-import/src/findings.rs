//! Faults of a file, and notes for its author.

use pong_model::printable;
use std::fmt;

/// One fault or note: the thing, the cause and, for faults, the cure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Place in the source: the file, or `file: node/node` for glTF, object names for OBJ.
    pub path: String,
    /// Name of the rule, stable from version to version (docs/importing.md lists them).
    pub rule: &'static str,
    /// The fault, or the change that was made.
    pub cause: String,
    /// The cure; empty if nothing need be done.
    pub cure: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, rule, cause, cure } = self;
        let [path, cause, cure] = [path, cause, cure].map(|text| printable(text));
        match &*cure {
            "" => write!(f, "{path}: [{rule}] {cause}"),
            cure => write!(f, "{path}: [{rule}] {cause}; {cure}"),
        }
    }
}

/// All findings of one import, in the order they were made.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Faults, which prevent the import.
    pub faults: Vec<Finding>,
    /// Notes for the author of an imported file.
    pub notes: Vec<Finding>,
}

impl Findings {
    /// Adds a fault, which prevents the import.
    pub fn fault(
        &mut self,
        path: &str,
        rule: &'static str,
        cause: impl Into<String>,
        cure: impl Into<String>,
    ) {
        self.faults.push(Finding { path: path.to_owned(), rule, cause: cause.into(), cure: cure.into() });
    }

    /// Adds a fault and returns `None` in place of a value.
    pub fn refuse<T>(
        &mut self,
        path: &str,
        rule: &'static str,
        cause: impl Into<String>,
        cure: impl Into<String>,
    ) -> Option<T> {
        self.fault(path, rule, cause, cure);
        None
    }

    /// Adds a note for the author.
    pub fn note(
        &mut self,
        path: &str,
        rule: &'static str,
        cause: impl Into<String>,
        cure: impl Into<String>,
    ) {
        self.notes.push(Finding { path: path.to_owned(), rule, cause: cause.into(), cure: cure.into() });
    }

    /// The value; `None` after its fault is noted.
    pub fn ok<T>(&mut self, result: Result<T, Finding>) -> Option<T> {
        result.map_err(|fault| self.faults.push(fault)).ok()
    }
}

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let notes = self.notes.iter().map(|note| format!("note: {note}"));
        let faults = self.faults.iter().map(|fault| format!("error: {fault}"));
        f.write_str(&notes.chain(faults).collect::<Vec<_>>().join("\n"))
    }
}
