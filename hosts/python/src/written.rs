//! Text of a model file from Python values: the inverse of `authored`.

use numpy::{PyUntypedArray, PyUntypedArrayMethods};
use pong_model::authored::{Field, Node, Value};
use pong_model::schema::{self, Type};
use pong_model::write;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString, PyTuple};

/// Deepest nesting of values; the reader accepts no deeper ones.
const DEEPEST: usize = 128;

/// Text of a model file with this data.
///
/// Parameters
/// ----------
/// data : dict
///     Data in the form that `read_authored` gives.
/// one_line : bool
///     Write everything on one line.
///
/// Returns
/// -------
/// str
#[pyfunction]
pub(crate) fn write_authored(data: &Bound<'_, PyDict>, one_line: bool) -> PyResult<String> {
    let model = Value::Struct(None, fields(data, 0)?);
    Ok(if one_line { write::line(&model) } else { write::text(&model) })
}

/// Value of a Python object in a field of this type.
fn value(object: &Bound<'_, PyAny>, of: Option<Type>, depth: usize) -> PyResult<Value> {
    if depth > DEEPEST {
        return Err(PyValueError::new_err(format!("a model file nests values {DEEPEST} deep at most")));
    }
    if object.is_none() {
        return Ok(Value::name("None"));
    }
    if let Ok(array) = object.cast::<PyUntypedArray>() {
        let content = object.call_method0("tolist")?;
        let is_number = array.ndim() == 0;
        return if is_number { value(&content, of, depth + 1) } else { list(&content, of, depth) };
    }
    if let Ok(text) = object.cast::<PyString>() {
        let is_name = matches!(of, Some(Type::Bound | Type::Word(_)));
        return Ok(if is_name { Value::name(text.to_str()?) } else { Value::text(text.to_str()?) });
    }
    if let Ok(entries) = object.cast::<PyDict>() {
        return if matches!(of, Some(Type::Map(_))) { map(entries, depth) } else { tagged(entries, depth) };
    }
    if let Ok(items) = object.cast::<PyTuple>() {
        return tuple(None, items, of, depth);
    }
    if object.is_instance_of::<PyList>() {
        return list(object, of, depth);
    }
    // Booleans of NumPy are none of Python, and both count as numbers.
    if object.is_instance_of::<PyBool>() || object.get_type().name()? == "bool" {
        return Ok(Value::Bool(object.is_truthy()?));
    }
    if let Ok(number) = object.extract::<f64>() {
        return Ok(Value::Number(number));
    }
    let kind = object.get_type().name()?;
    Err(PyTypeError::new_err(format!("a model file has no form for {}, which is a {kind}", object.repr()?)))
}

/// Map of names to structs.
fn map(entries: &Bound<'_, PyDict>, depth: usize) -> PyResult<Value> {
    let entry = |(key, entry): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let key = Value::text(key.str()?.to_str()?);
        Ok((Node::from(key), Node::from(value(&entry, None, depth + 1)?)))
    };
    Ok(Value::Map(entries.iter().map(entry).collect::<PyResult<_>>()?))
}

/// `(a: 1)`, or `Name(a: 1)` for {"Name": {"a": 1}}: names of fields begin with a small letter.
fn tagged(entries: &Bound<'_, PyDict>, depth: usize) -> PyResult<Value> {
    if let [(key, inner)] = &entries.iter().collect::<Vec<_>>()[..]
        && let Ok(name) = key.extract::<String>()
        && name.starts_with(char::is_uppercase)
    {
        let name = Some(name.into_boxed_str());
        if let Ok(inner) = inner.cast::<PyDict>() {
            return Ok(Value::Struct(name, fields(inner, depth + 1)?));
        }
        if let Ok(items) = inner.cast::<PyTuple>() {
            return tuple(name, items, None, depth);
        }
        return Ok(Value::Tuple(name, vec![value(inner, None, depth + 1)?.into()]));
    }
    Ok(Value::Struct(None, fields(entries, depth)?))
}

/// Fields of a struct. `None` leaves a field out, except where it is the name of a law.
fn fields(entries: &Bound<'_, PyDict>, depth: usize) -> PyResult<Vec<Field>> {
    let mut all = Vec::new();
    for (key, entry) in entries.iter() {
        let name = key.str()?;
        let name = name.to_str()?;
        let of = schema::field(name).map(|field| field.value);
        if entry.is_none() && !matches!(of, Some(Type::FrictionLaw)) {
            continue;
        }
        let value = value(&entry, of, depth + 1)?.into();
        all.push(Field { name: name.into(), at: 0, value });
    }
    Ok(all)
}

fn tuple(
    name: Option<Box<str>>,
    items: &Bound<'_, PyTuple>,
    of: Option<Type>,
    depth: usize,
) -> PyResult<Value> {
    let items = items.iter().map(|item| Ok(value(&item, of, depth + 1)?.into()));
    Ok(Value::Tuple(name, items.collect::<PyResult<_>>()?))
}

/// List, or rows of numbers in a list of a mesh.
fn list(items: &Bound<'_, PyAny>, of: Option<Type>, depth: usize) -> PyResult<Value> {
    // `vertices` are a tuple of vectors in a triangle and a list in a mesh.
    let is_rows = matches!(of, Some(Type::VectorTriple | Type::Vertices | Type::Triangles | Type::Faces));
    if is_rows {
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for row in items.try_iter()? {
            rows.push(row?.try_iter()?.map(|number| number?.extract()).collect::<PyResult<_>>()?);
        }
        return Ok(Value::rows(matches!(of, Some(Type::Faces)), rows));
    }
    let items = items.try_iter()?.map(|item| Ok(value(&item?, of, depth + 1)?.into()));
    Ok(Value::List(items.collect::<PyResult<_>>()?))
}

/// Returns kinds and fields of model files: see `pong.model.schema`.
///
/// Returns
/// -------
/// dict
#[pyfunction]
pub(crate) fn model_schema(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let all = PyDict::new(py);
    all.set_item("model", table(py, schema::MODEL)?)?;
    all.set_item("surface", table(py, schema::SURFACE)?)?;
    all.set_item("pair", table(py, schema::PAIR)?)?;
    all.set_item("group", table(py, schema::GROUP)?)?;
    all.set_item("primitive", table(py, schema::PRIMITIVE)?)?;
    all.set_item("primitives", kinds(py, schema::PRIMITIVES)?)?;
    all.set_item("normal_laws", kinds(py, schema::NORMAL_LAWS)?)?;
    all.set_item("friction_laws", kinds(py, schema::FRICTION_LAWS)?)?;
    all.set_item("bounds", PyTuple::new(py, schema::BOUNDS)?)?;
    Ok(all)
}

fn kinds<'py, T>(py: Python<'py>, kinds: &'static [schema::Kind<T>]) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for kind in kinds {
        all.set_item(kind.name, table(py, kind.fields)?)?;
    }
    Ok(all)
}

/// Type, unit and default of each field. A required field has no default; `words` describes one that is no value.
fn table<'py>(py: Python<'py>, fields: &'static [schema::Field]) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for field in fields {
        let row = PyDict::new(py);
        row.set_item("type", field.value.name())?;
        row.set_item("unit", field.unit)?;
        row.set_item("required", field.default == schema::FieldDefault::Required)?;
        match field.default {
            schema::FieldDefault::Required => {}
            schema::FieldDefault::Value(value) => row.set_item("default", value)?,
            schema::FieldDefault::Words(words) => row.set_item("words", words)?,
        }
        match field.value {
            Type::Record(inner) => row.set_item("fields", table(py, inner)?)?,
            Type::Word(words) => row.set_item("choices", PyTuple::new(py, words)?)?,
            _ => {}
        }
        all.set_item(field.name, row)?;
    }
    Ok(all)
}
