//! Errors, each with thing, cause and cure.

use crate::state::StateError;
use pong_arena::OutOfMemory;
use pong_model::printable;

/// An error of the engine. The world is as it was before the call.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EngineError {
    /// An id that this world did not give out, or that names nothing.
    #[error("{what}: the id is zero, stale or of another world; use an id that this world returned")]
    UnknownId {
        /// Kind of thing that the id should name.
        what: &'static str,
    },
    /// A name that does not exist.
    #[error("{what} `{}`: there is none; known: {}", printable(.name), names(.known))]
    UnknownName {
        /// Kind of thing that was looked up.
        what: &'static str,
        /// The name.
        name: String,
        /// Existing names.
        known: Vec<String>,
    },
    /// A name or a pair that exists already.
    #[error("{}: already there; use another name or leave it out", printable(.what))]
    Duplicate {
        /// The duplicate.
        what: String,
    },
    /// A call that comes too early, such as one for a wrench before the first frame.
    #[error("{call}: not allowed now; {cure}")]
    WrongPhase {
        /// The call.
        call: &'static str,
        /// Call that is needed first.
        cure: &'static str,
    },
    /// The scene cannot be sealed; all reasons are listed.
    #[error("the scene cannot be sealed:{}", lines_below(.problems))]
    Seal {
        /// One line each: thing, cause, cure.
        problems: Vec<String>,
    },
    /// A state that is not finite, or whose quaternion is not near unit length.
    #[error("state of `{}`: {cause}; the state set before stays in force", printable(.interface))]
    BadState {
        /// `object/path` of the interface.
        interface: String,
        /// Fault of the state.
        cause: String,
    },
    /// A paired movable group has no state yet.
    #[error(
        "state of `{}`: never set; set the states of all paired movable groups before a frame",
        printable(.interface)
    )]
    UnsetState {
        /// `object/path` of the interface.
        interface: String,
    },
    /// Forces, moments or energies overflow, because states, surface values or a host's law are too large.
    /// There is no valid frame until one can be computed.
    #[error(
        "frame: the contacts of `{}` give forces, moments or energies beyond what a number holds; set smaller states \
         or surface values, or mend the law, and evaluate again",
        printable(.interface)
    )]
    NotFinite {
        /// `object/path` of an interface whose contacts overflow.
        interface: String,
    },
    /// A value that a surface or a setting cannot have.
    #[error("{}: {}", printable(.what), printable(.cause))]
    BadValue {
        /// The thing.
        what: String,
        /// Fault, and a valid value.
        cause: String,
    },
    /// The system does not have the memory that set-up needs. Nothing was allocated.
    #[error("{what}: the system does not give {bytes} bytes of memory; {cure}")]
    OutOfMemory {
        /// Purpose of the memory.
        what: &'static str,
        /// Size of the request, bytes.
        bytes: usize,
        /// Suggested remedy.
        cure: &'static str,
    },
    /// The workers could not be started.
    #[error("workers: {cause}")]
    Workers {
        /// Reply of the system, and a remedy.
        cause: String,
    },
    /// A saved contact state was refused.
    #[error(transparent)]
    State(#[from] StateError),
}

impl From<OutOfMemory> for EngineError {
    fn from(OutOfMemory { what, bytes, cure }: OutOfMemory) -> Self {
        Self::OutOfMemory { what, bytes, cure }
    }
}

fn names(known: &[String]) -> String {
    known.iter().map(|name| printable(name)).collect::<Vec<_>>().join(", ")
}

fn lines_below(problems: &[String]) -> String {
    problems.iter().map(|problem| format!("\n  {}", printable(problem))).collect()
}
