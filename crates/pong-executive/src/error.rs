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
        /// The fault of its state.
        cause: String,
        /// What to give instead.
        cure: String,
    },
    /// A state left the range of numbers, or has energy from nowhere.
    #[error(
        "body `{body}`: {what} at t = {time} s; the step is too long for the stiffness and mass at hand: shorten it{}{cure}",
        if cure.is_empty() { "" } else { " " }
    )]
    Diverged {
        /// The body.
        body: String,
        /// What is wrong with it.
        what: String,
        /// When it was noticed, s.
        time: f64,
        /// How far the step must be shortened, where that is known.
        cure: String,
    },
}

/// What the executive answers.
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
