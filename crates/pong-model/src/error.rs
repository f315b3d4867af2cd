//! What is wrong with a model file, where, and what to do about it.

use crate::printable;
use std::fmt;

/// One fault of a model file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelError {
    /// The file as the caller named it.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// Place in the model's tree, `vehicle/arm/tip`, or the entry of a table, `surfaces/steel`.
    pub path: String,
    /// Name of the rule that is broken; stable from version to version.
    pub rule: &'static str,
    /// What is wrong.
    pub cause: String,
    /// What would make it right.
    pub cure: String,
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, column, path, rule, cause, cure } = self;
        let [file, path, cause, cure] = [file, path, cause, cure].map(|text| printable(text));
        write!(f, "{file}:{line}:{column}: {path}: [{rule}] {cause}; {cure}")
    }
}

impl std::error::Error for ModelError {}

/// Every fault of a model file, in the order of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelErrors(pub Vec<ModelError>);

impl fmt::Display for ModelErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, error) in self.0.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for ModelErrors {}
