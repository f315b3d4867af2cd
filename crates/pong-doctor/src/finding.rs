//! One line of the report.

use serde::Serialize;

/// What a finding says about real time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// As a real-time program wants it.
    Good,
    /// It works without, with longer delays; the cure says what to change.
    Advice,
    /// Neither good nor bad.
    Info,
    /// The system does not tell.
    Unknown,
}

/// What the machine grants in one respect.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// What it is about; a name that stays the same.
    pub name: &'static str,
    /// How it is.
    pub state: State,
    /// What was found, with units.
    pub found: String,
    /// Why it matters.
    pub meaning: &'static str,
    /// What to change, where something is to be changed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cure: Option<&'static str>,
}

impl Finding {
    /// Without a cure.
    pub(crate) fn new(name: &'static str, state: State, found: String, meaning: &'static str) -> Self {
        Self { name, state, found, meaning, cure: None }
    }

    /// Good if `good`, and otherwise advice with this cure.
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

    /// Not told by the system, for this reason.
    pub(crate) fn unknown(name: &'static str, why: &str, meaning: &'static str) -> Self {
        Self::new(name, State::Unknown, why.to_owned(), meaning)
    }
}
