//! Model files.

use crate::errors::of_model;
use pong_geometry::extension::Extensions;
use pong_record::{ModelSource, SurfaceValues};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// A validated model. It never changes; worlds share it.
#[pyclass(frozen, module = "pong")]
pub(crate) struct Model {
    pub model: Arc<pong_model::Model>,
    pub source: ModelSource,
}

/// What models may read: their own folder, and these.
pub(crate) fn extensions(allow_files_below: Vec<PathBuf>) -> Extensions {
    let mut extensions = Extensions::new();
    allow_files_below.into_iter().for_each(|folder| extensions.allow_files_below(folder));
    extensions
}

#[pymethods]
impl Model {
    /// Reads a model file. Meshes are looked for beside it, and in the folders allowed.
    #[staticmethod]
    #[pyo3(signature = (path, *, allow_files_below = Vec::new()))]
    pub fn load(py: Python<'_>, path: PathBuf, allow_files_below: Vec<PathBuf>) -> PyResult<Self> {
        let extensions = extensions(allow_files_below);
        let read = py.detach(|| pong_model::load(&path, &extensions));
        let model = read.map_err(of_model)?;
        Ok(Self { model: Arc::new(model), source: ModelSource::File(path) })
    }

    /// Reads a model from text. `name` is what errors call it; meshes are looked for in `folder`.
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

    /// Name as given in the file.
    #[getter]
    fn name(&self) -> &str {
        &self.model.name
    }

    /// Hash of everything that decides the numbers.
    #[getter]
    fn hash(&self) -> u64 {
        self.model.hash
    }

    /// What the author should know though the model is valid.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.model.warnings.clone()
    }

    /// Paths of the movable groups, the root's first.
    #[getter]
    fn groups(&self) -> Vec<String> {
        self.model.bodies.iter().map(|group| group.path.clone()).collect()
    }

    /// Primitives of a movable group, by its place: path, kind and surface of each.
    #[pyo3(signature = (group = 0))]
    fn primitives(&self, group: usize) -> PyResult<Vec<(String, String, String)>> {
        let Some(group) = self.model.bodies.get(group) else {
            let cause =
                format!("there is no movable group {group}, the model has {}", self.model.bodies.len());
            return Err(crate::errors::bad_value("group", cause, "count from 0"));
        };
        let surface = |index: u32| self.model.surfaces[index as usize].name.clone();
        let row = |info: &pong_model::PrimitiveInfo| {
            (info.path.clone(), info.kind.name().to_owned(), surface(info.surface))
        };
        Ok(group.primitives.iter().map(row).collect())
    }

    /// The surfaces by name, as `World.surface` gives them.
    #[getter]
    fn surfaces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for surface in &self.model.surfaces {
            all.set_item(&surface.name, surface_values(py, surface)?)?;
        }
        Ok(all)
    }

    /// The bounding volume of every group that has one, in the frame of its movable group.
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        crate::shapes::bounds(py, &self.model)
    }

    fn __repr__(&self) -> String {
        format!("<pong.Model {:?}>", self.model.name)
    }
}

/// The values of a surface as logs write them (docs/response_logs.md, events), with numbers for rigid stiffness too.
pub(crate) fn surface_values<'py>(
    py: Python<'py>,
    surface: &pong_model::Surface,
) -> PyResult<Bound<'py, PyAny>> {
    let values = SurfaceValues::from(surface);
    let text = serde_json::to_string(&values).expect("the values of a surface can be written");
    let values = py.import("json")?.call_method1("loads", (text,))?;
    values.set_item("stiffness", surface.stiffness)?;
    Ok(values)
}

/// A surface from values that [`surface_values`] gave, changed or not.
pub(crate) fn surface_from(
    py: Python<'_>,
    name: &str,
    values: &Bound<'_, PyDict>,
) -> PyResult<pong_model::Surface> {
    let values = values.copy()?;
    if let Some(stiffness) = values.get_item("stiffness")?
        && stiffness.extract::<f64>().is_ok_and(|stiffness| stiffness == f64::INFINITY)
    {
        values.set_item("stiffness", "inf")?;
    }
    let text: String = py.import("json")?.call_method1("dumps", (values,))?.extract()?;
    let read: Result<SurfaceValues, _> = serde_json::from_str(&text);
    let cure = "change values of what `surface` gives and keep its fields";
    Ok(read
        .map_err(|error| crate::errors::bad_value(&format!("surface `{name}`"), error, cure))?
        .surface(name))
}
