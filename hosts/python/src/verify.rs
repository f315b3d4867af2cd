//! Cases with known answers (docs/verification.md).

use crate::errors::bad_value;
use pyo3::prelude::*;

/// A case with a known answer, and its verdict.
#[pyclass(frozen, module = "pong", get_all)]
pub(crate) struct Case {
    /// Name.
    id: String,
    /// Subject.
    title: String,
    /// Source of the expected values.
    source: String,
    /// Rows of the case.
    rows: Vec<Py<Row>>,
    /// Reason why it could not be run; `None` if it could.
    failure: Option<String>,
    /// True if every row is within its tolerance.
    passes: bool,
}

/// A quantity with its expected and its measured value.
#[pyclass(frozen, module = "pong", get_all)]
pub(crate) struct Row {
    /// Name of the quantity.
    quantity: String,
    /// Unit.
    unit: String,
    /// Closed-form value.
    expected: f64,
    /// Measured value.
    got: f64,
    /// Largest allowed error, in the unit.
    allowed: f64,
    /// True if the error is within the tolerance.
    passes: bool,
}

#[pymethods]
impl Case {
    fn __repr__(&self) -> String {
        format!("<pong.Case {} {}>", self.id, if self.passes { "passes" } else { "FAILS" })
    }
}

#[pymethods]
impl Row {
    fn __repr__(&self) -> String {
        let Self { quantity, unit, expected, got, .. } = self;
        format!("<pong.Row {quantity}: {got} {unit}, expected {expected}>")
    }
}

/// Runs the cases named, or all.
#[pyfunction]
#[pyo3(signature = (cases = None))]
pub(crate) fn verify(py: Python<'_>, cases: Option<Vec<String>>) -> PyResult<Vec<Case>> {
    let wanted = match cases {
        None => pong_verify::cases(),
        Some(names) => names.iter().map(|name| find(name)).collect::<PyResult<_>>()?,
    };
    wanted.into_iter().map(|case| told(py, &py.detach(|| case.run()))).collect()
}

fn find(name: &str) -> PyResult<pong_verify::Case> {
    pong_verify::find(name).ok_or_else(|| {
        let known: Vec<&str> = pong_verify::cases().iter().map(|case| case.id).collect();
        bad_value(
            "cases",
            format!("there is no case `{name}`"),
            &format!("name one of: {}", known.join(", ")),
        )
    })
}

fn told(py: Python<'_>, verdict: &pong_verify::Verdict) -> PyResult<Case> {
    let row = |row: &pong_verify::Row| {
        let (quantity, unit) = (row.quantity.clone(), row.unit.to_owned());
        let (expected, got, allowed, passes) = (row.expected, row.got, row.allowed(), row.passes());
        Py::new(py, Row { quantity, unit, expected, got, allowed, passes })
    };
    Ok(Case {
        id: verdict.case.id.to_owned(),
        title: verdict.case.title.to_owned(),
        source: verdict.case.source.to_owned(),
        rows: verdict.rows.iter().map(row).collect::<PyResult<_>>()?,
        failure: verdict.failure.clone(),
        passes: verdict.passes(),
    })
}
