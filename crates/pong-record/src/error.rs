//! Errors of writing and reading logs.

use crate::format::VERSION;
use std::io;
use std::path::{Path, PathBuf};

/// Cause why a log cannot be written or read. The text names the file, the cause and the cure.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// A file or folder cannot be read.
    #[error("{path}: cannot be read: {reason}; name the folder of a response log")]
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// The system's message.
        reason: String,
    },
    /// A file or folder cannot be written.
    #[error("{path}: cannot be written: {reason}; name a folder with room")]
    Unwritable {
        /// Its path.
        path: PathBuf,
        /// The system's message.
        reason: String,
    },
    /// The contents of a file are not valid.
    #[error("{path}: is damaged: {cause}; use another copy of the log")]
    Damaged {
        /// Its path.
        path: PathBuf,
        /// The fault.
        cause: String,
    },
    /// The folder holds another log.
    #[error("{path}: holds a log already (`{found}`); name another folder, or ask to have it overwritten")]
    Occupied {
        /// The folder.
        path: PathBuf,
        /// The kind of log found in it.
        found: String,
    },
    /// The log is of a version of the format that this program does not read.
    #[error(
        "{path}: is of version {version}, this program reads versions 1 to {VERSION}; use the program that wrote it, or \
         a later one"
    )]
    Version {
        /// Its run.json.
        path: PathBuf,
        /// The version.
        version: u64,
    },
    /// A model cannot be kept with the log.
    #[error("model `{name}`: cannot be kept with the log: {cause}; {cure}")]
    Model {
        /// Its name.
        name: String,
        /// The cause.
        cause: String,
        /// The remedy.
        cure: String,
    },
    /// The files could not be written to the end.
    #[error("{text}")]
    Ended {
        /// Cause, and the end of the log.
        text: String,
    },
    /// A call at the wrong time, or with an invalid value.
    #[error("log: {cause}; {cure}")]
    Refused {
        /// The call and the cause.
        cause: String,
        /// The remedy.
        cure: String,
    },
    /// The engine refused something.
    #[error(transparent)]
    Engine(#[from] pong_engine::EngineError),
}

impl LogError {
    pub(crate) fn unreadable(path: &Path, reason: &io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), reason: reason.to_string() }
    }

    /// Error of a file that cannot be written, with the system's message.
    pub fn unwritable(path: &Path, reason: &io::Error) -> Self {
        Self::Unwritable { path: path.to_owned(), reason: reason.to_string() }
    }

    pub(crate) fn damaged(path: &Path, cause: impl Into<String>) -> Self {
        Self::Damaged { path: path.to_owned(), cause: cause.into() }
    }

    pub(crate) fn refused(cause: impl Into<String>, cure: impl Into<String>) -> Self {
        Self::Refused { cause: cause.into(), cure: cure.into() }
    }
}

impl From<pong_engine::SealError> for LogError {
    fn from(error: pong_engine::SealError) -> Self {
        Self::Engine(error.into())
    }
}
