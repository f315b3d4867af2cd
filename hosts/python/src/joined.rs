//! Several model files as one model: python/pong/model.py, `join`.

use crate::errors::{BadValueError, bad_value, of_model};
use crate::model::extensions;
use pong_model::{JoinError, PlacedFile, join_files};
use pyo3::prelude::*;
use std::path::PathBuf;

/// Position x, y, z and quaternion w, x, y, z.
type Place = [f64; 7];

/// Text of one model that joins model files; see `pong.model.join`.
///
/// Parameters
/// ----------
/// parts : list[tuple[str, list[float]]]
///     Path of each file, with the position of its root in m and its quaternion (w, x, y, z): seven numbers.
/// name : str
///     Name of the new model.
/// folder : path_like
///     Folder of the new file.
/// one_surface : bool
///     Declare the new root one surface.
/// allow_files_below : sequence of path_like
///     Further folders from which the models may read meshes.
///
/// Returns
/// -------
/// str
#[pyfunction]
pub(crate) fn join_models(
    py: Python<'_>,
    parts: Vec<(PathBuf, Place)>,
    name: &str,
    folder: PathBuf,
    one_surface: bool,
    allow_files_below: Vec<PathBuf>,
) -> PyResult<String> {
    let files = parts.into_iter().enumerate().map(|(index, (path, place))| placed(index, path, place));
    let files: Vec<PlacedFile> = files.collect::<PyResult<_>>()?;
    let extensions = extensions(allow_files_below);
    let joined = py.detach(|| join_files(name, &files, &folder, one_surface, &extensions));
    joined.map_err(|error| match error {
        JoinError::Model(errors) => of_model(errors),
        JoinError::Cause(cause) => BadValueError::new_err(cause),
    })
}

/// File at its place; refuses numbers that no place has.
fn placed(index: usize, path: PathBuf, place: Place) -> PyResult<PlacedFile> {
    let [x, y, z, q @ ..] = place;
    let norm = q.iter().map(|q| q * q).sum::<f64>().sqrt();
    if !place.iter().all(|number| number.is_finite()) || (norm - 1.0).abs() > 1e-3 {
        let cause = format!("the quaternion has the length {norm}, or a number is not finite");
        let cure = "give a position in m and a quaternion (w, x, y, z) of length 1";
        return Err(bad_value(&format!("parts[{index}]"), cause, cure));
    }
    Ok(PlacedFile { path, pose: pong_geometry::Pose::new([x, y, z].into(), q) })
}
