//! Replay of logs through the engine (docs/response_logs.md, Replay).

use crate::errors::{in_range, of_log};
use crate::model::extensions;
use crate::setup::worker_settings;
use pong_record::{Log, ReplayOptions};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Result of a replay.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct Replay {
    /// bool : True if every frame of the log was compared and none differs.
    agrees: bool,
    /// int : Frames of the log.
    frames: u64,
    /// int : Frames compared, including the one that differs.
    compared: u64,
    /// int : Contacts of these frames.
    contacts: u64,
    /// list of str : Differences in the first frame that differs.
    differences: Vec<String>,
    /// str or None : Reason why the log cannot be replayed exactly from some frame on; None if it can.
    obstacle: Option<String>,
}

#[pymethods]
impl Replay {
    fn __repr__(&self) -> String {
        let found = if self.agrees { "agrees" } else { "DIFFERS" };
        format!("<pong.Replay of {} of {} frames: {found}>", self.compared, self.frames)
    }
}

/// Polls for an interruption of the caller's program by Ctrl-C; keeps its exception.
#[derive(Default)]
pub(crate) struct Interrupt {
    asked: Option<Instant>,
    raised: Option<PyErr>,
}

impl Interrupt {
    /// Polling interval of a long run: taking the GIL costs more than a frame.
    const ASK_EVERY: Duration = Duration::from_millis(100);

    /// `Break` after an interruption.
    pub fn flow(&mut self) -> ControlFlow<()> {
        if self.asked.is_none_or(|asked| asked.elapsed() > Self::ASK_EVERY) {
            self.raised = Python::attach(|py| py.check_signals()).err();
            self.asked = Some(Instant::now());
        }
        if self.raised.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The exception of the interruption, if any, else `found`.
    pub fn or<T>(self, found: PyResult<T>) -> PyResult<T> {
        self.raised.map_or(found, Err)
    }
}

/// Replays the states of a log through the engine, and compares the results.
///
/// Parameters
/// ----------
/// log : path_like
///     Folder of the log.
/// tolerance : float, optional
///     Relative difference that is allowed; without it, bits are compared.
/// workers : int, default 0
///     Threads that help the calling thread.
/// allow_files_below : sequence of path_like, optional
///     Further folders from which models may read meshes.
///
/// Returns
/// -------
/// Replay
///
/// Raises
/// ------
/// LogError
///     The log cannot be read.
#[pyfunction]
#[pyo3(signature = (log, *, tolerance = None, workers = 0, allow_files_below = Vec::new()))]
pub(crate) fn replay(
    py: Python<'_>,
    log: PathBuf,
    tolerance: Option<f64>,
    workers: i64,
    allow_files_below: Vec<PathBuf>,
) -> PyResult<Replay> {
    if let Some(tolerance) = tolerance {
        in_range("tolerance", tolerance, 0.0..1.0, "give a number from 0 up to 1, such as 1e-9")?;
    }
    let (workers, extensions) = (worker_settings(workers)?, extensions(allow_files_below));
    let mut interrupt = Interrupt::default();
    let report = py.detach(|| {
        let options = ReplayOptions { workers, tolerance, extensions, ..ReplayOptions::default() };
        let mut log = Log::open(&log)?;
        pong_record::replay(&mut log, &options, &mut |_| interrupt.flow())
    });
    let report = interrupt.or(report.map_err(of_log))?;
    let obstacle = report.obstacle.as_ref();
    Ok(Replay {
        agrees: report.agrees(),
        frames: report.frames,
        compared: report.compared,
        contacts: report.contacts,
        differences: report.differences.iter().map(ToString::to_string).collect(),
        obstacle: obstacle
            .map(|obstacle| format!("not exact from frame {} on: {obstacle}", obstacle.frame())),
    })
}
