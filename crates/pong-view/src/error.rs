//! Why there is no page.

use pong_model::ModelErrors;
use pong_record::LogError;
use std::path::PathBuf;

/// Why a log cannot be shown. The text names the thing, the cause and the cure.
#[derive(Debug)]
#[non_exhaustive]
pub enum ViewError {
    /// The log cannot be read.
    Log(LogError),
    /// A model of the log cannot be read.
    Model(ModelErrors),
    /// A model and the log do not belong together.
    Foreign {
        /// The file of the model.
        model: PathBuf,
        /// What does not fit.
        cause: String,
    },
    /// There is nothing to show.
    Empty(PathBuf),
    /// The data cannot be packed.
    Packing(std::io::Error),
}

impl std::fmt::Display for ViewError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Log(error) => error.fmt(f),
            Self::Model(errors) => errors.fmt(f),
            Self::Foreign { model, cause } => write!(
                f,
                "{}: {cause}; the model was changed after the run: put back the file that the log was written with",
                model.display()
            ),
            Self::Empty(folder) => write!(
                f,
                "{}: holds no whole frame, so there is nothing to show; let the run write at least one frame",
                folder.display()
            ),
            Self::Packing(reason) => {
                write!(f, "the page's data cannot be packed: {reason}; free some memory")
            }
        }
    }
}

impl std::error::Error for ViewError {}

impl From<LogError> for ViewError {
    fn from(error: LogError) -> Self {
        Self::Log(error)
    }
}
