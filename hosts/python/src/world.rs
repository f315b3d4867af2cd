//! A sealed world: frames.

use crate::advice;
use crate::arrays::{self, Matrix, STATE, WRENCH};
use crate::builder::WorldBuilder;
use crate::contacts;
use crate::distance::Distance;
use crate::errors::{PhaseError, bad_value, lock, of_engine};
use crate::ids::{self, AddedModel, Interface, Object, ObjectRef, Pair};
use crate::model::{surface_from, surface_values};
use crate::pair_monitor::{ContactChange, PairPeaks, no_monitor};
use crate::recording;
use numpy::PyArray1;
use pong_advise::StepPlan;
use pong_engine::{EngineError, FrictionPreload, InterfaceId, PairMonitor, SealReport, State};
use pong_record::{ModelSource, RecordOptions, Recorder, WhenFull};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyBytes, PyDict};
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

/// A sealed world: states in, wrenches out.
///
/// One thread at a time may call it. `evaluate`, `commit` and `step` release the GIL.
#[pyclass(frozen, module = "pong")]
pub(crate) struct World {
    inner: Mutex<Box<Inner>>,
    /// All Interfaces, in the order of the rows of arrays.
    interfaces: Vec<Interface>,
    ids: Vec<InterfaceId>,
    warnings: Vec<String>,
    notes: Vec<String>,
}

pub(crate) struct Inner {
    pub world: pong_engine::World,
    pub sources: Vec<ModelSource>,
    pub recorder: Option<Recorder>,
    /// Folders that models may read meshes from, for a builder that extends the world.
    pub folders: Vec<PathBuf>,
    monitor: Option<PairMonitor>,
    /// Buffer for states from an array on their way into the world.
    states: Vec<(InterfaceId, State)>,
}

/// Report of a frame.
#[pyclass(frozen, eq, module = "pong", get_all)]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct FrameReport {
    /// Incomplete or missed parts, as the bits of `pong.Status`.
    status: u32,
    /// Contacts listed.
    contacts: u32,
    /// Contacts that would have been listed without the limit.
    contacts_wanted: u32,
}

impl From<pong_engine::FrameReport> for FrameReport {
    fn from(report: pong_engine::FrameReport) -> Self {
        let pong_engine::FrameReport { status, contacts, contacts_wanted } = report;
        Self { status: status.bits(), contacts, contacts_wanted }
    }
}

#[pymethods]
impl FrameReport {
    /// True if nothing was left out or missed.
    #[getter]
    fn is_complete(&self) -> bool {
        self.status == 0
    }

    fn __repr__(&self) -> String {
        let Self { status, contacts, contacts_wanted } = self;
        format!("<pong.FrameReport status={status} contacts={contacts} contacts_wanted={contacts_wanted}>")
    }
}

impl World {
    pub(crate) fn new(
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

    fn lock(&self) -> PyResult<MutexGuard<'_, Box<Inner>>> {
        lock("world", &self.inner, "give each thread a world of its own, or wait for the other call")
    }

    /// Interfaces of a call: all, in their order, or those it names.
    fn chosen(&self, interfaces: Option<Vec<PyRef<'_, Interface>>>) -> PyResult<Option<Vec<InterfaceId>>> {
        let Some(chosen) = interfaces else { return Ok(None) };
        let mut seen = HashSet::new();
        if let Some(twice) = chosen.iter().find(|interface| !seen.insert(interface.id)) {
            let cause = format!("`{}` is given twice", twice.name);
            return Err(bad_value("interfaces", cause, "give each Interface once"));
        }
        Ok(Some(chosen.iter().map(|interface| interface.id).collect()))
    }
}

/// True if `axes` are those of the common frame, false if those of a group.
fn along_common_axes(axes: &str) -> PyResult<bool> {
    match axes {
        "common" => Ok(true),
        "group" => Ok(false),
        other => Err(bad_value("axes", format!("there is no `{other}`"), "give \"common\" or \"group\"")),
    }
}

#[pymethods]
impl World {
    /// All Interfaces: the rows of `states` and `wrenches`.
    #[getter]
    fn interfaces(&self) -> Vec<Interface> {
        self.interfaces.clone()
    }

    /// Warnings of the seal: pairs of kinds that meet but have no tester.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// Notes of the seal.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    /// Steps that contacts can bear, by the masses of Interfaces (by name) and the joints that they hang on: `stable_step`,
    /// `surely_stable_step`, `warnings`, `notes`, `not_judged`.
    #[pyo3(signature = (masses, *, step, coupling = "stages", delay_frames = 0, closing_speed = None))]
    fn step_report<'py>(
        &self,
        py: Python<'py>,
        masses: &Bound<'py, PyDict>,
        step: f64,
        coupling: &str,
        delay_frames: u32,
        closing_speed: Option<f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let coupling = crate::builder::coupling("coupling", coupling, delay_frames)?;
        let plan = StepPlan { closing_speed, accuracy: None, ..StepPlan::new(step, coupling) };
        advice::step_report(py, &self.lock()?.world, masses, &plan)
    }

    /// All Objects.
    #[getter]
    fn objects(&self) -> PyResult<Vec<Object>> {
        let inner = self.lock()?;
        let object = |id| {
            let name = inner.world.scene().object_name(id).map_err(of_engine)?;
            Ok(Object { id, name: name.to_owned() })
        };
        inner.world.scene().objects().map(object).collect()
    }

    /// All pairs.
    #[getter]
    fn pairs(&self) -> PyResult<Vec<Pair>> {
        ids::pairs(self.lock()?.world.scene())
    }

    /// All models.
    #[getter]
    fn models(&self) -> PyResult<Vec<AddedModel>> {
        let inner = self.lock()?;
        let models = inner.world.scene().models();
        Ok(models.map(|(id, model)| AddedModel { id, name: model.name.clone() }).collect())
    }

    /// Most contacts of a frame.
    #[getter]
    fn contact_capacity(&self) -> PyResult<usize> {
        Ok(self.lock()?.world.contact_capacity())
    }

    /// Hash of the scene: worlds with equal hashes can exchange contact state.
    #[getter]
    fn scene_hash(&self) -> PyResult<u64> {
        Ok(self.lock()?.world.scene_hash())
    }

    /// The Interface of a movable group, by path or name. An empty path is the root.
    #[pyo3(signature = (object, path = ""))]
    fn interface(&self, object: ObjectRef<'_>, path: &str) -> PyResult<Interface> {
        let inner = self.lock()?;
        let object = object.resolve(inner.world.scene())?;
        let id = inner.world.scene().interface(object, path).map_err(of_engine)?;
        ids::interface(inner.world.scene(), id)
    }

    /// `object/path` of a primitive, as contacts name it.
    fn primitive_path(&self, interface: usize, primitive: u32) -> PyResult<String> {
        let Some(id) = self.ids.get(interface) else {
            let cause = format!("there is no Interface {interface}, the world has {}", self.ids.len());
            return Err(bad_value("interface", cause, "take the number from a contact"));
        };
        let inner = self.lock()?;
        let path = inner.world.scene().primitive_path(*id, primitive).map_err(of_engine)?;
        let object = self.interfaces[interface].name.split('/').next().unwrap_or_default();
        Ok(format!("{object}/{path}"))
    }

    /// Sets states: an array of 13 columns, or the four parts separately. If any is refused, none is set.
    #[pyo3(signature = (
        states = None,
        *,
        position = None,
        orientation = None,
        linear_velocity = None,
        angular_velocity = None,
        interfaces = None,
    ))]
    fn set_states(
        &self,
        states: Option<Bound<'_, PyAny>>,
        position: Option<Bound<'_, PyAny>>,
        orientation: Option<Bound<'_, PyAny>>,
        linear_velocity: Option<Bound<'_, PyAny>>,
        angular_velocity: Option<Bound<'_, PyAny>>,
        interfaces: Option<Vec<PyRef<'_, Interface>>>,
    ) -> PyResult<()> {
        let chosen = self.chosen(interfaces)?;
        let ids = chosen.as_deref().unwrap_or(&self.ids);
        let mut inner = self.lock()?;
        let Inner { world, states: room, .. } = &mut **inner;
        room.clear();
        let parts = [&position, &orientation, &linear_velocity, &angular_velocity];
        match &states {
            Some(array) if parts.iter().all(|part| part.is_none()) => {
                let array = arrays::rows("states", array, ids.len(), STATE)?;
                arrays::states(&array.as_array(), ids, room);
            }
            None if position.is_some() => {
                let count = ids.len();
                let p = arrays::part("position", position.as_ref(), count, [0.0; 3])?;
                let q = arrays::part("orientation", orientation.as_ref(), count, [1.0, 0.0, 0.0, 0.0])?;
                let v = arrays::part("linear_velocity", linear_velocity.as_ref(), count, [0.0; 3])?;
                let w = arrays::part("angular_velocity", angular_velocity.as_ref(), count, [0.0; 3])?;
                room.extend(ids.iter().enumerate().map(|(i, id)| {
                    let state = State {
                        position: p[i],
                        orientation: q[i],
                        linear_velocity: v[i],
                        angular_velocity: w[i],
                    };
                    (*id, state)
                }));
            }
            given => {
                let cause = match given {
                    Some(_) => "an array of states and parts of states are given",
                    None => "neither `states` nor `position` is given",
                };
                return Err(bad_value(
                    "states",
                    cause,
                    "give one array of 13 columns, or `position` and the others",
                ));
            }
        }
        world.set_states(room).map_err(of_engine)
    }

    /// States as set, a row for each Interface; NaN for those not set.
    #[pyo3(signature = (out = None))]
    fn states<'py>(&self, py: Python<'py>, out: Option<Bound<'py, PyAny>>) -> PyResult<Matrix<'py>> {
        let inner = self.lock()?;
        arrays::fill(py, out, self.ids.len(), |index| {
            let state = inner.world.state_as_set(self.ids[index]).map_err(of_engine)?;
            let mut row = [f64::NAN; STATE];
            if let Some(state) = state {
                row[..3].copy_from_slice(&state.position);
                row[3..7].copy_from_slice(&state.orientation);
                row[7..10].copy_from_slice(&state.linear_velocity);
                row[10..].copy_from_slice(&state.angular_velocity);
            }
            Ok(row)
        })
    }

    /// Computes wrenches from the states and the committed contact state, and changes nothing else.
    fn evaluate(&self, py: Python<'_>) -> PyResult<FrameReport> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        let report = py.detach(|| world.evaluate()).map_err(of_engine)?;
        recorder.iter_mut().for_each(Recorder::evaluated);
        Ok(report.into())
    }

    /// Commits the states presently set, for all pairs or for some.
    #[pyo3(signature = (pairs = None))]
    fn commit(&self, py: Python<'_>, pairs: Option<Vec<PyRef<'_, Pair>>>) -> PyResult<()> {
        let pairs: Option<Vec<_>> = pairs.map(|pairs| pairs.iter().map(|pair| pair.id).collect());
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        let done = py.detach(|| match &pairs {
            None => world.commit(),
            Some(pairs) => world.commit_pairs(pairs),
        });
        done.map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| match &pairs {
            None => recorder.committed(),
            Some(pairs) => recorder.committed_some(pairs),
        });
        Ok(())
    }

    /// Evaluates and commits, for hosts that call once a frame.
    fn step(&self, py: Python<'_>) -> PyResult<FrameReport> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        let report = py.detach(|| world.step()).map_err(of_engine)?;
        if let Some(recorder) = recorder {
            recorder.evaluated();
            recorder.committed();
        }
        Ok(report.into())
    }

    /// Wrenches of the last frame, a row (force, moment) for each Interface, about the origin of its group.
    #[pyo3(signature = (out = None, *, axes = "common"))]
    fn wrenches<'py>(
        &self,
        py: Python<'py>,
        out: Option<Bound<'py, PyAny>>,
        axes: &str,
    ) -> PyResult<Matrix<'py>> {
        let common = along_common_axes(axes)?;
        let inner = self.lock()?;
        arrays::fill::<WRENCH>(py, out, self.ids.len(), |index| {
            let id = self.ids[index];
            let wrench = if common { inner.world.wrench_common(id) } else { inner.world.wrench(id) };
            Ok(arrays::wrench_row(&wrench.map_err(of_engine)?))
        })
    }

    /// Wrench (force, moment) of the last frame on one Interface's group from its contacts with another's alone, about the origin
    /// of the first. Over all groups that it can touch, these add up to its row of `wrenches`.
    #[pyo3(signature = (on, source, *, axes = "common"))]
    fn wrench_from<'py>(
        &self,
        py: Python<'py>,
        on: &Interface,
        source: &Interface,
        axes: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let common = along_common_axes(axes)?;
        let inner = self.lock()?;
        let (world, on, from) = (&inner.world, on.id, source.id);
        let wrench = if common { world.wrench_from_common(on, from) } else { world.wrench_from(on, from) };
        Ok(PyArray1::from_slice(py, &arrays::wrench_row(&wrench.map_err(of_engine)?)))
    }

    /// Distance of the groups of two Interfaces at the states set last, with their nearest primitives; no frame is needed.
    fn distance(&self, a: &Interface, b: &Interface) -> PyResult<Distance> {
        Ok(self.lock()?.world.distance(a.id, b.id).map_err(of_engine)?.into())
    }

    /// Observes pairs from nothing on; called again, it begins anew.
    fn start_pair_monitor(&self) -> PyResult<()> {
        let mut inner = self.lock()?;
        inner.monitor = Some(PairMonitor::new(&inner.world).map_err(of_engine)?);
        Ok(())
    }

    /// Takes in the frame that was committed last: once after each commit. `step` is the time since the commit before, s.
    fn observe_pairs(&self, step: f64) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, monitor, .. } = &mut **inner;
        monitor.as_mut().ok_or_else(no_monitor)?.observe(world, step).map_err(of_engine)
    }

    /// Begins and ends of contact in the frame observed last, by pair of Objects and groups.
    fn contact_changes(&self) -> PyResult<Vec<ContactChange>> {
        let inner = self.lock()?;
        Ok(inner.monitor.as_ref().ok_or_else(no_monitor)?.changes().map(Into::into).collect())
    }

    /// Peak and mean of all pairs of groups that touched in the window, or whose contact ended in it.
    fn pair_peaks(&self) -> PyResult<Vec<PairPeaks>> {
        let inner = self.lock()?;
        Ok(inner.monitor.as_ref().ok_or_else(no_monitor)?.peaks().map(Into::into).collect())
    }

    /// Begins another window of `pair_peaks`; what touches is kept.
    fn begin_peak_window(&self) -> PyResult<()> {
        self.lock()?.monitor.as_mut().ok_or_else(no_monitor)?.begin_window();
        Ok(())
    }

    /// Wrench (force, moment) of the last frame of a pair, on the Object that was named first in it from the other, about the
    /// origin of the group of `about`, an Interface of either.
    #[pyo3(signature = (pair, about, *, axes = "common"))]
    fn pair_wrench<'py>(
        &self,
        py: Python<'py>,
        pair: &Pair,
        about: &Interface,
        axes: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let common = along_common_axes(axes)?;
        let inner = self.lock()?;
        let (world, pair, about) = (&inner.world, pair.id, about.id);
        let wrench =
            if common { world.pair_wrench_common(pair, about) } else { world.pair_wrench(pair, about) };
        Ok(PyArray1::from_slice(py, &arrays::wrench_row(&wrench.map_err(of_engine)?)))
    }

    /// Contacts of the last frame: a structured array of `pong.CONTACT_DTYPE`.
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        contacts::array(py, &self.lock()?.world)
    }

    /// Derivatives of each contact's normal force by its depth (N/m) and by its depth rate (N·s/m): a row for
    /// each, in the order of `contacts`; NaN for a normal law of the host.
    fn contact_stiffness<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        contacts::stiffness(py, &self.lock()?.world)
    }

    /// Report of the last frame.
    fn report(&self) -> PyResult<FrameReport> {
        Ok(self.lock()?.world.report().into())
    }

    /// Description of a tunnelling event since the last commit; `None` if there was none.
    fn tunnelling(&self) -> PyResult<Option<String>> {
        let inner = self.lock()?;
        let Some(event) = inner.world.tunnelling() else { return Ok(None) };
        let told = || -> Result<String, EngineError> {
            let path = inner.world.scene().primitive_path(event.interface, event.primitive)?;
            let through = inner.world.scene().interface_name(event.through)?;
            Ok(format!("`{path}` through `{through}` (1 of {})", event.count))
        };
        told().map(Some).map_err(of_engine)
    }

    /// Returns the committed contact state.
    fn save_state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let inner = self.lock()?;
        PyBytes::new_with(py, inner.world.state_used(), |room| {
            inner.world.save_state(room).map_err(of_engine)
        })
    }

    /// Restores a contact state saved by a world built by the same calls.
    fn restore_state(&self, block: &[u8]) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        world.restore_state(block).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recorder.restored(block));
        Ok(())
    }

    /// A builder that begins with everything that this world was made of, and with its states, pairs and surfaces as they are
    /// now: add what arrives, seal, and let the new world `continue_from` this one, which may run on meanwhile.
    fn extended(&self) -> PyResult<WorldBuilder> {
        let inner = self.lock()?;
        let builder = pong_engine::WorldBuilder::extending(&inner.world);
        Ok(WorldBuilder::new_from(builder, inner.sources.clone(), inner.folders.clone()))
    }

    /// Continues the run of another world, with the states, pairs, surfaces and contact state of the Objects that are in both,
    /// by name. Returns the counts of what continues and of what was left behind.
    fn continue_from<'py>(slf: &Bound<'py, Self>, other: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        if slf.is(other) {
            let cure = "give the world whose run goes on";
            return Err(bad_value("other", "it is this world itself".to_owned(), cure));
        }
        let (mut inner, other) = (slf.get().lock()?, other.get().lock()?);
        if inner.recorder.is_some() {
            return Err(PhaseError::new_err(
                "continue from another world: a log of this one is running, and the run of the other is not in it; stop it \
                 with stop_log() first, and begin another one afterwards",
            ));
        }
        let of = inner.world.continue_from(&other.world).map_err(of_engine)?;
        let told = PyDict::new(slf.py());
        for (name, count) in [
            ("objects", of.objects),
            ("pairs", of.pairs),
            ("contacts", of.contacts),
            ("objects_left", of.objects_left),
            ("pairs_left", of.pairs_left),
            ("contacts_left", of.contacts_left),
        ] {
            told.set_item(name, count)?;
        }
        told.set_item("energy_left", of.energy_left)?;
        Ok(told)
    }

    /// Drops the contact state of an Object, after a teleport or a reset.
    fn clear_contact_history(&self, object: ObjectRef<'_>) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        let object = object.resolve(world.scene())?;
        world.clear_contact_history(object).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recorder.forgot(object));
        Ok(())
    }

    /// Enables or disables a pair.
    fn set_pair_enabled(&self, pair: &Pair, enabled: bool) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        world.set_pair_enabled(pair.id, enabled).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recorder.pair_switched(pair.id, enabled));
        Ok(())
    }

    /// Present values of a surface of a model.
    fn surface<'py>(&self, py: Python<'py>, model: &AddedModel, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let inner = self.lock()?;
        surface_values(py, inner.world.surface(model.id, name).map_err(of_engine)?)
    }

    /// Replaces the values of a surface, for all Objects of the model. Laws may not change.
    fn set_surface(
        &self,
        py: Python<'_>,
        model: &AddedModel,
        name: &str,
        values: &Bound<'_, PyDict>,
    ) -> PyResult<()> {
        let mut inner = self.lock()?;
        let known = inner.world.surface(model.id, name).map_err(of_engine)?;
        let surface = surface_from(py, known, values)?;
        let Inner { world, recorder, .. } = &mut **inner;
        world.set_surface(model.id, &surface).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recorder.surface_set(model.id, &surface));
        Ok(())
    }

    /// Commits, and preloads the bristles of a pair: `holding` is the force on its first Object, N; without
    /// it, moving contacts are assumed to slide. Returns the number of preloaded bristles.
    #[pyo3(signature = (pair, holding = None))]
    fn preload_friction(&self, pair: &Pair, holding: Option<Bound<'_, PyAny>>) -> PyResult<usize> {
        let preload = match holding {
            Some(force) => FrictionPreload::Holding(arrays::vector::<3>("holding", &force)?.into()),
            None => FrictionPreload::Sliding,
        };
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        let set = world.preload_friction(pair.id, &preload).map_err(of_engine)?;
        // Logged like a restored contact state.
        if let Some(recorder) = recorder {
            let mut block = Vec::new();
            world.save_state_packed(&mut block);
            recorder.restored(&block);
        }
        Ok(set)
    }

    /// Energies of all contacts at the last commit, J. Zero unless the world keeps the ledger.
    fn ledger<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let ledger = self.lock()?.world.ledger();
        [("stored", ledger.stored), ("work", ledger.work), ("dissipated", ledger.dissipated)].into_py_dict(py)
    }

    /// Begins a response log in a folder.
    #[pyo3(signature = (folder, *, name = "", step = None, commits_per_frame = None, overwrite = false, lose = false))]
    fn start_log(
        &self,
        folder: PathBuf,
        name: &str,
        step: Option<f64>,
        commits_per_frame: Option<u64>,
        overwrite: bool,
        lose: bool,
    ) -> PyResult<()> {
        let mut inner = self.lock()?;
        let options = RecordOptions {
            name: name.to_owned(),
            step,
            commits_per_frame,
            overwrite,
            when_full: if lose { WhenFull::Lose } else { WhenFull::Wait },
            ..RecordOptions::default()
        };
        inner.recorder = Some(recording::start(&inner, folder, options)?);
        Ok(())
    }

    /// Records the frame last computed, at a time (s).
    fn log_frame(&self, py: Python<'_>, time: f64) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        recording::record(py, recorder.as_mut().ok_or_else(no_log)?, world, time)
    }

    /// Writes the remaining data and closes the log. Returns its number of frames.
    fn stop_log(&self, py: Python<'_>) -> PyResult<u64> {
        let recorder = self.lock()?.recorder.take().ok_or_else(no_log)?;
        recording::finish(py, recorder)
    }
}

fn no_log() -> PyErr {
    PhaseError::new_err("log: none is open; call start_log first")
}
