//! What is wrong with a model file, where, and what to do about it.

use crate::printable;

/// One fault of a model file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{}:{line}:{column}: {}: [{rule}] {}; {}",
    printable(.file), printable(.path), printable(.cause), printable(.cure)
)]
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

/// Every fault of a model file, in the order of the file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
pub struct ModelErrors(pub Vec<ModelError>);
