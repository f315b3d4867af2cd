//! Failure of a call: its status and its message.

use crate::status::pong_status;
use pong_arena::OutOfMemory;
use pong_engine::EngineError;
use pong_model::ModelErrors;
use pong_slow::SlowError;

/// Failure of a call.
#[derive(Debug)]
pub(crate) struct Failure {
    pub status: pong_status,
    pub why: Why,
}

/// Source of the message.
#[derive(Debug)]
pub(crate) enum Why {
    Text(String),
    /// Formatted into the thread's fixed buffer: no memory is taken.
    Error(EngineError),
}

pub(crate) type Outcome<T = ()> = Result<T, Failure>;

impl Failure {
    pub fn new(status: pong_status, message: impl Into<String>) -> Self {
        Self { status, why: Why::Text(message.into()) }
    }
}

impl From<EngineError> for Failure {
    fn from(error: EngineError) -> Self {
        let status = match &error {
            EngineError::UnknownId { .. } => pong_status::UnknownId,
            EngineError::UnknownName { .. } => pong_status::UnknownName,
            EngineError::Duplicate { .. } => pong_status::Duplicate,
            EngineError::WrongPhase { .. } => pong_status::WrongPhase,
            EngineError::Seal { .. } => pong_status::SealFailed,
            EngineError::BadState { .. } => pong_status::BadState,
            EngineError::NotFinite { .. } => pong_status::BadState,
            EngineError::UnsetState { .. } => pong_status::UnsetState,
            EngineError::BadValue { .. } => pong_status::BadValue,
            EngineError::State(_) => pong_status::BadStateBlock,
            EngineError::Workers { .. } => pong_status::SealFailed,
            EngineError::OutOfMemory { .. } => pong_status::OutOfMemory,
        };
        match error {
            EngineError::OutOfMemory { .. } => Self { status, why: Why::Error(error) },
            _ => Self::new(status, error.to_string()),
        }
    }
}

impl From<SlowError> for Failure {
    fn from(error: SlowError) -> Self {
        let status = match error {
            SlowError::Engine(error) => return error.into(),
            SlowError::BadSetting { .. } | SlowError::BadInput { .. } => pong_status::BadValue,
            SlowError::WrongPhase { .. } => pong_status::WrongPhase,
            SlowError::BadState { .. } => pong_status::BadStateBlock,
        };
        Self::new(status, error.to_string())
    }
}

impl From<OutOfMemory> for Failure {
    fn from(refused: OutOfMemory) -> Self {
        EngineError::from(refused).into()
    }
}

impl From<ModelErrors> for Failure {
    fn from(errors: ModelErrors) -> Self {
        Self::new(pong_status::ModelError, errors.to_string())
    }
}
