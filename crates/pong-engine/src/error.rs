//! What can go wrong, told as thing, cause and cure.

use crate::state::StateError;
use pong_model::printable;

/// An error of the engine. The world is as it was before the call.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EngineError {
    /// An id that this world did not give out, or that names nothing.
    #[error("{what}: the id is zero, stale or of another world; use an id that this world returned")]
    UnknownId {
        /// What the id should have named.
        what: &'static str,
    },
    /// A name that nothing has.
    #[error("{what} `{}`: there is none; known: {}", printable(.name), names(.known))]
    UnknownName {
        /// What was looked for.
        what: &'static str,
        /// The name.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// A name or a pair that is already there.
    #[error("{}: already there; use another name or leave it out", printable(.what))]
    Duplicate {
        /// What is there twice.
        what: String,
    },
    /// A call that comes too early, as one for a wrench before the first frame.
    #[error("{call}: not allowed now; {cure}")]
    WrongPhase {
        /// The call.
        call: &'static str,
        /// What to do first.
        cure: &'static str,
    },
    /// The scene cannot be sealed; every reason is listed.
    #[error("the scene cannot be sealed:{}", lines_below(.problems))]
    Seal {
        /// One line each: thing, cause, cure.
        problems: Vec<String>,
    },
    /// A state that is not finite or whose quaternion is not near unit length.
    #[error("state of `{}`: {cause}; the state set before stays in force", printable(.interface))]
    BadState {
        /// `object/path` of the interface.
        interface: String,
        /// What is wrong with it.
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
    /// States, surfaces or laws of the host are so large that forces, moments or energies are beyond what a number holds.
    /// There is no frame until one can be computed.
    #[error(
        "frame: the contacts of `{}` give forces, moments or energies beyond what a number holds; set smaller states \
         or surface values, or mend the law, and evaluate again",
        printable(.interface)
    )]
    NotFinite {
        /// `object/path` of an interface whose contacts show it.
        interface: String,
    },
    /// A value that a surface or a setting cannot have.
    #[error("{}: {}", printable(.what), printable(.cause))]
    BadValue {
        /// The thing.
        what: String,
        /// What is wrong and what to give instead.
        cause: String,
    },
    /// The system has not the memory that set-up would take. Nothing was taken.
    #[error("{what}: the system does not give {bytes} bytes of memory; {cure}")]
    OutOfMemory {
        /// For what.
        what: &'static str,
        /// How much was asked for, bytes.
        bytes: usize,
        /// What to do.
        cure: &'static str,
    },
    /// The workers could not be started.
    #[error("workers: {cause}")]
    Workers {
        /// What the system said and what to do.
        cause: String,
    },
    /// A saved contact state was refused.
    #[error(transparent)]
    State(#[from] StateError),
}

fn names(known: &[String]) -> String {
    known.iter().map(|name| printable(name)).collect::<Vec<_>>().join(", ")
}

fn lines_below(problems: &[String]) -> String {
    problems.iter().map(|problem| format!("\n  {}", printable(problem))).collect()
}
