//! Refusals of calls.

/// Refusal of a call, with thing, cause and cure. The instance is as it was before the call.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Refusal {
    /// True if a shorter step, or another value, may succeed; otherwise the simulation cannot go on.
    pub may_retry: bool,
    pub text: String,
}

impl Refusal {
    /// Refusal of a wrong call or file.
    pub fn error(text: impl Into<String>) -> Self {
        Self { may_retry: false, text: text.into() }
    }

    /// Refusal of a state or a value; another one may be accepted.
    pub fn discard(text: impl Into<String>) -> Self {
        Self { may_retry: true, text: text.into() }
    }
}
