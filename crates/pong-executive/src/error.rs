//! Errors, each with thing, cause and cure.

use pong_engine::{EngineError, SealError};

/// An error of the executive.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExecutiveError {
    /// The engine refused a call.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// An argument cannot be used.
    #[error("{what}: {cause}; {cure}")]
    Invalid {
        /// The thing.
        what: String,
        /// The fault.
        cause: String,
        /// The remedy.
        cure: String,
    },
    /// A state left the range of numbers, or gained energy from nowhere.
    #[error(
        "body `{body}`: {what} at t = {time} s; the step is too long for the stiffness and mass at hand: shorten it{}{cure}",
        if cure.is_empty() { "" } else { " " }
    )]
    Diverged {
        /// The body.
        body: String,
        /// The fault.
        what: String,
        /// When it was noticed, s.
        time: f64,
        /// Required shortening of the step, where it is known.
        cure: String,
    },
}

/// Result of the executive.
pub type Result<T, E = ExecutiveError> = std::result::Result<T, E>;

impl ExecutiveError {
    pub(crate) fn no_longer_finite(body: &str, time: f64) -> Self {
        let what = "its state is no longer finite".to_owned();
        Self::Diverged { body: body.to_owned(), what, time, cure: String::new() }
    }

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
