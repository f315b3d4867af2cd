//! States and wrenches as NumPy arrays, read and written in place.

use crate::errors::bad_value;
use numpy::ndarray::{ArrayView2, ArrayViewMut2};
use numpy::{
    AllowTypeChange, PyArray2, PyArrayLike2, PyArrayMethods, PyReadwriteArray2, PyUntypedArrayMethods,
};
use pong_engine::{InterfaceId, State};
use pong_geometry::{Pose, Twist, Wrench};
use pyo3::prelude::*;

/// Numbers of a state: position, quaternion (w, x, y, z), velocity, angular velocity.
pub(crate) const STATE: usize = 13;
/// Numbers of a wrench: force, moment.
pub(crate) const WRENCH: usize = 6;

/// An argument of numbers: an array of float64 is read where it lies, anything else is converted by NumPy.
pub(crate) type Rows<'py> = PyArrayLike2<'py, f64, AllowTypeChange>;

/// An array of rows, of the caller or given to it.
pub(crate) type Matrix<'py> = Bound<'py, PyArray2<f64>>;

/// Checks the shape of an argument: `rows` × `columns`.
pub(crate) fn rows<'a>(
    thing: &str,
    array: &'a Rows<'_>,
    rows: usize,
    columns: usize,
) -> PyResult<ArrayView2<'a, f64>> {
    check_shape(thing, array.shape(), [rows, columns])?;
    Ok(array.as_array())
}

fn check_shape(thing: &str, shape: &[usize], [rows, columns]: [usize; 2]) -> PyResult<()> {
    if shape == [rows, columns] {
        return Ok(());
    }
    let cause = format!("the array has shape ({}, {})", shape[0], shape[1]);
    Err(bad_value(thing, cause, &format!("give one of shape ({rows}, {columns})")))
}

/// States given as rows of 13 numbers, appended to `out`.
pub(crate) fn states(view: &ArrayView2<'_, f64>, ids: &[InterfaceId], out: &mut Vec<(InterfaceId, State)>) {
    for (row, id) in view.rows().into_iter().zip(ids) {
        let part = |from: usize| std::array::from_fn(|i| row[from + i]);
        let state = State {
            position: part(0),
            orientation: std::array::from_fn(|i| row[3 + i]),
            linear_velocity: part(7),
            angular_velocity: part(10),
        };
        out.push((*id, state));
    }
}

/// One of the four parts of states that are given apart.
pub(crate) fn part<const N: usize>(
    thing: &str,
    given: Option<&Rows<'_>>,
    count: usize,
    default: [f64; N],
) -> PyResult<Vec<[f64; N]>> {
    let Some(array) = given else { return Ok(vec![default; count]) };
    let view = rows(thing, array, count, N)?;
    Ok(view.rows().into_iter().map(|row| std::array::from_fn(|i| row[i])).collect())
}

/// The 13 numbers of a motion.
pub(crate) fn motion_row(pose: &Pose, twist: &Twist) -> [f64; STATE] {
    let (p, q, v, w) = (&pose.position, &pose.orientation, &twist.linear, &twist.angular);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, w.x, w.y, w.z]
}

/// The six numbers of a wrench.
pub(crate) fn wrench_row(wrench: &Wrench) -> [f64; WRENCH] {
    let (f, m) = (&wrench.force, &wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

/// Fills an array of the caller, or a new one, row by row.
pub(crate) fn fill<'py, const N: usize>(
    py: Python<'py>,
    out: Option<Matrix<'py>>,
    count: usize,
    row: impl Fn(usize) -> PyResult<[f64; N]>,
) -> PyResult<Matrix<'py>> {
    let array = match out {
        Some(array) => {
            check_shape("out", array.shape(), [count, N])?;
            array
        }
        None => PyArray2::zeros(py, [count, N], false),
    };
    let mut lent: PyReadwriteArray2<'_, f64> = array.try_readwrite().map_err(|reason| {
        bad_value("out", reason, "give an array that can be written and that no other call reads")
    })?;
    let mut view: ArrayViewMut2<'_, f64> = lent.as_array_mut();
    for (index, mut place) in view.rows_mut().into_iter().enumerate() {
        row(index)?.iter().zip(place.iter_mut()).for_each(|(number, place)| *place = *number);
    }
    drop(lent);
    Ok(array)
}
