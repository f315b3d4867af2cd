//! Kinds of modes, and the error of modes that cannot be computed.

use pong_engine::EngineError;

/// Kind of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModeKind {
    /// No stiffness: the bodies move as one or slide freely.
    Rigid,
    /// An oscillation.
    Oscillation,
    /// Negative stiffness: the state is not stable.
    Unstable,
}

pub(super) fn bad(cause: &str) -> EngineError {
    EngineError::BadValue { what: "modes".to_owned(), cause: cause.to_owned() }
}
