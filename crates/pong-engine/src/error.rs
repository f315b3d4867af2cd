//! What can go wrong, told as thing, cause and cure.

use crate::state::StateError;
use pong_model::printable;

/// An error of the engine. The world is as it was before the call.
#[derive(Clone, Debug, PartialEq)]
pub enum EngineError {
    /// An id that this world did not give out, or that names nothing.
    UnknownId {
        /// What the id should have named.
        what: &'static str,
    },
    /// A name that nothing has.
    UnknownName {
        /// What was looked for.
        what: &'static str,
        /// The name.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// A name or a pair that is already there.
    Duplicate {
        /// What is there twice.
        what: String,
    },
    /// A call that comes too early, as one for a wrench before the first frame.
    WrongPhase {
        /// The call.
        call: &'static str,
        /// What to do first.
        cure: &'static str,
    },
    /// The scene cannot be sealed; every reason is listed.
    Seal {
        /// One line each: thing, cause, cure.
        problems: Vec<String>,
    },
    /// A state that is not finite or whose quaternion is not near unit length.
    BadState {
        /// `object/path` of the interface.
        interface: String,
        /// What is wrong with it.
        cause: String,
    },
    /// A paired movable group has no state yet.
    UnsetState {
        /// `object/path` of the interface.
        interface: String,
    },
    /// States, surfaces or laws of the host are so large that forces, moments or energies are beyond what a number holds.
    /// There is no frame until one can be computed.
    NotFinite {
        /// `object/path` of an interface whose contacts show it.
        interface: String,
    },
    /// A value that a surface or a setting cannot have.
    BadValue {
        /// The thing.
        what: String,
        /// What is wrong and what to give instead.
        cause: String,
    },
    /// The system has not the memory that set-up would take. Nothing was taken.
    OutOfMemory {
        /// For what.
        what: &'static str,
        /// How much was asked for, bytes.
        bytes: usize,
        /// What to do.
        cure: &'static str,
    },
    /// The workers could not be started.
    Workers {
        /// What the system said and what to do.
        cause: String,
    },
    /// A saved contact state was refused.
    State(StateError),
}

impl std::fmt::Display for EngineError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::UnknownId { what } => write!(
                f,
                "{what}: the id is zero, stale or of another world; use an id that this world returned"
            ),
            Self::UnknownName { what, name, known } => {
                let known: Vec<_> = known.iter().map(|name| printable(name)).collect();
                write!(f, "{what} `{}`: there is none; known: {}", printable(name), known.join(", "))
            }
            Self::Duplicate { what } => {
                write!(f, "{}: already there; use another name or leave it out", printable(what))
            }
            Self::WrongPhase { call, cure } => write!(f, "{call}: not allowed now; {cure}"),
            Self::Seal { problems } => {
                write!(f, "the scene cannot be sealed:")?;
                problems.iter().try_for_each(|problem| write!(f, "\n  {}", printable(problem)))
            }
            Self::BadState { interface, cause } => {
                write!(f, "state of `{}`: {cause}; the state set before stays in force", printable(interface))
            }
            Self::UnsetState { interface } => {
                write!(
                    f,
                    "state of `{}`: never set; set the states of all paired movable groups before a frame",
                    printable(interface)
                )
            }
            Self::NotFinite { interface } => {
                write!(
                    f,
                    "frame: the contacts of `{}` give forces, moments or energies beyond what a number holds; set smaller states \
                     or surface values, or mend the law, and evaluate again",
                    printable(interface)
                )
            }
            Self::BadValue { what, cause } => write!(f, "{}: {}", printable(what), printable(cause)),
            Self::OutOfMemory { what, bytes, cure } => {
                write!(f, "{what}: the system does not give {bytes} bytes of memory; {cure}")
            }
            Self::Workers { cause } => write!(f, "workers: {cause}"),
            Self::State(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for EngineError {}

impl From<StateError> for EngineError {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}
