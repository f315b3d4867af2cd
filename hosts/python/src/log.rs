//! What of a log is checked before NumPy maps its tables (python/pong/_log.py).

use crate::errors::of_log;
use pyo3::prelude::*;
use std::path::PathBuf;

/// Checks a log's run.json and tables. Answers whether the log is whole, and how many whole frames it has.
#[pyfunction]
pub(crate) fn check_log(py: Python<'_>, folder: PathBuf) -> PyResult<(bool, u64)> {
    let log = py.detach(|| pong_record::Log::open(&folder)).map_err(of_log)?;
    Ok((log.is_whole(), log.frame_count()))
}
