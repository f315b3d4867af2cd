//! The exceptions of the module. Each carries the message of the library: thing, cause, cure.

use pong_engine::EngineError as Refused;
use pong_executive::ExecutiveError;
use pong_executive::scene::SceneErrors;
use pong_model::ModelErrors;
use pong_record::LogError as RecordError;
use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::sync::{Mutex, MutexGuard, TryLockError};

create_exception!(pong, PongError, PyException, "Base of all errors of Pong.");
create_exception!(
    pong,
    ModelError,
    PongError,
    "A model file is at fault.\n\nAttributes\n----------\nerrors : list[dict[str, Any]]\n    Every fault, with `file`, `line`, `column`, `path`, `rule`, `cause` and `cure`."
);
create_exception!(
    pong,
    SceneError,
    PongError,
    "A scene is at fault.\n\nAttributes\n----------\nerrors : list[dict[str, Any]]\n    Every fault, with `file`, `line`, `column`, `thing`, `cause` and `cure`."
);
create_exception!(
    pong,
    EngineError,
    PongError,
    "The engine refused a call; the world is as it was before it."
);
create_exception!(pong, NotFoundError, EngineError, "A name that nothing has, or an id of another world.");
create_exception!(pong, DuplicateError, EngineError, "A name or a pair that is there already.");
create_exception!(pong, PhaseError, EngineError, "A call at a time at which it is not allowed.");
create_exception!(
    pong,
    SealError,
    EngineError,
    "A world cannot be sealed.\n\nAttributes\n----------\nproblems : list[str]\n    Every reason."
);
create_exception!(pong, StateError, EngineError, "A state that is refused, or was never set.");
create_exception!(pong, NotFiniteError, EngineError, "Forces or energies beyond what a number holds.");
create_exception!(pong, BadValueError, EngineError, "A value that a setting or an argument cannot have.");
create_exception!(pong, ResourceError, EngineError, "The system has no memory or no threads left.");
create_exception!(pong, ContactStateError, EngineError, "A saved contact state that does not fit the world.");
create_exception!(pong, RunError, PongError, "A run of a scene that cannot go on.");
create_exception!(pong, LogError, PongError, "A response log that cannot be read or written.");
create_exception!(pong, StudyError, PongError, "A study of a run that cannot be made.");

/// Adds the exceptions to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("EngineError", py.get_type::<EngineError>())?;
    module.add("PongError", py.get_type::<PongError>())?;
    module.add("ModelError", py.get_type::<ModelError>())?;
    module.add("SceneError", py.get_type::<SceneError>())?;
    module.add("NotFoundError", py.get_type::<NotFoundError>())?;
    module.add("DuplicateError", py.get_type::<DuplicateError>())?;
    module.add("PhaseError", py.get_type::<PhaseError>())?;
    module.add("SealError", py.get_type::<SealError>())?;
    module.add("StateError", py.get_type::<StateError>())?;
    module.add("NotFiniteError", py.get_type::<NotFiniteError>())?;
    module.add("BadValueError", py.get_type::<BadValueError>())?;
    module.add("ResourceError", py.get_type::<ResourceError>())?;
    module.add("ContactStateError", py.get_type::<ContactStateError>())?;
    module.add("RunError", py.get_type::<RunError>())?;
    module.add("LogError", py.get_type::<LogError>())?;
    module.add("StudyError", py.get_type::<StudyError>())
}

/// The exception of an error of the engine.
pub(crate) fn of_engine(error: Refused) -> PyErr {
    let text = error.to_string();
    match error {
        Refused::UnknownId { .. } | Refused::UnknownName { .. } => NotFoundError::new_err(text),
        Refused::Duplicate { .. } => DuplicateError::new_err(text),
        Refused::WrongPhase { .. } => PhaseError::new_err(text),
        Refused::Seal { problems } => {
            let raised = SealError::new_err(text);
            // If the attribute cannot be set, the message says the same.
            let _ = Python::attach(|py| raised.value(py).setattr("problems", problems));
            raised
        }
        Refused::BadState { .. } | Refused::UnsetState { .. } => StateError::new_err(text),
        Refused::NotFinite { .. } => NotFiniteError::new_err(text),
        Refused::BadValue { .. } => BadValueError::new_err(text),
        Refused::OutOfMemory { .. } | Refused::Workers { .. } => ResourceError::new_err(text),
        Refused::State(_) => ContactStateError::new_err(text),
    }
}

/// The exception of an error of the executive.
pub(crate) fn of_executive(error: ExecutiveError) -> PyErr {
    match error {
        ExecutiveError::Engine(error) => of_engine(error),
        other => RunError::new_err(other.to_string()),
    }
}

/// The exception of an error of a log.
pub(crate) fn of_log(error: RecordError) -> PyErr {
    match error {
        RecordError::Engine(error) => of_engine(error),
        other => LogError::new_err(other.to_string()),
    }
}

/// The exception of the faults of a model.
pub(crate) fn of_model(errors: ModelErrors) -> PyErr {
    with_list(ModelError::new_err(errors.to_string()), &errors.0, |error, entry| {
        entry.set_item("file", &error.file)?;
        entry.set_item("line", error.line)?;
        entry.set_item("column", error.column)?;
        entry.set_item("path", &error.path)?;
        entry.set_item("rule", error.rule)?;
        entry.set_item("cause", &error.cause)?;
        entry.set_item("cure", &error.cure)
    })
}

/// The exception of the faults of a scene.
pub(crate) fn of_scene(errors: SceneErrors) -> PyErr {
    with_list(SceneError::new_err(errors.to_string()), &errors.0, |error, entry| {
        entry.set_item("file", &error.file)?;
        entry.set_item("line", error.at.map(|(line, _)| line))?;
        entry.set_item("column", error.at.map(|(_, column)| column))?;
        entry.set_item("thing", &error.thing)?;
        entry.set_item("cause", &error.cause)?;
        entry.set_item("cure", &error.cure)
    })
}

/// Adds the attribute `errors`, a dictionary for each fault; leaves it out if that fails, since the message
/// says the same.
fn with_list<T>(raised: PyErr, errors: &[T], fill: impl Fn(&T, &Bound<'_, PyDict>) -> PyResult<()>) -> PyErr {
    let _ = Python::attach(|py| -> PyResult<()> {
        let list = PyList::empty(py);
        for error in errors {
            let entry = PyDict::new(py);
            fill(error, &entry)?;
            list.append(entry)?;
        }
        raised.value(py).setattr("errors", list)
    });
    raised
}

/// Error for an invalid argument, in the form of all messages.
pub(crate) fn bad_value(thing: &str, cause: impl std::fmt::Display, cure: &str) -> PyErr {
    BadValueError::new_err(format!("{thing}: {cause}; {cure}"))
}

/// Locks for the call of one thread; `cure` is for a concurrent call by another.
pub(crate) fn lock<'a, T>(thing: &str, guarded: &'a Mutex<T>, cure: &str) -> PyResult<MutexGuard<'a, T>> {
    match guarded.try_lock() {
        Ok(inner) => Ok(inner),
        // A call that panicked leaves its data usable.
        Err(TryLockError::Poisoned(inner)) => Ok(inner.into_inner()),
        Err(TryLockError::WouldBlock) => {
            Err(PhaseError::new_err(format!("{thing}: another thread is in a call of it; {cure}")))
        }
    }
}

/// Refuses a number outside of a range.
pub(crate) fn in_range<T: PartialOrd + std::fmt::Display>(
    argument: &str,
    value: T,
    range: std::ops::Range<T>,
    cure: &str,
) -> PyResult<()> {
    if range.contains(&value) { Ok(()) } else { Err(bad_value(argument, format!("it is {value}"), cure)) }
}
