//! What an importer is told when a call is refused.

/// Why a call was refused: thing, cause and cure. The instance is as it was before the call.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Refusal {
    /// Whether a shorter step, or another value, may succeed; otherwise the simulation cannot go on.
    pub may_retry: bool,
    pub text: String,
}

impl Refusal {
    /// A call or a file that is wrong.
    pub fn error(text: impl Into<String>) -> Self {
        Self { may_retry: false, text: text.into() }
    }

    /// A state or a value that cannot be used: another may.
    pub fn discard(text: impl Into<String>) -> Self {
        Self { may_retry: true, text: text.into() }
    }
}
