//! What can be wrong with a log.

use crate::format::VERSION;
use std::io;
use std::path::{Path, PathBuf};

/// Why a log cannot be written or read. The text names the file, the cause and the cure.
#[derive(Debug)]
#[non_exhaustive]
pub enum LogError {
    /// A file or folder cannot be read.
    Unreadable {
        /// Which.
        path: PathBuf,
        /// The system's words.
        reason: String,
    },
    /// A file or folder cannot be written.
    Unwritable {
        /// Which.
        path: PathBuf,
        /// The system's words.
        reason: String,
    },
    /// A file does not hold what it must.
    Damaged {
        /// Which.
        path: PathBuf,
        /// What is wrong.
        cause: String,
    },
    /// The folder holds another log.
    Occupied {
        /// The folder.
        path: PathBuf,
        /// What was found in it.
        found: String,
    },
    /// The log is of a version of the format that this program does not read.
    Version {
        /// Its run.json.
        path: PathBuf,
        /// The version.
        version: u64,
    },
    /// A model cannot be kept with the log.
    Model {
        /// Its name.
        name: String,
        /// Why.
        cause: String,
        /// What to do.
        cure: String,
    },
    /// The files could not be written to the end.
    Ended {
        /// Why, and how far the log goes.
        text: String,
    },
    /// A call at the wrong time, or with a value that cannot be.
    Refused {
        /// What and why.
        cause: String,
        /// What to do.
        cure: String,
    },
    /// The engine refused something.
    Engine(pong_engine::EngineError),
}

impl LogError {
    pub(crate) fn unreadable(path: &Path, reason: &io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), reason: reason.to_string() }
    }

    /// That a file cannot be written, in the system's words.
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

impl std::fmt::Display for LogError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unreadable { path, reason } => {
                write!(f, "{}: cannot be read: {reason}; name the folder of a response log", path.display())
            }
            Self::Unwritable { path, reason } => {
                write!(f, "{}: cannot be written: {reason}; name a folder with room", path.display())
            }
            Self::Damaged { path, cause } => {
                write!(f, "{}: is damaged: {cause}; use another copy of the log", path.display())
            }
            Self::Occupied { path, found } => write!(
                f,
                "{}: holds a log already (`{found}`); name another folder, or ask to have it overwritten",
                path.display()
            ),
            Self::Version { path, version } => write!(
                f,
                "{}: is of version {version}, this program reads versions 1 to {}; use the program that wrote it, or a later one",
                path.display(),
                VERSION
            ),
            Self::Model { name, cause, cure } => {
                write!(f, "model `{name}`: cannot be kept with the log: {cause}; {cure}")
            }
            Self::Ended { text } => f.write_str(text),
            Self::Refused { cause, cure } => write!(f, "log: {cause}; {cure}"),
            Self::Engine(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for LogError {}

impl From<pong_engine::EngineError> for LogError {
    fn from(error: pong_engine::EngineError) -> Self {
        Self::Engine(error)
    }
}

impl From<pong_engine::SealError> for LogError {
    fn from(error: pong_engine::SealError) -> Self {
        Self::Engine(error.into())
    }
}
