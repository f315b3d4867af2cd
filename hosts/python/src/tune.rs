//! Search for the fastest bounding volumes and leaves, with the same bits (docs/tune.md).

use crate::arrays::refused;
use crate::errors::{StudyError, in_range};
use crate::model::extensions;
use crate::replay::Interrupt;
use pong_study::tree_tuning::{self, Output, Settings, report};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Result of a tuning.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct Tuned {
    /// str : Page that `pong tune` prints, in Markdown.
    page: String,
    /// dict[str, Path] : Written model files by model name; empty if nothing is faster by more than noise.
    written: BTreeMap<String, PathBuf>,
    /// dict[str, list[str]] : Changes in each written model, group by group.
    changes: BTreeMap<String, Vec<String>>,
    /// float : Relative reduction of the time.
    gain: f64,
    /// float : Relative difference of repeated timings.
    noise: f64,
    /// list of str : Proposals discarded because they would have changed an answer, or could not be built.
    refused: Vec<String>,
}

#[pymethods]
impl Tuned {
    fn __repr__(&self) -> String {
        format!("<pong.Tuned: {} models written>", self.written.len())
    }
}

/// One run, or several.
#[derive(FromPyObject)]
pub(crate) enum Runs {
    One(PathBuf),
    Several(Vec<PathBuf>),
    Other(Py<PyAny>),
}

/// Searches for bounding volumes and leaves that reduce the frame time of runs with the same bits, and writes new model
/// files (docs/tune.md).
///
/// Parameters
/// ----------
/// runs : path_like or sequence of path_like
///     Scene files or folders of logs.
/// output : path_like, optional
///     Folder for the model files.
/// force : bool, default False
///     Replaces files that are in the folder already.
/// duration : float, optional
///     Duration of a run, s.
/// rounds : int, default 5
///     Number of timings of each proposal.
/// frames : int, default 4096
///     Most frames of a timing.
/// allow_files_below : sequence of path_like, optional
///     Further folders from which models may read meshes.
///
/// Returns
/// -------
/// Tuned
///
/// Raises
/// ------
/// StudyError
///     A run or a setting cannot be used.
#[pyfunction]
#[pyo3(signature = (
    runs, *, output = None, force = false, duration = None, rounds = 5, frames = 4096, allow_files_below = Vec::new(),
))]
#[expect(clippy::too_many_arguments, reason = "they are named in Python")]
pub(crate) fn tune(
    py: Python<'_>,
    runs: Runs,
    output: Option<PathBuf>,
    force: bool,
    duration: Option<f64>,
    rounds: u32,
    frames: u64,
    allow_files_below: Vec<PathBuf>,
) -> PyResult<Tuned> {
    in_range("rounds", rounds, 2..1001, "give a number from 2 to 1000")?;
    in_range("frames", frames, 16..1_000_001, "give a number from 16 to 1,000,000")?;
    let settings = Settings {
        rounds,
        frames,
        duration_s: duration,
        output: Output { folder: output, force },
        extensions: extensions(allow_files_below),
    };
    let runs = match runs {
        Runs::One(run) => vec![run],
        Runs::Several(runs) => runs,
        Runs::Other(given) => {
            return Err(refused(
                "runs",
                given.bind(py),
                "give the path of a scene or log, or a list of them",
            ));
        }
    };
    let runs: Vec<&Path> = runs.iter().map(PathBuf::as_path).collect();
    let mut interrupt = Interrupt::default();
    let tuned = py.detach(|| tree_tuning::tune(&runs, &settings, &mut |_| interrupt.flow()));
    let tuned = interrupt.or(tuned.map_err(|error| StudyError::new_err(error.0)))?;
    let written = tuned.models.iter().filter_map(|model| Some((model.name.clone(), model.written.clone()?)));
    let changed = tuned.models.iter().filter(|model| model.written.is_some());
    Ok(Tuned {
        page: report::page(&tuned),
        written: written.collect(),
        changes: changed.map(|model| (model.name.clone(), model.changes.clone())).collect(),
        gain: tuned.gain,
        noise: tuned.noise,
        refused: tuned.refused,
    })
}
