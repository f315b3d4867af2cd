//! Many short runs of a scene in one call.

use crate::arrays::{self, STATE, WRENCH};
use crate::errors::{BadValueError, bad_value, lock};
use numpy::{PyArray1, PyArray2, PyArray4, PyArrayMethods};
use pong_executive::Pose;
use pong_fit::Case;
use pong_geometry::{Twist, Vec3};
use pyo3::prelude::*;
use std::sync::Mutex;

/// A scene, built once for each thread, with parameters that each run sets. `Scene.batch` makes it.
#[pyclass(frozen, module = "pong")]
pub(crate) struct Batch {
    batch: Mutex<Box<pong_fit::Batch>>,
    bodies: Vec<String>,
    parameters: Vec<String>,
}

/// Results of a batch: one for each case, in order.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct BatchRuns {
    /// ndarray, shape (n, t, b, 13) : States of each body at each time; NaN in runs that failed.
    states: Py<PyArray4<f64>>,
    /// ndarray, shape (n, t, b, 6) : Contact wrenches on each body, about the origin of its group, along the common axes.
    wrenches: Py<PyArray4<f64>>,
    /// ndarray, shape (n, b) : Largest contact force on each body over all steps, N.
    peak_force: Py<PyArray2<f64>>,
    /// dict[int, str] : Reasons of the runs that failed, by the number of the case.
    failures: std::collections::BTreeMap<usize, String>,
}

impl Batch {
    pub fn new(
        scene: &pong_executive::scene::Scene,
        parameters: Vec<String>,
        threads: usize,
    ) -> PyResult<Self> {
        let batch = pong_fit::Batch::new(scene, &parameters, threads);
        let batch = batch.map_err(|error| BadValueError::new_err(error.0))?;
        Ok(Self { bodies: batch.bodies().to_vec(), batch: Mutex::new(Box::new(batch)), parameters })
    }

    fn cases(
        &self,
        values: Option<Bound<'_, PyAny>>,
        starts: Option<Bound<'_, PyAny>>,
        times: &[f64],
        count: usize,
    ) -> PyResult<Vec<Case>> {
        let empty = Case { times: times.to_vec(), ..Case::default() };
        let mut cases = vec![empty; count];
        if let Some(values) = values {
            let rows = arrays::rows("values", &values, count, self.parameters.len())?;
            for (case, row) in cases.iter_mut().zip(rows.as_array().rows()) {
                case.values = row.iter().copied().collect();
            }
        }
        if let Some(starts) = starts {
            let flat = starts.call_method1("reshape", (count * self.bodies.len(), STATE))?;
            let rows = arrays::rows("starts", &flat, count * self.bodies.len(), STATE)?;
            let rows = rows.as_array();
            for (number, case) in cases.iter_mut().enumerate() {
                for body in 0..self.bodies.len() {
                    let row = rows.row(number * self.bodies.len() + body);
                    let vector = |from: usize| Vec3::new(row[from], row[from + 1], row[from + 2]);
                    let orientation: [f64; 4] = std::array::from_fn(|i| row[3 + i]);
                    let norm = orientation.iter().map(|x| x * x).sum::<f64>().sqrt();
                    // A row of NaN stands for the start of the scene.
                    if row.iter().all(|x| x.is_nan()) {
                        case.starts.push(None);
                        continue;
                    }
                    if (norm - 1.0).abs() > 1e-3 || row.iter().any(|x| !x.is_finite()) {
                        let cause = format!("case {number} has no state for `{}`", self.bodies[body]);
                        let cure = "give finite numbers with a unit quaternion (w, x, y, z), or NaN for the scene's start";
                        return Err(bad_value("starts", cause, cure));
                    }
                    let twist = Twist { linear: vector(7), angular: vector(10) };
                    case.starts.push(Some((Pose::new(vector(0), orientation), twist)));
                }
            }
        }
        Ok(cases)
    }
}

#[pymethods]
impl Batch {
    /// list of str : Names of the bodies, in the order of starts and results.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.bodies.clone()
    }

    /// list of str : Names of the parameters, in the order of values.
    #[getter]
    fn parameters(&self) -> Vec<String> {
        self.parameters.clone()
    }

    /// Runs all cases on all threads. Results have the same bits for any number of threads.
    ///
    /// Parameters
    /// ----------
    /// times : array_like, shape (t,)
    ///     Times of the samples, s, increasing; the runs begin at the first.
    /// values : array_like, shape (n, p), optional
    ///     Values of the parameters of each case.
    /// starts : ndarray, shape (n, b, 13), optional
    ///     States of all bodies at the first time; a row of NaN stands for that of the scene.
    ///
    /// Returns
    /// -------
    /// BatchRuns
    ///
    /// Raises
    /// ------
    /// BadValueError
    ///     An array has another shape, or a row is no state. Runs that fail are in `failures`.
    #[pyo3(signature = (times, *, values = None, starts = None))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        times: Vec<f64>,
        values: Option<Bound<'py, PyAny>>,
        starts: Option<Bound<'py, PyAny>>,
    ) -> PyResult<BatchRuns> {
        let length = |given: &Bound<'_, PyAny>| given.len();
        let count = match (&values, &starts) {
            (Some(given), _) | (None, Some(given)) => length(given)?,
            (None, None) => 1,
        };
        let cases = self.cases(values, starts, &times, count)?;
        let mut batch = lock("batch", &self.batch, "give each thread a batch of its own")?;
        let batch: &mut pong_fit::Batch = &mut batch;
        let results = py.detach(|| batch.run(&cases));
        let (rows, bodies) = (times.len(), self.bodies.len());
        let mut failures = std::collections::BTreeMap::new();
        let (mut states, mut wrenches, mut peaks) = (Vec::new(), Vec::new(), Vec::new());
        for (number, result) in results.into_iter().enumerate() {
            match result {
                Ok(outcome) => {
                    for sample in &outcome.samples {
                        states.extend(arrays::motion_row(&sample.pose, &sample.twist));
                        wrenches.extend(arrays::wrench_row(&sample.wrench));
                    }
                    peaks.extend(outcome.peak_force);
                }
                Err(error) => {
                    failures.insert(number, error.0);
                    states.extend(vec![f64::NAN; rows * bodies * STATE]);
                    wrenches.extend(vec![f64::NAN; rows * bodies * WRENCH]);
                    peaks.extend(vec![f64::NAN; bodies]);
                }
            }
        }
        Ok(BatchRuns {
            states: PyArray1::from_vec(py, states).reshape([count, rows, bodies, STATE])?.unbind(),
            wrenches: PyArray1::from_vec(py, wrenches).reshape([count, rows, bodies, WRENCH])?.unbind(),
            peak_force: PyArray1::from_vec(py, peaks).reshape([count, bodies])?.unbind(),
            failures,
        })
    }

    fn __repr__(&self) -> String {
        format!("<pong.Batch of {} parameters>", self.parameters.len())
    }
}
