//! State of a sealed world: the class `World`, whose calls are in world.rs.

use crate::errors::{bad_value, lock};
use crate::ids::{self, Interface};
use pong_engine::{InterfaceId, PairMonitor, SealReport, State};
use pong_record::{ModelSource, Recorder};
use pyo3::prelude::*;
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

/// A sealed world: states in, wrenches out.
///
/// `WorldBuilder.seal` makes it. One thread at a time may call it; another gets a PhaseError. `evaluate`, `commit` and
/// `step` release the GIL. Units are SI; vectors are in components of the common frame; quaternions are (w, x, y, z).
///
/// Examples
/// --------
/// >>> builder = pong.WorldBuilder()
/// >>> ball = builder.create_object(builder.add_model(pong.load_model("ball.ron")), "ball")
/// >>> ground = builder.create_object(builder.add_model(pong.load_model("ground.ron")), "ground")
/// >>> pair = builder.pair(ball, ground)
/// >>> world = builder.seal()
/// >>> world.set_states(position=[(0.0, 0.0, 0.099), (0.0, 0.0, 0.0)])
/// >>> world.step().contacts
/// 1
/// >>> bool(abs(world.wrenches()[0, 2] - 20.0) < 1e-9)
/// True
#[pyclass(frozen, module = "pong")]
pub(crate) struct World {
    pub inner: Mutex<Box<Inner>>,
    /// All Interfaces, in the order of the rows of arrays.
    pub interfaces: Vec<Interface>,
    pub ids: Vec<InterfaceId>,
    pub warnings: Vec<String>,
    pub notes: Vec<String>,
}

pub(crate) struct Inner {
    pub world: pong_engine::World,
    pub sources: Vec<ModelSource>,
    pub recorder: Option<Recorder>,
    /// Folders that models may read meshes from, for a builder that extends the world.
    pub folders: Vec<PathBuf>,
    pub monitor: Option<PairMonitor>,
    /// Buffer for states from an array on their way into the world.
    pub states: Vec<(InterfaceId, State)>,
}

impl World {
    pub fn new(
        world: pong_engine::World,
        (sources, folders): (Vec<ModelSource>, Vec<PathBuf>),
        report: &SealReport,
    ) -> PyResult<Self> {
        let interfaces = ids::interfaces(world.scene())?;
        Ok(Self {
            ids: interfaces.iter().map(|interface| interface.id).collect(),
            interfaces,
            warnings: report.warnings.iter().map(ToString::to_string).collect(),
            notes: report.notes.iter().map(ToString::to_string).collect(),
            inner: Mutex::new(Box::new(Inner {
                world,
                sources,
                recorder: None,
                folders,
                monitor: None,
                states: Vec::new(),
            })),
        })
    }

    pub fn lock(&self) -> PyResult<MutexGuard<'_, Box<Inner>>> {
        lock("world", &self.inner, "give each thread a world of its own, or wait for the other call")
    }

    /// Interfaces of a call: all, in their order, or those it names.
    pub fn chosen(
        &self,
        interfaces: Option<Vec<PyRef<'_, Interface>>>,
    ) -> PyResult<Option<Vec<InterfaceId>>> {
        let Some(chosen) = interfaces else { return Ok(None) };
        let mut seen = HashSet::new();
        if let Some(twice) = chosen.iter().find(|interface| !seen.insert(interface.id)) {
            let cause = format!("`{}` is given twice", twice.name);
            return Err(bad_value("interfaces", cause, "give each Interface once"));
        }
        Ok(Some(chosen.iter().map(|interface| interface.id).collect()))
    }
}
