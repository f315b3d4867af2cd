//! Errors of set-up and frames.

use pong_engine::{EngineError, SealError};
use pong_model::ModelErrors;

/// Error of any call of this crate. Its text names the thing, the cause and the cure; for a model also the
/// file, with line and column.
///
/// ```
/// use pong::{Config, Error, Load, WorldBuilder};
///
/// let mut builder = WorldBuilder::new(Config::default());
/// let refused = builder.load("no/such/ball.ron").unwrap_err();
/// assert!(matches!(refused, Error::Model(_)));
/// assert!(refused.to_string().starts_with("no/such/ball.ron:"));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A model that cannot be read, with all its faults.
    #[error(transparent)]
    Model(#[from] ModelErrors),
    /// A call that the engine refuses.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

/// Reason of a refused seal, without the builder; [`SealError::into_parts`] keeps both.
impl From<SealError> for Error {
    fn from(refused: SealError) -> Self {
        Self::Engine(refused.into())
    }
}
