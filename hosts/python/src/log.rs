//! Check of a log before NumPy maps its tables (python/pong/_log.py).

use crate::errors::of_log;
use pyo3::prelude::*;
use std::path::PathBuf;

/// Checks a log's run.json and tables.
///
/// Parameters
/// ----------
/// folder : path_like
///     Folder of the log.
///
/// Returns
/// -------
/// tuple[bool, int]
///     True if the log is complete, and its number of complete frames.
#[pyfunction]
pub(crate) fn check_log(py: Python<'_>, folder: PathBuf) -> PyResult<(bool, u64)> {
    let log = py.detach(|| pong_record::Log::open(&folder)).map_err(of_log)?;
    Ok((log.is_whole(), log.frame_count()))
}
