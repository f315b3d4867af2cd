//! Parameters identified from measured data (docs/fit.md).

use crate::errors::{StudyError, bad_value};
use crate::model::extensions;
use crate::replay::Interrupt;
use pong_executive::scene::Scene;
use pong_fit::{
    Errors, Estimate, Free, MomentumSettings, Quantity, Settings, Starts, fit_file, fit_text, free_bodies,
    inertia_from_momentum, load, parse, report,
};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Ends of an interval.
type Ends = (f64, f64);

/// Result of `fit`.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct Fit {
    /// str : Page that `pong fit` prints, in Markdown.
    page: String,
    /// list of FitParameter : Parameters, in the order given.
    parameters: Vec<Py<FitParameter>>,
    /// list of list of float : Correlation of each two parameters.
    correlations: Vec<Vec<f64>>,
    /// dict[str, float] : Root mean square differences of the records of the fit, by quantity and `weighted`.
    train: BTreeMap<String, f64>,
    /// dict[str, float] : The same of the records that took no part.
    test: BTreeMap<String, f64>,
    /// dict[str, float] : The same with the values of the scene.
    test_of_scene: BTreeMap<String, f64>,
    /// float : Median over the records of the largest contact force, N.
    peak_force: f64,
    /// bool : True if the search came to its end.
    converged: bool,
    /// list of str : Surfaces and mass properties to paste.
    to_paste: Vec<String>,
    /// list of str : Notes, each with thing, cause and cure.
    notes: Vec<String>,
    /// int : Number of runs that were computed.
    runs: u64,
}

/// A parameter that was identified.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct FitParameter {
    /// str : Name.
    name: String,
    /// str : Unit; empty for a pure number.
    unit: &'static str,
    /// float : Value at the optimum.
    value: f64,
    /// float : Value in the scene.
    in_scene: f64,
    /// tuple[float, float] or None : Profile interval; None without profiles.
    profile: Option<Ends>,
    /// tuple[float, float] or None : Interval of the bootstrap; None with less than five records.
    bootstrap: Option<Ends>,
    /// tuple[float, float] : Interval from the curvature.
    linear: Ends,
    /// tuple[float, float] or None : Values within one standard error.
    one_error: Option<Ends>,
    /// tuple[float, float] or None : Peak contact force over them, N.
    peak_force: Option<Ends>,
    /// bool : False if the data do not move the parameter.
    moved: bool,
    /// list of tuple[float, float] : Values with the rise of the sum of squares, in its variance.
    profile_points: Vec<(f64, f64)>,
}

/// Inertia of a body from the momentum of its touches.
#[pyclass(frozen, eq, module = "pong.types", get_all)]
#[derive(PartialEq)]
pub(crate) struct MomentumInertia {
    /// str : Page that `pong fit --momentum` prints, in Markdown.
    page: String,
    /// str : Name of the body.
    body: String,
    /// float : Mean of the principal moments of inertia, kg·m².
    inertia: f64,
    /// tuple[float, float] : Interval of `inertia` by bootstrap over the touches, kg·m².
    interval: Ends,
    /// float : Ratio to the inertia in the scene, as `body.BODY.inertia_factor` has it.
    factor: f64,
    /// tuple[float, float] : The two ordinary slopes, which errors of measurement bias to low and to high values, kg·m².
    slopes: Ends,
    /// int : Number of touches.
    touches: usize,
    /// list of str : Notes of the checks of the data, each with thing, cause and cure.
    notes: Vec<String>,
}

#[pymethods]
impl MomentumInertia {
    fn __repr__(&self) -> String {
        let (low, high) = self.interval;
        format!(
            "<pong.MomentumInertia of {}: {} [{low}, {high}] kg·m² from {} touches>",
            self.body, self.inertia, self.touches
        )
    }
}

#[pymethods]
impl Fit {
    fn __repr__(&self) -> String {
        format!("<pong.Fit of {} parameters>", self.parameters.len())
    }
}

#[pymethods]
impl FitParameter {
    fn __repr__(&self) -> String {
        format!("<pong.FitParameter {} = {} {}>", self.name, self.value, self.unit)
    }
}

fn errors(errors: &Errors) -> BTreeMap<String, f64> {
    let of = errors.of.iter().map(|(quantity, value)| (quantity.name().to_owned(), *value));
    of.chain((errors.records > 0).then(|| ("weighted".to_owned(), errors.weighted))).collect()
}

fn parameter(one: Estimate, profile_points: Vec<(f64, f64)>) -> FitParameter {
    FitParameter {
        name: one.name,
        unit: one.unit,
        value: one.value,
        in_scene: one.in_scene,
        profile: one.profile,
        bootstrap: one.bootstrap,
        linear: one.linear,
        one_error: one.one_error,
        peak_force: one.peak_force,
        moved: one.moved,
        profile_points,
    }
}

fn quantity(argument: &str, name: &str) -> PyResult<Quantity> {
    let found = Quantity::ALL.into_iter().find(|known| known.name() == name);
    found.ok_or_else(|| {
        let cure = format!("give any of {}", Quantity::ALL.map(Quantity::name).join(", "));
        bad_value(argument, format!("there is no `{name}`"), &cure)
    })
}

/// Identifies parameters: `pong.fit` calls it.
///
/// Parameters
/// ----------
/// scene : path_like
///     Scene file.
/// data : path_like
///     CSV file or folder of a response log; the name of `text` in errors, if that is given.
/// text : str or None
///     Text of a CSV file.
/// free : sequence of tuple[str, tuple[float, float] | None]
///     Parameters with their bounds.
/// noise : Mapping[str, float]
///     Noise by quantity.
/// of : sequence of str
///     Quantities that count.
/// begin : float
///     Time from the start of each record before which nothing counts, s.
/// horizon : float or None
///     Length of each record that counts, s.
/// test : float
///     Share of the records that takes no part.
/// confidence : float
///     Confidence of the intervals.
/// measured_starts : bool
///     Takes the first measurement of each record as it is.
/// profiles : bool
///     Computes profile intervals.
/// tries : int
///     Number of points from which the search begins.
/// seed : int
///     Seed of the split, of the tries and of the bootstrap.
/// threads : int
///     Number of threads; 0 for one for each core.
/// output : path_like or None
///     Folder for the files of `pong fit`.
/// allow_files_below : sequence of path_like
///     Further folders from which models may read meshes.
///
/// Returns
/// -------
/// Fit
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one function of Python calls it")]
pub(crate) fn identify(
    py: Python<'_>,
    scene: PathBuf,
    data: PathBuf,
    text: Option<String>,
    free: Vec<(String, Option<Ends>)>,
    noise: BTreeMap<String, f64>,
    of: Vec<String>,
    begin: f64,
    horizon: Option<f64>,
    test: f64,
    confidence: f64,
    measured_starts: bool,
    profiles: bool,
    tries: usize,
    seed: u64,
    threads: usize,
    output: Option<PathBuf>,
    allow_files_below: Vec<PathBuf>,
) -> PyResult<Fit> {
    let mut settings = Settings {
        free: free.into_iter().map(|(name, bounds)| Free { name, bounds }).collect(),
        of: of.iter().map(|name| quantity("of", name)).collect::<PyResult<_>>()?,
        from: begin,
        horizon,
        test,
        confidence,
        starts: if measured_starts { Starts::Measured } else { Starts::Fitted },
        profiles,
        tries,
        seed,
        ..Settings::default()
    };
    for (name, value) in noise {
        settings.noise[quantity("noise", &name)? as usize] = Some(value);
    }
    if threads > 0 {
        settings.threads = threads;
    }
    let scene =
        Scene::load(&scene).map_err(crate::errors::of_scene)?.with_extensions(extensions(allow_files_below));
    let mut interrupt = Interrupt::default();
    let found = py.detach(|| {
        let mut watch = |_: &str| interrupt.flow();
        match &text {
            Some(text) => fit_text(&scene, text, &data.display().to_string(), &settings, &mut watch),
            None => fit_file(&scene, &data, &settings, &mut watch),
        }
    });
    let found = interrupt.or(found.map_err(|error| StudyError::new_err(error.0)))?;
    if let Some(folder) = output {
        report::write(&found, &folder)?;
    }
    let page = report::markdown(&found);
    let mut curves = found.profiles.into_iter().map(|profile| profile.points);
    let parameters = found
        .parameters
        .into_iter()
        .map(|one| Py::new(py, parameter(one, curves.next().unwrap_or_default())));
    Ok(Fit {
        page,
        parameters: parameters.collect::<PyResult<_>>()?,
        correlations: found.correlations,
        train: errors(&found.train[1]),
        test: errors(&found.test[1]),
        test_of_scene: errors(&found.test[0]),
        peak_force: found.peak_force,
        converged: found.converged,
        to_paste: found.to_paste,
        notes: found.notes,
        runs: found.runs,
    })
}

/// Finds an inertia from momentum: `pong.inertia_from_momentum` calls it.
///
/// Parameters
/// ----------
/// scene : path_like
///     Scene file.
/// data : path_like
///     CSV file or folder of a response log; the name of `text` in errors, if that is given.
/// text : str or None
///     Text of a CSV file.
/// body : str or None
///     Name of the body.
/// flight : int
///     Number of poses of the flights before and after a touch.
/// clear : int
///     Number of poses between a touch and each flight.
/// longest : int
///     Largest number of poses in a touch.
/// near : float
///     Distance from the other bodies below which a point may touch, m.
/// apart : float
///     Distance that all other points of the body keep in a touch, m.
/// confidence : float
///     Confidence of the interval.
/// seed : int
///     Seed of the bootstrap.
/// allow_files_below : sequence of path_like
///     Further folders from which models may read meshes.
///
/// Returns
/// -------
/// MomentumInertia
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one function of Python calls it")]
pub(crate) fn momentum_inertia(
    py: Python<'_>,
    scene: PathBuf,
    data: PathBuf,
    text: Option<String>,
    body: Option<String>,
    flight: usize,
    clear: usize,
    longest: usize,
    near: f64,
    apart: f64,
    confidence: f64,
    seed: u64,
    allow_files_below: Vec<PathBuf>,
) -> PyResult<MomentumInertia> {
    let settings = MomentumSettings { body, flight, clear, longest, near, apart, confidence, seed };
    let scene =
        Scene::load(&scene).map_err(crate::errors::of_scene)?.with_extensions(extensions(allow_files_below));
    let found = py.detach(|| {
        let bodies = free_bodies(&scene)?;
        let data = match &text {
            Some(text) => parse(text, &data.display().to_string(), &bodies),
            None => load(&data, &bodies),
        };
        inertia_from_momentum(&scene, &data?, &settings)
    });
    let found = found.map_err(|error| StudyError::new_err(error.0))?;
    Ok(MomentumInertia {
        page: found.markdown(),
        body: found.body,
        inertia: found.inertia,
        interval: found.interval,
        factor: found.factor,
        slopes: found.slopes,
        touches: found.touches,
        notes: found.notes,
    })
}
