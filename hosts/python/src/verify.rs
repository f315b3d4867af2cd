//! Cases with known answers (docs/verification.md).

use crate::errors::bad_value;
use pyo3::prelude::*;

/// A case with a known answer, and its verdict.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct Case {
    /// str : Name.
    id: String,
    /// str : Subject.
    title: String,
    /// str : Source of the expected values.
    source: String,
    /// list of Row : Rows of the case.
    rows: Vec<Py<Row>>,
    /// str or None : Reason why it could not be run; None if it could.
    failure: Option<String>,
    /// bool : True if every row is within its tolerance.
    passes: bool,
}

/// A quantity with its expected and its measured value.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct Row {
    /// str : Name of the quantity.
    quantity: String,
    /// str : Unit.
    unit: String,
    /// float : Closed-form value, in the unit.
    expected: f64,
    /// float : Measured value, in the unit.
    got: f64,
    /// float : Largest allowed error, in the unit.
    allowed: f64,
    /// bool : True if the error is within the tolerance.
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

/// Runs cases with known answers (docs/verification.md).
///
/// Parameters
/// ----------
/// cases : sequence of str, optional
///     Names of the cases; all without it.
///
/// Returns
/// -------
/// list of Case
///
/// Raises
/// ------
/// BadValueError
///     There is no case of this name.
///
/// Examples
/// --------
/// >>> [case.passes for case in pong.verify(["V1", "V2"])]
/// [True, True]
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
