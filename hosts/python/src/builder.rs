//! Calls of a set-up.

use crate::arrays::refused;
use crate::errors::{bad_value, of_engine};
use crate::ids::{self, AddedModel, Interface, Object, ObjectRef, Pair};
use crate::model::{Model, extensions};
use crate::sealed::World;
use crate::setup::{Setup, WorldBuilder, coupling, sealed, worker_settings};
use pong_engine::{Config, Laws};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

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
        moving_surfaces = false,
    ))]
    fn new(
        contact_capacity: Option<usize>,
        ledger: bool,
        accounts: Option<&str>,
        delay_frames: u32,
        workers: i64,
        allow_files_below: Vec<PathBuf>,
        moving_surfaces: bool,
    ) -> PyResult<Self> {
        let accounts = accounts.map(|name| coupling("accounts", name, delay_frames)).transpose()?;
        if accounts.is_none() && delay_frames > 0 {
            let cure = "give accounts=\"zero_order_hold\" beside it, or leave it out";
            return Err(bad_value("delay_frames", format!("it is {delay_frames} without `accounts`"), cure));
        }
        let workers = worker_settings(workers)?;
        let config = Config { contact_capacity, ledger, accounts, workers, moving_surfaces };
        let extensions = extensions(allow_files_below.clone());
        let builder = pong_engine::WorldBuilder::with_extensions(config, extensions, Laws::default());
        let setup = Setup { builder, sources: Vec::new(), folders: allow_files_below };
        Ok(Self { setup: Mutex::new(Some(setup)) })
    }

    /// Adds a model.
    ///
    /// Parameters
    /// ----------
    /// model : Model or path_like
    ///     Model, or the path of its file.
    ///
    /// Returns
    /// -------
    /// AddedModel
    ///
    /// Raises
    /// ------
    /// ModelError
    ///     The file is at fault: `errors` lists every fault.
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
    ///
    /// Parameters
    /// ----------
    /// model : AddedModel
    ///     Model, as `add_model` returned it.
    /// name : str
    ///     Name of the Object, unique in the world.
    ///
    /// Returns
    /// -------
    /// Object
    fn create_object(&self, model: AddedRef<'_>, name: &str) -> PyResult<Object> {
        let model = model.resolve()?;
        self.with(|setup| {
            let id = setup.builder.create_object(model.id, name).map_err(of_engine)?;
            Ok(Object { id, name: name.to_owned() })
        })
    }

    /// Declares that two Objects may touch.
    ///
    /// Parameters
    /// ----------
    /// a, b : Object or str
    ///     Objects, or their names. Wrenches of the pair are those on `a`.
    ///
    /// Returns
    /// -------
    /// Pair
    fn pair(&self, a: ObjectRef<'_>, b: ObjectRef<'_>) -> PyResult<Pair> {
        self.with(|setup| {
            let (a, b) = (a.resolve(setup.builder.scene())?, b.resolve(setup.builder.scene())?);
            let id = setup.builder.pair(a, b).map_err(of_engine)?;
            let name = |id| setup.builder.scene().object_name(id).map(str::to_owned).map_err(of_engine);
            Ok(Pair { id, name: format!("{}, {}", name(a)?, name(b)?) })
        })
    }

    /// Disables contact between two groups of Objects, each with everything below it.
    ///
    /// Parameters
    /// ----------
    /// a : Object or str
    ///     First Object, or its name.
    /// group_a : str
    ///     Path or name of its group; empty for the whole Object.
    /// b : Object or str
    ///     Second Object, or its name.
    /// group_b : str
    ///     Path or name of its group; empty for the whole Object.
    fn filter(&self, a: ObjectRef<'_>, group_a: &str, b: ObjectRef<'_>, group_b: &str) -> PyResult<()> {
        self.with(|setup| {
            let (a, b) = (a.resolve(setup.builder.scene())?, b.resolve(setup.builder.scene())?);
            setup.builder.filter(a, group_a, b, group_b).map_err(of_engine)
        })
    }

    /// Finds the Interface of a movable group.
    ///
    /// Parameters
    /// ----------
    /// object : Object or str
    ///     Object, or its name.
    /// path : str, optional
    ///     Path or name of the group; empty for the root.
    ///
    /// Returns
    /// -------
    /// Interface
    #[pyo3(signature = (object, path = ""))]
    fn interface(&self, object: ObjectRef<'_>, path: &str) -> PyResult<Interface> {
        self.with(|setup| {
            let object = object.resolve(setup.builder.scene())?;
            let id = setup.builder.scene().interface(object, path).map_err(of_engine)?;
            ids::interface(setup.builder.scene(), id)
        })
    }

    /// Ends set-up: checks everything, and takes the memory of the frames.
    ///
    /// Returns
    /// -------
    /// World
    ///     The world. The builder is used up.
    ///
    /// Raises
    /// ------
    /// SealError
    ///     The world cannot be sealed: `problems` lists every reason. The builder can be corrected and sealed again.
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
