//! Errors of making a page.

use pong_model::ModelErrors;
use pong_record::LogError;
use std::path::PathBuf;

/// Cause why a log cannot be shown. The text names the thing, the cause and the cure.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// The log cannot be read.
    #[error(transparent)]
    Log(#[from] LogError),
    /// A model of the log cannot be read.
    #[error(transparent)]
    Model(ModelErrors),
    /// A model and the log do not belong together.
    #[error(
        "{model}: {cause}; the model was changed after the run: put back the file that the log was written with"
    )]
    Foreign {
        /// The file of the model.
        model: PathBuf,
        /// The mismatch.
        cause: String,
    },
    /// The log has no frames.
    #[error("{0}: holds no whole frame, so there is nothing to show; let the run write at least one frame")]
    Empty(PathBuf),
    /// The data cannot be packed.
    #[error("the page's data cannot be packed: {0}; free some memory")]
    Packing(std::io::Error),
}
