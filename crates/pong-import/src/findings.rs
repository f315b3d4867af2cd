//! What is wrong with a file, and what its author should know.

use pong_model::printable;
use std::fmt;

/// One fault or note: the thing, the cause and, for faults, the cure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Place in the source: the file, or `file: node/node` for glTF, object names for OBJ.
    pub path: String,
    /// Name of the rule, stable from version to version (docs/importing.md lists them).
    pub rule: &'static str,
    /// What is wrong, or what was done.
    pub cause: String,
    /// What would make it right; empty where nothing need be done.
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
    /// What keeps the file from being imported.
    pub faults: Vec<Finding>,
    /// What the author should know though all went well.
    pub notes: Vec<Finding>,
}

impl Findings {
    /// Adds what keeps the file from being imported.
    pub fn fault(
        &mut self,
        path: &str,
        rule: &'static str,
        cause: impl Into<String>,
        cure: impl Into<String>,
    ) {
        self.faults.push(Finding { path: path.to_owned(), rule, cause: cause.into(), cure: cure.into() });
    }

    /// Adds what keeps the file from being imported, where a value cannot be given for it.
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

    /// Adds what the author should know.
    pub fn note(
        &mut self,
        path: &str,
        rule: &'static str,
        cause: impl Into<String>,
        cure: impl Into<String>,
    ) {
        self.notes.push(Finding { path: path.to_owned(), rule, cause: cause.into(), cure: cure.into() });
    }

    /// The value, or nothing after a fault was noted.
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
