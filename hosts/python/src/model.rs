//! Model files.

use crate::arrays::refused;
use crate::dynamics::check_names;
use crate::errors::{bad_value, of_model};
use pong_model::{Extensions, FrictionLaw};
use pong_record::{ModelSource, SurfaceValues};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyList, PyString};
use std::path::PathBuf;
use std::sync::Arc;

/// A validated, immutable model. Worlds share it. `load` and `parse` make it.
#[pyclass(frozen, module = "pong")]
pub(crate) struct Model {
    pub model: Arc<pong_model::Model>,
    pub source: ModelSource,
}

/// Extensions that allow models to read files from their own folder and from these.
pub(crate) fn extensions(allow_files_below: Vec<PathBuf>) -> Extensions {
    let mut extensions = Extensions::new();
    allow_files_below.into_iter().for_each(|folder| extensions.allow_files_below(folder));
    extensions
}

#[pymethods]
impl Model {
    /// Reads a model file. Meshes are searched beside it, and in the allowed folders.
    ///
    /// Parameters
    /// ----------
    /// path : path_like
    ///     Model file.
    /// allow_files_below : sequence of path_like, optional
    ///     Further folders from which the model may read meshes.
    ///
    /// Returns
    /// -------
    /// Model
    ///
    /// Raises
    /// ------
    /// ModelError
    ///     The file is at fault: `errors` lists every fault, with line, column, cause and cure.
    #[staticmethod]
    #[pyo3(signature = (path, *, allow_files_below = Vec::new()))]
    pub fn load(py: Python<'_>, path: PathBuf, allow_files_below: Vec<PathBuf>) -> PyResult<Self> {
        let extensions = extensions(allow_files_below);
        let read = py.detach(|| pong_model::load(&path, &extensions));
        let model = read.map_err(of_model)?;
        Ok(Self { model: Arc::new(model), source: ModelSource::File(path) })
    }

    /// Reads a model from text.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     Text of a model file.
    /// name : str, default "model"
    ///     Name that stands for the file in errors.
    /// folder : path_like, optional
    ///     Folder in which meshes are searched.
    /// allow_files_below : sequence of path_like, optional
    ///     Further folders from which the model may read meshes.
    ///
    /// Returns
    /// -------
    /// Model
    ///
    /// Raises
    /// ------
    /// ModelError
    ///     The text is at fault: `errors` lists every fault, with line, column, cause and cure.
    #[staticmethod]
    #[pyo3(signature = (text, *, name = "model", folder = None, allow_files_below = Vec::new()))]
    fn parse(
        py: Python<'_>,
        text: String,
        name: &str,
        folder: Option<PathBuf>,
        allow_files_below: Vec<PathBuf>,
    ) -> PyResult<Self> {
        let extensions = extensions(allow_files_below);
        let read = py.detach(|| pong_model::parse(&text, name, folder.as_deref(), &extensions));
        let model = read.map_err(of_model)?;
        Ok(Self { model: Arc::new(model), source: ModelSource::Text { text, mesh_dir: folder } })
    }

    /// str : Name as given in the file.
    #[getter]
    fn name(&self) -> &str {
        &self.model.name
    }

    /// int : Hash of all data that affects results.
    #[getter]
    fn hash(&self) -> u64 {
        self.model.hash
    }

    /// list of str : Warnings for the author of a valid model.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.model.warnings.clone()
    }

    /// list of str : Paths of the movable groups, the root's first.
    #[getter]
    fn groups(&self) -> Vec<String> {
        self.model.bodies.iter().map(|group| group.path.clone()).collect()
    }

    /// Lists the primitives of a movable group.
    ///
    /// Parameters
    /// ----------
    /// group : int, default 0
    ///     Index of the group in `groups`.
    ///
    /// Returns
    /// -------
    /// list[tuple[str, str, str]]
    ///     Path, kind and surface of each.
    #[pyo3(signature = (group = 0))]
    fn primitives(&self, group: usize) -> PyResult<Vec<(String, String, String)>> {
        let Some(group) = self.model.bodies.get(group) else {
            let cause =
                format!("there is no movable group {group}, the model has {}", self.model.bodies.len());
            return Err(bad_value("group", cause, "count from 0"));
        };
        let surface = |index: u32| self.model.surfaces[index as usize].name.clone();
        let row = |info: &pong_model::PrimitiveInfo| {
            (info.path.clone(), info.kind.name().to_owned(), surface(info.surface))
        };
        Ok(group.primitives.iter().map(row).collect())
    }

    /// dict[str, dict[str, Any]] : Surfaces by name, as `World.surface` gives them.
    #[getter]
    fn surfaces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for surface in &self.model.surfaces {
            all.set_item(&surface.name, surface_values(py, surface)?)?;
        }
        Ok(all)
    }

    /// Lists the bounding volume of every group that has one.
    ///
    /// Returns
    /// -------
    /// list[dict[str, Any]]
    ///     `path`, `movable_group`, `kind`, and, if it has a size, `center` (3,), `half` (3,) (m) and `axes` (3, 3) (columns),
    ///     in the frame of the movable group.
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        crate::shapes::bounds(py, &self.model)
    }

    fn __repr__(&self) -> String {
        format!("<pong.Model {:?}>", self.model.name)
    }
}

/// Values of a surface as in logs (docs/response_logs.md, events), with numbers for rigid stiffness too.
pub(crate) fn surface_values<'py>(
    py: Python<'py>,
    surface: &pong_model::Surface,
) -> PyResult<Bound<'py, PyAny>> {
    let values = SurfaceValues::from(surface);
    let text = serde_json::to_string(&values).expect("the values of a surface can be written");
    let values = py.import("json")?.call_method1("loads", (text,))?;
    values.set_item("stiffness", surface.stiffness)?;
    // Logs leave out what a surface does not have; here it can be set.
    values.set_item("foundation", surface.foundation)?;
    values.set_item("area", surface.area)?;
    if let FrictionLaw::Bristle { rolling, spinning, .. } = surface.friction {
        let friction = values.get_item("friction")?;
        friction.set_item("rolling", rolling)?;
        friction.set_item("spinning", spinning)?;
    }
    Ok(values)
}

/// A known surface with some values changed, nested as [`surface_values`] gives them.
pub(crate) fn surface_from(
    py: Python<'_>,
    known: &pong_model::Surface,
    values: &Bound<'_, PyDict>,
) -> PyResult<pong_model::Surface> {
    let thing = format!("surface `{}`", known.name);
    let like = surface_values(py, known)?;
    let plain = plain_values(&thing, values, like.cast::<PyDict>()?)?;
    let text: String = py.import("json")?.call_method1("dumps", (plain,))?.extract()?;
    let read: Result<SurfaceValues, _> = serde_json::from_str(&text);
    let cure = "change values of what `surface` gives and keep its fields";
    Ok(read.map_err(|error| bad_value(&thing, error, cure))?.surface(&known.name))
}

/// Values as JSON: those given, if they have fields and kinds of the known ones, and the known ones for the rest.
fn plain_values<'py>(
    thing: &str,
    values: &Bound<'py, PyDict>,
    known: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyDict>> {
    let law = |of: &Bound<'py, PyDict>| of.get_item("law").map(|law| law.map(|law| law.to_string()));
    let given = law(values)?;
    // Another law has other fields; the engine then refuses the change of law.
    let complete = if given.is_none() || given == law(known)? {
        let names: Vec<String> = known.keys().iter().map(|key| key.to_string()).collect();
        check_names(thing, values, &names.iter().map(String::as_str).collect::<Vec<_>>())?;
        let complete = known.copy()?;
        complete.update(values.as_mapping())?;
        complete
    } else {
        values.clone()
    };
    let plain = PyDict::new(values.py());
    for (key, value) in complete {
        let like = known.get_item(&key)?;
        plain.set_item(&key, plain_value(&format!("{thing}: {key}"), &value, like.as_ref())?)?;
    }
    Ok(plain)
}

fn plain_value<'py>(
    thing: &str,
    value: &Bound<'py, PyAny>,
    known: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = value.py();
    let Some(known) = known else { return Ok(value.clone()) };
    if let Ok(known) = known.cast::<PyDict>() {
        let cure = "give a dictionary, as `surface` does";
        let value = value.cast::<PyDict>().map_err(|_| refused(thing, value, cure))?;
        return Ok(plain_values(thing, value, known)?.into_any());
    }
    if known.is_instance_of::<PyList>() {
        let numbers = value.try_iter().map_err(|_| refused(thing, value, "give a list of numbers"))?;
        let numbers = numbers.map(|number| finite(thing, &number?)).collect::<PyResult<Vec<_>>>()?;
        return Ok(PyList::new(py, numbers)?.into_any());
    }
    if let Ok(truth) = known.extract::<bool>() {
        let given = value.extract::<bool>();
        return given
            .map_err(|_| refused(thing, value, if truth { "give True" } else { "give False" }))
            .map(|given| PyBool::new(py, given).to_owned().into_any());
    }
    if known.is_instance_of::<PyString>() {
        return value
            .is_instance_of::<PyString>()
            .then(|| value.clone())
            .ok_or_else(|| refused(thing, value, "give a name"));
    }
    // A bristle's stiffness and damping may be left to the engine, and a surface may have no foundation; only a
    // stiffness may be infinite.
    let may_be_left_out = ["friction: stiffness", "friction: damping", ": foundation", ": area"];
    let may_be_left_out = may_be_left_out.iter().any(|name| thing.ends_with(name));
    if may_be_left_out && value.is_none() {
        return Ok(value.clone());
    }
    if value.extract::<f64>().is_ok_and(|number| number == f64::INFINITY) && thing.ends_with("stiffness") {
        return Ok(PyString::new(py, "inf").into_any());
    }
    Ok(PyFloat::new(py, finite(thing, value)?).into_any())
}

/// Any finite number: of Python, of NumPy, or an array of one.
fn finite(thing: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number = value.extract::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| refused(thing, value, "give a finite number"))
}
