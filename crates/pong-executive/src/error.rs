//! What can go wrong, told as thing, cause and cure.

use pong_engine::{EngineError, SealError};

/// An error of the executive.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExecutiveError {
    /// The engine refused a call.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// Something that was handed in cannot be used.
    #[error("{what}: {cause}; {cure}")]
    Invalid {
        /// The thing.
        what: String,
        /// What is wrong with it.
        cause: String,
        /// What to give instead.
        cure: String,
    },
    /// A state left the range of numbers.
    #[error(
        "body `{body}`: its state is no longer finite at t = {time} s; the step is too long for the \
         stiffness and mass at hand: shorten it"
    )]
    Diverged {
        /// The body.
        body: String,
        /// When it was noticed, s.
        time: f64,
    },
}

/// What the executive answers.
pub type Result<T, E = ExecutiveError> = std::result::Result<T, E>;

impl ExecutiveError {
    pub(crate) fn invalid(
        what: impl Into<String>,
        cause: impl Into<String>,
        cure: impl Into<String>,
    ) -> Self {
        Self::Invalid { what: what.into(), cause: cause.into(), cure: cure.into() }
    }
}

impl From<SealError> for ExecutiveError {
    fn from(error: SealError) -> Self {
        Self::Engine(error.into())
    }
}
