//! Response logs of a world whose frames a Python program computes.

use crate::errors::{LogError, PhaseError, of_log};
use crate::sealed::Inner;
use pong_engine::World;
use pong_record::{RecordOptions, Recorder};
use pyo3::prelude::*;
use std::path::PathBuf;

/// Begins a log of a world in a folder.
pub(crate) fn start(inner: &mut Inner, folder: PathBuf, options: RecordOptions) -> PyResult<()> {
    if inner.recorder.is_some() {
        return Err(PhaseError::new_err("log: one is open already; call stop_log first"));
    }
    let writer = concat!("pong for Python ", env!("CARGO_PKG_VERSION")).to_owned();
    let options = RecordOptions { writer, ..options };
    inner.recorder = Some(Recorder::start(&inner.world, &folder, &inner.sources, &options).map_err(of_log)?);
    Ok(())
}

pub(crate) fn record(py: Python<'_>, recorder: &mut Recorder, world: &mut World, time: f64) -> PyResult<()> {
    // A world may move to another thread but not be shared by two: the closure has exclusive access.
    let record = move || {
        let world: &mut World = world;
        recorder.record(world, time, 0, None)
    };
    py.detach(record).map_err(of_log)
}

/// Closes the files and returns their number of frames.
pub(crate) fn finish(py: Python<'_>, recorder: Recorder) -> PyResult<u64> {
    let status = py.detach(|| recorder.finish()).map_err(of_log)?;
    match status.error {
        None => Ok(status.frames),
        Some(text) => Err(LogError::new_err(text)),
    }
}

/// Records preloaded friction, like a restored contact state.
pub(crate) fn preloaded(recorder: &mut Recorder, world: &World) {
    let mut block = Vec::new();
    world.save_state_packed(&mut block);
    recorder.restored(&block);
}

/// Error for a call without a log.
pub(crate) fn none() -> PyErr {
    PhaseError::new_err("log: none is open; call start_log first")
}

/// Error for a world that is to go on where another one is while its log is running.
pub(crate) fn is_running() -> PyErr {
    PhaseError::new_err(
        "continue from another world: a log of this one is running, and the run of the other is not in it; stop it \
         with stop_log() first, and begin another one afterwards",
    )
}
