//! State of a set-up, and its settings: the class `WorldBuilder`, whose calls are in builder.rs.

use crate::errors::{PhaseError, bad_value, lock};
use pong_engine::{WorkerSettings, WrenchCoupling};
use pong_record::ModelSource;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

/// Set-up of a world: models, Objects, pairs. `seal` makes the world.
///
/// Parameters
/// ----------
/// contact_capacity : int, optional
///     Most contacts of a frame.
/// ledger : bool, default False
///     Keeps the sums of energies for `World.ledger`.
/// accounts : {"stages", "semi_implicit", "zero_order_hold"}, optional
///     Switches on energy accounts, for this use of a wrench by the host's integrator.
/// delay_frames : int, default 0
///     Frames by which a held wrench comes late, with "zero_order_hold".
/// workers : int, default 0
///     Threads that help the calling thread. They change no bit.
/// allow_files_below : sequence of path_like, optional
///     Folders from which models may read meshes, beside their own.
/// moving_surfaces : bool, default False
///     Lets surfaces move along themselves (`World.set_surface_motions`).
#[pyclass(frozen, module = "pong")]
pub(crate) struct WorldBuilder {
    /// `None` once sealed.
    pub setup: Mutex<Option<Setup>>,
}

pub(crate) struct Setup {
    pub builder: pong_engine::WorldBuilder,
    pub sources: Vec<ModelSource>,
    pub folders: Vec<PathBuf>,
}

impl WorldBuilder {
    /// Continues a set-up that was begun elsewhere.
    pub fn new_from(
        builder: pong_engine::WorldBuilder,
        sources: Vec<ModelSource>,
        folders: Vec<PathBuf>,
    ) -> Self {
        Self { setup: Mutex::new(Some(Setup { builder, sources, folders })) }
    }

    pub fn lock(&self) -> PyResult<MutexGuard<'_, Option<Setup>>> {
        lock("world builder", &self.setup, "set a world up in one thread")
    }

    pub fn with<T>(&self, call: impl FnOnce(&mut Setup) -> PyResult<T>) -> PyResult<T> {
        call(self.lock()?.as_mut().ok_or_else(sealed)?)
    }
}

/// The refusal of a builder that is used up.
pub(crate) fn sealed() -> PyErr {
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

/// Settings for this number of worker threads, in addition to the calling thread; `None` for 0.
pub(crate) fn worker_settings(workers: i64) -> PyResult<Option<WorkerSettings>> {
    let cure = "give the number of threads that help the calling thread, or 0";
    let workers = usize::try_from(workers)
        .map_err(|_| bad_value("workers", format!("{workers} threads cannot be started"), cure))?;
    Ok((workers > 0).then(|| WorkerSettings { workers, ..WorkerSettings::default() }))
}
