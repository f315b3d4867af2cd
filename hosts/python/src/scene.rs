//! Scene files (docs/scene_format.md).

use crate::batch::Batch;
use crate::errors::{bad_value, of_scene};
use crate::model::extensions;
use crate::setup::worker_settings;
use crate::simulation::Simulation;
use pong_executive::Integrator;
use pong_executive::scene::Variation;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A parsed scene file. `build` loads its models and sets everything up.
#[pyclass(frozen, module = "pong")]
pub(crate) struct Scene {
    scene: pong_executive::scene::Scene,
}

#[pymethods]
impl Scene {
    /// Reads a scene file; models are searched beside it.
    ///
    /// Parameters
    /// ----------
    /// path : path_like
    ///     Scene file.
    /// allow_files_below : sequence of path_like, optional
    ///     Further folders from which its models may read meshes.
    ///
    /// Returns
    /// -------
    /// Scene
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     The file is at fault: `errors` lists every fault.
    #[staticmethod]
    #[pyo3(signature = (path, *, allow_files_below = Vec::new()))]
    fn load(path: PathBuf, allow_files_below: Vec<PathBuf>) -> PyResult<Self> {
        let read = pong_executive::scene::Scene::load(&path);
        let scene = read.map_err(of_scene)?;
        Ok(Self { scene: scene.with_extensions(extensions(allow_files_below)) })
    }

    /// Reads a scene from text.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     Text of a scene file.
    /// name : str, default "scene"
    ///     Name that stands for the file in errors.
    /// folder : path_like, optional
    ///     Folder in which models are searched.
    /// allow_files_below : sequence of path_like, optional
    ///     Further folders from which its models may read meshes.
    ///
    /// Returns
    /// -------
    /// Scene
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     The text is at fault: `errors` lists every fault.
    #[staticmethod]
    #[pyo3(signature = (text, *, name = "scene", folder = PathBuf::new(), allow_files_below = Vec::new()))]
    fn parse(text: &str, name: &str, folder: PathBuf, allow_files_below: Vec<PathBuf>) -> PyResult<Self> {
        let read = pong_executive::scene::Scene::parse(text, name, &folder);
        let scene = read.map_err(of_scene)?;
        Ok(Self { scene: scene.with_extensions(extensions(allow_files_below)) })
    }

    /// str : Name as given in the file.
    #[getter]
    fn name(&self) -> &str {
        self.scene.name()
    }

    /// float : Step, s.
    #[getter]
    fn step(&self) -> f64 {
        self.scene.step()
    }

    /// float : Duration, s.
    #[getter]
    fn duration(&self) -> f64 {
        self.scene.duration()
    }

    /// str : Integrator, as the scene format spells it.
    #[getter]
    fn integrator(&self) -> String {
        self.scene.integrator().to_string()
    }

    /// list of str : Names of the alternatives.
    #[getter]
    fn alternatives(&self) -> Vec<&str> {
        self.scene.alternatives().collect()
    }

    /// list of Path : Every model file that the scene names, including those of its alternatives.
    #[getter]
    fn model_files(&self) -> Vec<PathBuf> {
        self.scene.model_files()
    }

    /// Loads the models and sets everything up, or reports every fault.
    ///
    /// Parameters
    /// ----------
    /// step : float, optional
    ///     Step, s, instead of the file's.
    /// integrator : {"RungeKutta4", "SemiImplicitEuler", "ZeroOrderHold"}, optional
    ///     Integrator instead of the file's.
    /// substeps : int, default 1
    ///     Substeps of "ZeroOrderHold".
    /// delay_frames : int, default 0
    ///     Frames by which its wrenches come late.
    /// workers : int, default 0
    ///     Threads that help the calling thread.
    /// alternative : str, optional
    ///     Name of an alternative of the scene.
    ///
    /// Returns
    /// -------
    /// Simulation
    ///
    /// Raises
    /// ------
    /// SceneError
    ///     The scene or a model is at fault.
    #[pyo3(signature = (*, step = None, integrator = None, substeps = 1, delay_frames = 0, workers = 0, alternative = None))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn build(
        &self,
        py: Python<'_>,
        step: Option<f64>,
        integrator: Option<&str>,
        substeps: u32,
        delay_frames: u32,
        workers: i64,
        alternative: Option<&str>,
    ) -> PyResult<Simulation> {
        let integrator = match integrator {
            None => None,
            Some("RungeKutta4") => Some(Integrator::RungeKutta4),
            Some("SemiImplicitEuler") => Some(Integrator::SemiImplicitEuler),
            Some("ZeroOrderHold") => Some(Integrator::ZeroOrderHold { substeps, delay_frames }),
            Some(other) => {
                let cure = "give \"RungeKutta4\", \"SemiImplicitEuler\" or \"ZeroOrderHold\"";
                return Err(bad_value("integrator", format!("there is no `{other}`"), cure));
            }
        };
        let holds = matches!(integrator, Some(Integrator::ZeroOrderHold { .. }));
        for (name, value, default) in [("substeps", substeps, 1), ("delay_frames", delay_frames, 0)] {
            if value != default && !holds {
                let cure = "give integrator=\"ZeroOrderHold\" beside it, or leave it out";
                return Err(bad_value(name, format!("it is {value} for an integrator that has none"), cure));
            }
        }
        let workers = worker_settings(workers)?;
        let built = py.detach(|| {
            let variation = Variation { step, integrator, workers, alternative, ..Variation::default() };
            self.scene.build_varied(&variation)
        });
        Ok(Simulation::new(built.map_err(of_scene)?))
    }

    /// Builds the scene for many short runs in one call.
    ///
    /// Parameters
    /// ----------
    /// parameters : sequence of str, optional
    ///     Names of parameters that each run sets (docs/fit.md).
    /// threads : int, optional
    ///     Number of threads; one for each core without it.
    ///
    /// Returns
    /// -------
    /// Batch
    ///
    /// Raises
    /// ------
    /// BadValueError
    ///     The scene cannot be built, or a name leads nowhere.
    #[pyo3(signature = (parameters = Vec::new(), *, threads = None))]
    fn batch(&self, parameters: Vec<String>, threads: Option<usize>) -> PyResult<Batch> {
        let threads = threads.unwrap_or_else(pong_fit::Batch::threads_of_this_machine);
        Batch::new(&self.scene, parameters, threads)
    }

    fn __repr__(&self) -> String {
        format!("<pong.Scene {:?}>", self.scene.name())
    }
}
