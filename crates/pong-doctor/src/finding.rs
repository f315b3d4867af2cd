//! One line of the report.

use serde::Serialize;

/// Verdict of a finding for real-time use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// Suitable for a real-time program.
    Good,
    /// Works, but with longer delays; there is a cure.
    Advice,
    /// Neither good nor bad.
    Info,
    /// Not reported by the system.
    Unknown,
}

/// Finding about one property of the machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Its subject; a name that stays the same.
    pub name: &'static str,
    /// Its verdict.
    pub state: State,
    /// The value found, with units.
    pub found: String,
    /// Its meaning for a real-time program.
    pub meaning: &'static str,
    /// The change to make, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cure: Option<&'static str>,
}

impl Finding {
    /// Finding without a cure.
    pub(crate) fn new(name: &'static str, state: State, found: String, meaning: &'static str) -> Self {
        Self { name, state, found, meaning, cure: None }
    }

    /// Good if `good`; otherwise advice with this cure.
    pub(crate) fn judged(
        name: &'static str,
        good: bool,
        found: String,
        meaning: &'static str,
        cure: &'static str,
    ) -> Self {
        if good {
            return Self::new(name, State::Good, found, meaning);
        }
        Self { cure: Some(cure), ..Self::new(name, State::Advice, found, meaning) }
    }

    /// Finding about a property that the system does not report, with the reason.
    pub(crate) fn unknown(name: &'static str, why: &str, meaning: &'static str) -> Self {
        Self::new(name, State::Unknown, why.to_owned(), meaning)
    }
}
