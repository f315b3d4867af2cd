//! Errors, each with thing, cause and cure.

use pong_engine::EngineError;

/// An error of a slow host. Nothing has changed: the frame before stays valid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SlowError {
    /// An error of the engine.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// A setting outside its range.
    #[error("setting `{what}`: {cause}")]
    BadSetting {
        /// Name of the setting.
        what: String,
        /// Cause and cure.
        cause: String,
    },
    /// An input of a frame that cannot be used.
    #[error("{what}: {cause}")]
    BadInput {
        /// The input: frame length, or name of the movable group with the quantity.
        what: String,
        /// Cause and cure.
        cause: String,
    },
    /// A call that comes too early.
    #[error("{call}: not allowed now; {cure}")]
    WrongPhase {
        /// The call.
        call: &'static str,
        /// Call that is needed first.
        cure: &'static str,
    },
    /// A saved state that is damaged, or of another scene or version.
    #[error("saved state of a slow host: {cause}; nothing was restored")]
    BadState {
        /// Cause and cure.
        cause: String,
    },
}
