//! Errors of a model file: fault, position and cure.

use crate::printable;

/// Fault of a model file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{}:{line}:{column}: {}: [{rule}] {}; {}",
    printable(.file), printable(.path), printable(.cause), printable(.cure)
)]
pub struct ModelError {
    /// File name as given by the caller.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// Path in the model's tree, `vehicle/arm/tip`, or the entry of a table, `surfaces/steel`.
    pub path: String,
    /// Name of the broken rule; stable from version to version.
    pub rule: &'static str,
    /// Cause of the fault.
    pub cause: String,
    /// Cure: a change that makes the file valid.
    pub cure: String,
}

/// All faults of a model file, in file order.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
pub struct ModelErrors(pub Vec<ModelError>);
