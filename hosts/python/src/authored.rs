//! Model files as written: Python values for the values of a file.

use crate::errors::of_model;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1};
use pong_model::authored::{self, Field, Node, Rows, Value};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use std::path::PathBuf;

/// Reads a model file as written. The mesh files it names are not read.
///
/// Parameters
/// ----------
/// path : path_like
///     Model file.
///
/// Returns
/// -------
/// dict
#[pyfunction]
pub(crate) fn read_authored(py: Python<'_>, path: PathBuf) -> PyResult<Py<PyAny>> {
    let read = py.detach(|| authored::load(&path));
    value(py, &read.map_err(of_model)?)
}

/// Reads a model from text as written.
///
/// Parameters
/// ----------
/// text : str
///     Text of a model file.
/// name : str, default "model"
///     Name that stands for the file in errors.
///
/// Returns
/// -------
/// dict
#[pyfunction]
#[pyo3(signature = (text, *, name = "model"))]
pub(crate) fn parse_authored(py: Python<'_>, text: &str, name: &str) -> PyResult<Py<PyAny>> {
    let read = py.detach(|| authored::parse(text, name));
    value(py, &read.map_err(of_model)?)
}

/// Python value of a node: `None` is None, another name its text, `Name(…)` a dictionary {"Name": …},
/// `Some(x)` is x.
fn value(py: Python<'_>, node: &Node) -> PyResult<Py<PyAny>> {
    match &node.value {
        Value::Bool(value) => value.into_py_any(py),
        Value::Number(value) => value.into_py_any(py),
        Value::Text(text) => text.into_py_any(py),
        Value::Name(name) if name.as_ref() == "None" => Ok(py.None()),
        Value::Name(name) => name.into_py_any(py),
        Value::Struct(name, content) => named(py, name.as_deref(), fields(py, content)?.into_any().unbind()),
        Value::Tuple(Some(name), items) if items.len() == 1 => match name.as_ref() {
            "Some" => value(py, &items[0]),
            name => named(py, Some(name), value(py, &items[0])?),
        },
        Value::Tuple(name, items) => {
            let items = PyTuple::new(py, values(py, items)?)?;
            named(py, name.as_deref(), items.into_any().unbind())
        }
        Value::Numbers(numbers) => PyTuple::new(py, numbers.iter())?.into_py_any(py),
        Value::List(items) => PyList::new(py, values(py, items)?)?.into_py_any(py),
        Value::Rows(rows) => {
            let each = (0..rows.len()).map(|index| PyTuple::new(py, rows.row(index)));
            PyList::new(py, each.collect::<PyResult<Vec<_>>>()?)?.into_py_any(py)
        }
        Value::Map(entries) => {
            let all = PyDict::new(py);
            for (key, entry) in entries {
                all.set_item(value(py, key)?, value(py, entry)?)?;
            }
            all.into_py_any(py)
        }
    }
}

fn values(py: Python<'_>, items: &[Node]) -> PyResult<Vec<Py<PyAny>>> {
    items.iter().map(|item| value(py, item)).collect()
}

fn named(py: Python<'_>, name: Option<&str>, content: Py<PyAny>) -> PyResult<Py<PyAny>> {
    let Some(name) = name else { return Ok(content) };
    let tagged = PyDict::new(py);
    tagged.set_item(name, content)?;
    tagged.into_py_any(py)
}

/// Fields by name. The lists of meshes are arrays.
fn fields<'py>(py: Python<'py>, fields: &[Field]) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for Field { name, value: node, .. } in fields {
        let name = name.as_ref();
        let content = match (name, &node.value) {
            ("vertices", Value::Rows(_) | Value::List(_)) => vertices(py, &rows(&node.value))?,
            ("triangles" | "faces", Value::Rows(_) | Value::List(_)) => faces(py, &rows(&node.value))?,
            ("inactive_faces", Value::List(items)) => {
                let numbers = items.iter().filter_map(number).map(|number| whole(py, number));
                PyList::new(py, numbers.collect::<PyResult<Vec<_>>>()?)?.into_py_any(py)?
            }
            ("leaf_size" | "version", Value::Number(number)) => whole(py, *number)?,
            _ => value(py, node)?,
        };
        all.set_item(name, content)?;
    }
    Ok(all)
}

/// An integer field as an int; other numbers stay as they are and are refused by the loader.
fn whole(py: Python<'_>, number: f64) -> PyResult<Py<PyAny>> {
    let int = number as i64;
    if int as f64 == number { int.into_py_any(py) } else { number.into_py_any(py) }
}

/// Rows of numbers from any form of list. All values have been checked to be numbers.
fn rows(value: &Value) -> Rows {
    let mut rows = match value {
        Value::Rows(rows) => return (**rows).clone(),
        _ => Rows::default(),
    };
    let Value::List(items) = value else { return rows };
    for item in items {
        match &item.value {
            Value::Numbers(numbers) => rows.numbers.extend_from_slice(numbers),
            Value::Tuple(_, items) | Value::List(items) => {
                rows.numbers.extend(items.iter().filter_map(number))
            }
            _ => {}
        }
        rows.ends.push(rows.numbers.len() as u32);
    }
    rows
}

fn number(node: &Node) -> Option<f64> {
    match node.value {
        Value::Number(number) => Some(number),
        _ => None,
    }
}

fn vertices(py: Python<'_>, rows: &Rows) -> PyResult<Py<PyAny>> {
    let shape = (rows.len(), 3);
    let array = Array2::from_shape_vec(shape, rows.numbers.clone()).expect("every vertex has three numbers");
    array.into_pyarray(py).into_py_any(py)
}

/// An array with a row for each face if all have the same number of corners, else a list of arrays.
fn faces(py: Python<'_>, rows: &Rows) -> PyResult<Py<PyAny>> {
    let indices: Vec<i64> = rows.numbers.iter().map(|&number| number as i64).collect();
    let width = if rows.len() == 0 { 3 } else { rows.row(0).len() };
    if (0..rows.len()).all(|face| rows.row(face).len() == width) {
        let array = Array2::from_shape_vec((rows.len(), width), indices).expect("all rows are as long");
        return array.into_pyarray(py).into_py_any(py);
    }
    let mut start = 0;
    let each = rows.ends.iter().map(|&end| {
        let face = PyArray1::from_slice(py, &indices[start..end as usize]);
        start = end as usize;
        face
    });
    PyList::new(py, each.collect::<Vec<_>>())?.into_py_any(py)
}
