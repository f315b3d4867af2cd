//! Set-up of a world.

use crate::arrays::refused;
use crate::errors::{PhaseError, bad_value, lock, of_engine};
use crate::ids::{self, AddedModel, Interface, Object, ObjectRef, Pair};
use crate::model::{Model, extensions};
use crate::world::World;
use pong_engine::{Config, Laws, WorkerSettings, WrenchCoupling};
use pong_record::ModelSource;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

/// Sets up a world: models, Objects, pairs. `seal` creates the world.
#[pyclass(frozen, module = "pong")]
pub(crate) struct WorldBuilder {
    /// `None` once sealed.
    setup: Mutex<Option<Setup>>,
}

struct Setup {
    builder: pong_engine::WorldBuilder,
    sources: Vec<ModelSource>,
    folders: Vec<PathBuf>,
}

/// A model, or its file.
#[derive(FromPyObject)]
enum ModelRef<'py> {
    Model(PyRef<'py, Model>),
    Path(PathBuf),
    Other(Bound<'py, PyAny>),
}

/// An argument for an added model.
#[derive(FromPyObject)]
enum AddedRef<'py> {
    Added(PyRef<'py, AddedModel>),
    Other(Bound<'py, PyAny>),
}

impl<'py> AddedRef<'py> {
    fn resolve(self) -> PyResult<PyRef<'py, AddedModel>> {
        match self {
            Self::Added(model) => Ok(model),
            Self::Other(given) => Err(bad_value(
                "model",
                format!("{} is not a model of this builder", given.repr()?),
                "give what `add_model` answers: `builder.create_object(builder.add_model(\"ball.ron\"), \"ball\")`",
            )),
        }
    }
}

/// Settings for this number of worker threads, in addition to the calling thread; `None` for 0.
pub(crate) fn worker_settings(workers: i64) -> PyResult<Option<WorkerSettings>> {
    let cure = "give the number of threads that help the calling thread, or 0";
    let workers = usize::try_from(workers)
        .map_err(|_| bad_value("workers", format!("{workers} threads cannot be started"), cure))?;
    Ok((workers > 0).then(|| WorkerSettings { workers, ..WorkerSettings::default() }))
}

#[pymethods]
impl WorldBuilder {
    #[new]
    #[pyo3(signature = (
        *,
        contact_capacity = None,
        ledger = false,
        accounts = None,
        delay_frames = 0,
        workers = 0,
        allow_files_below = Vec::new(),
    ))]
    fn new(
        contact_capacity: Option<usize>,
        ledger: bool,
        accounts: Option<&str>,
        delay_frames: u32,
        workers: i64,
        allow_files_below: Vec<PathBuf>,
    ) -> PyResult<Self> {
        let accounts = accounts.map(|name| coupling("accounts", name, delay_frames)).transpose()?;
        if accounts.is_none() && delay_frames > 0 {
            let cure = "give accounts=\"zero_order_hold\" beside it, or leave it out";
            return Err(bad_value("delay_frames", format!("it is {delay_frames} without `accounts`"), cure));
        }
        let workers = worker_settings(workers)?;
        let config = Config { contact_capacity, ledger, accounts, workers };
        let extensions = extensions(allow_files_below.clone());
        let builder = pong_engine::WorldBuilder::with_extensions(config, extensions, Laws::default());
        let setup = Setup { builder, sources: Vec::new(), folders: allow_files_below };
        Ok(Self { setup: Mutex::new(Some(setup)) })
    }

    /// Adds a model, or the model of a file.
    fn add_model(&self, py: Python<'_>, model: ModelRef<'_>) -> PyResult<AddedModel> {
        self.with(|setup| {
            let (shared, source) = match model {
                ModelRef::Model(model) => (Arc::clone(&model.model), model.source.clone()),
                ModelRef::Path(path) => {
                    let loaded = Model::load(py, path, setup.folders.clone())?;
                    (loaded.model, loaded.source)
                }
                ModelRef::Other(given) => {
                    return Err(refused("model", &given, "give a pong.Model, or the path of a model file"));
                }
            };
            let name = shared.name.clone();
            let id = setup.builder.add_model(shared);
            setup.sources.push(source);
            Ok(AddedModel { id, name })
        })
    }

    /// Creates an Object from a model. Objects of one model are independent.
    fn create_object(&self, model: AddedRef<'_>, name: &str) -> PyResult<Object> {
        let model = model.resolve()?;
        self.with(|setup| {
            let id = setup.builder.create_object(model.id, name).map_err(of_engine)?;
            Ok(Object { id, name: name.to_owned() })
        })
    }

    /// Declares that two Objects, given directly or by name, may touch.
    fn pair(&self, a: ObjectRef<'_>, b: ObjectRef<'_>) -> PyResult<Pair> {
        self.with(|setup| {
            let (a, b) = (a.resolve(setup.builder.scene())?, b.resolve(setup.builder.scene())?);
            let id = setup.builder.pair(a, b).map_err(of_engine)?;
            let name = |id| setup.builder.scene().object_name(id).map(str::to_owned).map_err(of_engine);
            Ok(Pair { id, name: format!("{}, {}", name(a)?, name(b)?) })
        })
    }

    /// Disables contact between two groups of Objects, each with everything below it, given by path or name;
    /// an empty one is the whole Object.
    fn filter(&self, a: ObjectRef<'_>, group_a: &str, b: ObjectRef<'_>, group_b: &str) -> PyResult<()> {
        self.with(|setup| {
            let (a, b) = (a.resolve(setup.builder.scene())?, b.resolve(setup.builder.scene())?);
            setup.builder.filter(a, group_a, b, group_b).map_err(of_engine)
        })
    }

    /// The Interface of a movable group by its path or name. An empty path is the root.
    #[pyo3(signature = (object, path = ""))]
    fn interface(&self, object: ObjectRef<'_>, path: &str) -> PyResult<Interface> {
        self.with(|setup| {
            let object = object.resolve(setup.builder.scene())?;
            let id = setup.builder.scene().interface(object, path).map_err(of_engine)?;
            ids::interface(setup.builder.scene(), id)
        })
    }

    /// Ends set-up. The builder is used up; if the seal is refused, it can be corrected and sealed again.
    fn seal(&self, py: Python<'_>) -> PyResult<World> {
        let mut place = self.lock()?;
        let Setup { builder, sources, folders } = place.take().ok_or_else(sealed)?;
        match py.detach(|| builder.seal().map_err(Box::new)) {
            Ok((world, report)) => World::new(world, (sources, folders), &report),
            Err(refused) => {
                let (builder, error) = refused.into_parts();
                *place = Some(Setup { builder, sources, folders });
                Err(of_engine(error))
            }
        }
    }
}

impl WorldBuilder {
    /// One that was begun elsewhere.
    pub fn new_from(
        builder: pong_engine::WorldBuilder,
        sources: Vec<ModelSource>,
        folders: Vec<PathBuf>,
    ) -> Self {
        Self { setup: Mutex::new(Some(Setup { builder, sources, folders })) }
    }

    fn lock(&self) -> PyResult<std::sync::MutexGuard<'_, Option<Setup>>> {
        lock("world builder", &self.setup, "set a world up in one thread")
    }

    fn with<T>(&self, call: impl FnOnce(&mut Setup) -> PyResult<T>) -> PyResult<T> {
        call(self.lock()?.as_mut().ok_or_else(sealed)?)
    }
}

fn sealed() -> PyErr {
    PhaseError::new_err("world builder: its world was sealed; make another builder for another world")
}

/// Coupling of the wrenches to the host's integrator, by name.
pub(crate) fn coupling(thing: &str, name: &str, delay_frames: u32) -> PyResult<WrenchCoupling> {
    if delay_frames > 0 && ["stages", "semi_implicit"].contains(&name) {
        let cause = format!("it is {delay_frames}, and {thing} is \"{name}\", which never comes late");
        return Err(bad_value("delay_frames", cause, "give it with \"zero_order_hold\", or leave it out"));
    }
    match name {
        "stages" => Ok(WrenchCoupling::Stages),
        "semi_implicit" => Ok(WrenchCoupling::SemiImplicit),
        "zero_order_hold" => Ok(WrenchCoupling::ZeroOrderHold { delay_frames }),
        other => {
            let cause = format!("there is no `{other}`");
            Err(bad_value(thing, cause, "give \"stages\", \"semi_implicit\" or \"zero_order_hold\""))
        }
    }
}
