//! States and wrenches as NumPy arrays, read and written in place.

use crate::errors::bad_value;
use numpy::ndarray::{ArrayView2, ArrayViewMut2};
use numpy::{
    AllowTypeChange, PyArray2, PyArrayLike1, PyArrayLike2, PyArrayMethods, PyReadwriteArray2,
    PyUntypedArrayMethods,
};
use pong_engine::{InterfaceId, State, SurfaceMotion};
use pong_geometry::{Pose, Twist, Wrench};
use pyo3::prelude::*;

/// Numbers of a state: position, quaternion (w, x, y, z), velocity, angular velocity.
pub(crate) const STATE: usize = 13;
/// Numbers of a wrench: force, moment.
pub(crate) const WRENCH: usize = 6;

/// An argument of numbers: an array of float64 is used in place, anything else is converted by NumPy.
pub(crate) type Rows<'py> = PyArrayLike2<'py, f64, AllowTypeChange>;

/// An array of rows, from or for the caller.
pub(crate) type Matrix<'py> = Bound<'py, PyArray2<f64>>;

/// Reads an argument of numbers, `rows` × `columns`.
pub(crate) fn rows<'py>(
    thing: &str,
    given: &Bound<'py, PyAny>,
    rows: usize,
    columns: usize,
) -> PyResult<Rows<'py>> {
    let refused = || refused(thing, given, &format!("give one of shape ({rows}, {columns})"));
    if is_complex(given) {
        return Err(refused());
    }
    let array = given.extract::<Rows<'py>>().map_err(|_| refused())?;
    if array.shape() == [rows, columns] { Ok(array) } else { Err(refused()) }
}

/// Reads a vector of numbers: an array or a sequence of anything that NumPy accepts as numbers.
pub(crate) fn vector<const N: usize>(thing: &str, given: &Bound<'_, PyAny>) -> PyResult<[f64; N]> {
    let refused = || refused(thing, given, &format!("give {N} numbers"));
    if is_complex(given) {
        return Err(refused());
    }
    let array = given.extract::<PyArrayLike1<'_, f64, AllowTypeChange>>().map_err(|_| refused())?;
    let view = array.as_array();
    if view.len() == N { Ok(std::array::from_fn(|index| view[index])) } else { Err(refused()) }
}

/// True for complex numbers, whose imaginary parts NumPy would drop.
fn is_complex(given: &Bound<'_, PyAny>) -> bool {
    let kind = given.getattr("dtype").and_then(|dtype| dtype.getattr("kind")?.extract::<char>());
    kind.is_ok_and(|kind| kind == 'c')
}

/// Error for an argument that is no array of such numbers.
pub(crate) fn refused(thing: &str, given: &Bound<'_, PyAny>, cure: &str) -> PyErr {
    bad_value(thing, format!("got {}", described(given)), cure)
}

/// Text of a given value: type and shape of an array, the beginning of anything else.
pub(crate) fn described(given: &Bound<'_, PyAny>) -> String {
    let attribute = |name: &str| Some(given.getattr(name).ok()?.str().ok()?.to_string());
    if let (Some(dtype), Some(shape)) = (attribute("dtype"), attribute("shape")) {
        return format!("an array of {dtype} with shape {shape}");
    }
    let told = given.repr().map_or_else(|_| "something".to_owned(), |repr| repr.to_string());
    let kind = given.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    let begin: String = told.chars().take(60).collect();
    let dots = if begin.len() < told.len() { "…" } else { "" };
    format!("{begin}{dots}, which is of type {kind}")
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

/// States of a call: rows of 13 numbers, or the four parts separately. They replace `out`.
pub(crate) fn given_states(
    states: Option<Bound<'_, PyAny>>,
    parts: [Option<Bound<'_, PyAny>>; 4],
    ids: &[InterfaceId],
    out: &mut Vec<(InterfaceId, State)>,
) -> PyResult<()> {
    out.clear();
    let cause = match (states, &parts) {
        (Some(array), [None, None, None, None]) => {
            let array = rows("states", &array, ids.len(), STATE)?;
            self::states(&array.as_array(), ids, out);
            return Ok(());
        }
        (None, [Some(_), ..]) => return separate_states(parts, ids, out),
        (Some(_), _) => "an array of states and parts of states are given",
        (None, _) => "neither `states` nor `position` is given",
    };
    Err(bad_value("states", cause, "give one array of 13 columns, or `position` and the others"))
}

/// Motions of surfaces: rows of 18 numbers.
pub(crate) fn surface_motions(
    motions: &Bound<'_, PyAny>,
    ids: &[InterfaceId],
) -> PyResult<Vec<(InterfaceId, SurfaceMotion)>> {
    let array = rows("motions", motions, ids.len(), 18)?;
    let motion = |row: numpy::ndarray::ArrayView1<'_, f64>| {
        let part = |from: usize| std::array::from_fn(|i| row[from + i]);
        SurfaceMotion {
            linear_velocity: part(0),
            angular_velocity: part(3),
            belt_velocity: part(6),
            linear_travel: part(9),
            angular_travel: part(12),
            belt_travel: part(15),
        }
    };
    Ok(ids.iter().zip(array.as_array().rows()).map(|(id, row)| (*id, motion(row))).collect())
}

/// True if `axes` are those of the common frame, false if those of a group.
pub(crate) fn along_common_axes(axes: &str) -> PyResult<bool> {
    match axes {
        "common" => Ok(true),
        "group" => Ok(false),
        other => Err(bad_value("axes", format!("there is no `{other}`"), "give \"common\" or \"group\"")),
    }
}

fn separate_states(
    parts: [Option<Bound<'_, PyAny>>; 4],
    ids: &[InterfaceId],
    out: &mut Vec<(InterfaceId, State)>,
) -> PyResult<()> {
    let count = ids.len();
    let [p, q, v, w] = parts.each_ref().map(Option::as_ref);
    let p = part("position", p, count, [0.0; 3])?;
    let q = part("orientation", q, count, [1.0, 0.0, 0.0, 0.0])?;
    let v = part("linear_velocity", v, count, [0.0; 3])?;
    let w = part("angular_velocity", w, count, [0.0; 3])?;
    let state =
        |i: usize| State { position: p[i], orientation: q[i], linear_velocity: v[i], angular_velocity: w[i] };
    out.extend(ids.iter().enumerate().map(|(i, id)| (*id, state(i))));
    Ok(())
}

/// One of the four parts of states that are given separately.
fn part<const N: usize>(
    thing: &str,
    given: Option<&Bound<'_, PyAny>>,
    count: usize,
    default: [f64; N],
) -> PyResult<Vec<[f64; N]>> {
    let Some(array) = given else { return Ok(vec![default; count]) };
    let array = rows(thing, array, count, N)?;
    Ok(array.as_array().rows().into_iter().map(|row| std::array::from_fn(|i| row[i])).collect())
}

/// The 13 numbers of a motion.
pub(crate) fn motion_row(pose: &Pose, twist: &Twist) -> [f64; STATE] {
    let (p, q, v, w) = (&pose.position, &pose.orientation, &twist.linear, &twist.angular);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, w.x, w.y, w.z]
}

/// Numbers of a state as it was set; NaN without one.
pub(crate) fn state_row(state: Option<&State>) -> [f64; STATE] {
    let mut row = [f64::NAN; STATE];
    if let Some(state) = state {
        row[..3].copy_from_slice(&state.position);
        row[3..7].copy_from_slice(&state.orientation);
        row[7..10].copy_from_slice(&state.linear_velocity);
        row[10..].copy_from_slice(&state.angular_velocity);
    }
    row
}

/// The six numbers of a wrench.
pub(crate) fn wrench_row(wrench: &Wrench) -> [f64; WRENCH] {
    let (f, m) = (&wrench.force, &wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

/// Fills an array of the caller, or a new one, row by row.
pub(crate) fn fill<'py, const N: usize>(
    py: Python<'py>,
    out: Option<Bound<'py, PyAny>>,
    count: usize,
    row: impl Fn(usize) -> PyResult<[f64; N]>,
) -> PyResult<Matrix<'py>> {
    let array = match out {
        Some(given) => match given.cast::<PyArray2<f64>>() {
            Ok(array) if array.shape() == [count, N] => array.clone(),
            _ => {
                let cure = format!("give an array of float64 with shape ({count}, {N})");
                return Err(refused("out", &given, &cure));
            }
        },
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
