//! Study of speed against accuracy, measured on a scene or a log (docs/trade.md).

use crate::errors::{StudyError, bad_value, in_range};
use crate::model::extensions;
use crate::replay::Interrupt;
use pong_engine::WorkerSettings;
use pong_study::sweep::{
    Answer, Lever, LogAlternative, PlanSettings, Quantity, Row, Settings, Study, report, study, study_log,
};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::ffi::CString;
use std::path::PathBuf;

/// Result of a study. The files of `pong trade` are in the given folder.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct Trade {
    /// str : Name of the scene or log.
    name: String,
    /// str : Page that `pong trade` prints, in Markdown.
    page: String,
    /// list of Level : Levels: step and integrator, then those with one lever more.
    levels: Vec<Py<Level>>,
    /// Level or None : Level of least median time within the tolerance; None if there is none or the reference has not
    /// converged.
    cheapest: Option<Py<Level>>,
    /// bool : True if the reference is accurate enough to judge by.
    converged: bool,
    /// float : Relative uncertainty of the reference itself, in the quantities that count.
    uncertainty: f64,
}

/// One setting of every lever, with its result.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct Level {
    /// str : Name, as in the tables.
    name: String,
    /// dict[str, float] or None : Relative errors by quantity; None if the run did not reach its end.
    errors: Option<BTreeMap<&'static str, f64>>,
    /// float or None : Largest error of the quantities that count.
    error: Option<f64>,
    /// float or None : Median frame time, s; None if the run did not reach its end.
    median_time: Option<f64>,
    /// float or None : 99th percentile of the frame time, s.
    tail_time: Option<f64>,
    /// bool : True if no other level is as fast and as accurate.
    on_front: bool,
    /// bool or None : For a lever that must not change the answer: true if the bits equal those without it. False is a fault
    /// of the engine.
    same_bits: Option<bool>,
}

#[pymethods]
impl Trade {
    fn __repr__(&self) -> String {
        format!("<pong.Trade of {:?}: {} levels>", self.name, self.levels.len())
    }
}

#[pymethods]
impl Level {
    fn __repr__(&self) -> String {
        format!("<pong.Level {}>", self.name)
    }
}

impl Level {
    fn of(study: &Study, row: &Row) -> Self {
        let errors = match &row.answer {
            Answer::Reached { errors, .. } => Some(errors),
            Answer::Diverged { .. } => None,
        };
        let times = row.times.as_ref();
        Self {
            name: row.name.clone(),
            errors: errors.map(|errors| Quantity::ALL.map(|of| (of.name(), errors.of(of))).into()),
            error: study.error(row),
            median_time: times.map(|times| times.median_ns() as f64 * 1e-9),
            tail_time: times.map(|times| times.tail_ns() as f64 * 1e-9),
            on_front: row.on_front,
            same_bits: study.same_bits(row),
        }
    }
}

/// Members of a list with these names; all if no names are given.
fn named<T: Copy>(
    argument: &str,
    names: Option<Vec<String>>,
    all: &[T],
    name: fn(T) -> &'static str,
) -> PyResult<Vec<T>> {
    let Some(names) = names else { return Ok(all.to_vec()) };
    let find = |wanted: &String| {
        all.iter().copied().find(|one| name(*one) == wanted).ok_or_else(|| {
            let known: Vec<&str> = all.iter().map(|one| name(*one)).collect();
            let cure = format!("give any of {}", known.join(", "));
            bad_value(argument, format!("there is no `{wanted}`"), &cure)
        })
    };
    names.iter().map(find).collect()
}

/// Numbers of workers for which this machine has cores; warns of the others.
fn granted(py: Python<'_>, wanted: Vec<usize>) -> PyResult<Vec<usize>> {
    let has =
        |workers: usize| WorkerSettings { workers, ..WorkerSettings::default() }.workers_granted() >= workers;
    let (granted, refused): (Vec<usize>, Vec<usize>) = wanted.into_iter().partition(|workers| has(*workers));
    for workers in refused {
        let line = format!("workers: {workers} is left out: there are not so many cores beside the caller's");
        let line = CString::new(line).expect("the text has no zero in it");
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &line, 1)?;
    }
    Ok(granted)
}

/// Runs a scene, or the motions of a log, over the levers for speed, and reports frame time and error of each
/// (docs/trade.md).
///
/// Parameters
/// ----------
/// subject : path_like
///     Scene file, or folder of a log.
/// output : path_like
///     Folder for the page and its tables.
/// within : float, default 0.02
///     Relative error that is accepted.
/// of : sequence of str, optional
///     Quantities that count; all without it.
/// frame : float, optional
///     Frame of the host, s.
/// halvings : int, optional
///     Number of halvings of the step.
/// duration : float, optional
///     Duration of a run, s.
/// levers : sequence of str, optional
///     Levers to be tried; all but `long_frame` without it.
/// alternatives : Mapping[str, Mapping[str, path_like]], optional
///     Alternatives of a log: for each name, model files by the name of the model that they replace.
/// leaves : sequence of int, optional
///     Leaf sizes to be tried.
/// workers : sequence of int, optional
///     Numbers of workers to be tried.
/// rounds : int, default 3
///     Number of timings of each level.
/// refinements : int, default 2
///     Refinements of the reference.
/// fresh : bool, default False
///     Measures again what the folder has already.
/// allow_files_below : sequence of path_like, optional
///     Further folders from which models may read meshes.
///
/// Returns
/// -------
/// Trade
///
/// Raises
/// ------
/// StudyError
///     The subject or a setting cannot be used.
#[pyfunction]
#[pyo3(signature = (
    subject, output, *, within = 0.02, of = None, frame = None, halvings = None, duration = None, levers = None,
    alternatives = None, leaves = vec![8, 32, 128], workers = vec![1], rounds = 3, refinements = 2, fresh = false,
    allow_files_below = Vec::new(),
))]
#[expect(clippy::too_many_arguments, reason = "they are named in Python")]
pub(crate) fn trade(
    py: Python<'_>,
    subject: PathBuf,
    output: PathBuf,
    within: f64,
    of: Option<Vec<String>>,
    frame: Option<f64>,
    halvings: Option<u32>,
    duration: Option<f64>,
    levers: Option<Vec<String>>,
    alternatives: Option<BTreeMap<String, BTreeMap<String, PathBuf>>>,
    leaves: Vec<usize>,
    workers: Vec<usize>,
    rounds: u32,
    refinements: u32,
    fresh: bool,
    allow_files_below: Vec<PathBuf>,
) -> PyResult<Trade> {
    in_range("within", within, f64::MIN_POSITIVE..1.0, "give a share above 0 and below 1, such as 0.02")?;
    in_range("halvings", halvings.unwrap_or(0), 0..17, "give a number up to 16")?;
    in_range("rounds", rounds, 1..1001, "give a number from 1 to 1000")?;
    in_range("refinements", refinements, 0..9, "give a number up to 8")?;
    if alternatives.is_some() && !subject.is_dir() {
        let cure = "write `alternatives` into it (docs/scene_format.md)";
        return Err(bad_value("alternatives", "a scene names its own", cure));
    }
    let settings = Settings {
        plan: PlanSettings {
            frame_s: frame,
            halvings,
            duration_s: duration,
            levers: match levers {
                None => Lever::usual(),
                given => named("levers", given, Lever::ALL, Lever::name)?,
            },
            leaves,
            workers: granted(py, workers)?,
        },
        within,
        of: named("of", of, &Quantity::ALL, Quantity::name)?,
        rounds,
        refinements,
        fresh,
        extensions: extensions(allow_files_below),
    };
    let alternatives: Vec<LogAlternative> = alternatives.into_iter().flatten().map(alternative).collect();
    let mut interrupt = Interrupt::default();
    let found = py.detach(|| {
        let mut watch = |_: &pong_study::sweep::Progress<'_>| interrupt.flow();
        let found = if subject.is_dir() {
            study_log(&subject, &alternatives, &output, &settings, &mut watch)
        } else {
            study(&subject, &output, &settings, &mut watch)
        }?;
        report::write(&found, &output)?;
        Ok(found)
    });
    let refused = |error: pong_study::StudyError| StudyError::new_err(error.0);
    told(py, &interrupt.or(found.map_err(refused))?)
}

fn alternative((name, models): (String, BTreeMap<String, PathBuf>)) -> LogAlternative {
    LogAlternative { name, models: models.into_iter().collect() }
}

fn told(py: Python<'_>, study: &Study) -> PyResult<Trade> {
    let levels = study.rows.iter().map(|row| Py::new(py, Level::of(study, row)));
    let levels = levels.collect::<PyResult<Vec<_>>>()?;
    Ok(Trade {
        name: study.scene.clone(),
        page: report::markdown(study),
        cheapest: study.cheapest.map(|row| levels[row].clone_ref(py)),
        levels,
        converged: study.converged,
        uncertainty: study.uncertainty(),
    })
}
