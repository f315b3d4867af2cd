//! Calls of a sealed world: frames.

use crate::arrays::{self, Matrix, WRENCH};
use crate::distance::Distance;
use crate::errors::{bad_value, of_engine};
use crate::frame_report::{self, FrameReport};
use crate::ids::{self, AddedModel, Interface, Object, ObjectRef, Pair};
use crate::model::{surface_from, surface_values};
use crate::pair_monitor::{ContactChange, PairPeaks, no_monitor};
use crate::sealed::{Inner, World};
use crate::setup::WorldBuilder;
use crate::tangents::{self, Tangent};
use crate::{advice, contacts, recording};
use numpy::PyArray1;
use pong_advise::StepPlan;
use pong_engine::{FrictionPreload, PairMonitor};
use pong_record::{RecordOptions, Recorder, WhenFull};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyBytes, PyDict};
use std::path::PathBuf;

#[pymethods]
impl World {
    /// list of Interface : All Interfaces: the rows of `states` and `wrenches`.
    #[getter]
    fn interfaces(&self) -> Vec<Interface> {
        self.interfaces.clone()
    }

    /// list of str : Warnings of the seal: pairs of kinds that meet but have no tester.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// list of str : Notes of the seal.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    /// Tests how long the step of a host may be for the contacts of this world.
    ///
    /// Parameters
    /// ----------
    /// masses : dict[str, dict[str, Any]]
    ///     Entry for each Interface, by name: `mass` (kg), `inertia` (3, 3) (kg·m², about the mass centre), `mass_center`
    ///     (m), both along the axes of the group; on joints also `inverse_inertia` (6, 6), `mechanism`, `spring_rate` (1/s²)
    ///     and `damper_rate` (1/s).
    /// step : float
    ///     Step of the host, s.
    /// coupling : {"stages", "semi_implicit", "zero_order_hold"}, default "stages"
    ///     Use of a wrench by the host's integrator.
    /// delay_frames : int, default 0
    ///     Frames by which a held wrench comes late.
    /// closing_speed : float, optional
    ///     Largest speed at which bodies meet, m/s.
    ///
    /// Returns
    /// -------
    /// dict
    ///     `stable_step` and `surely_stable_step` (s), `warnings`, `notes`, `not_judged`.
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
        let coupling = crate::setup::coupling("coupling", coupling, delay_frames)?;
        let plan = StepPlan { closing_speed, accuracy: None, ..StepPlan::new(step, coupling) };
        advice::step_report(py, &self.lock()?.world, masses, &plan)
    }

    /// list of Object : All Objects.
    #[getter]
    fn objects(&self) -> PyResult<Vec<Object>> {
        ids::objects(self.lock()?.world.scene())
    }

    /// list of Pair : All pairs.
    #[getter]
    fn pairs(&self) -> PyResult<Vec<Pair>> {
        ids::pairs(self.lock()?.world.scene())
    }

    /// list of AddedModel : All models.
    #[getter]
    fn models(&self) -> PyResult<Vec<AddedModel>> {
        let inner = self.lock()?;
        let models = inner.world.scene().models();
        Ok(models.map(|(id, model)| AddedModel { id, name: model.name.clone() }).collect())
    }

    /// int : Most contacts of a frame.
    #[getter]
    fn contact_capacity(&self) -> PyResult<usize> {
        Ok(self.lock()?.world.contact_capacity())
    }

    /// int : Hash of the scene: worlds with equal hashes can exchange contact state.
    #[getter]
    fn scene_hash(&self) -> PyResult<u64> {
        Ok(self.lock()?.world.scene_hash())
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
    ///
    /// Raises
    /// ------
    /// NotFoundError
    ///     No Object or group has this name.
    #[pyo3(signature = (object, path = ""))]
    fn interface(&self, object: ObjectRef<'_>, path: &str) -> PyResult<Interface> {
        let inner = self.lock()?;
        let object = object.resolve(inner.world.scene())?;
        let id = inner.world.scene().interface(object, path).map_err(of_engine)?;
        ids::interface(inner.world.scene(), id)
    }

    /// Finds the name of a primitive by the numbers that contacts give.
    ///
    /// Parameters
    /// ----------
    /// interface : int
    ///     Number of the Interface.
    /// primitive : int
    ///     Number of the primitive in it.
    ///
    /// Returns
    /// -------
    /// str
    ///     `object/path`.
    fn primitive_path(&self, interface: usize, primitive: u32) -> PyResult<String> {
        let Some(id) = self.ids.get(interface) else {
            return Err(ids::no_interface(interface, self.ids.len()));
        };
        let inner = self.lock()?;
        let path = inner.world.scene().primitive_path(*id, primitive).map_err(of_engine)?;
        let object = self.interfaces[interface].name.split('/').next().unwrap_or_default();
        Ok(format!("{object}/{path}"))
    }

    /// Sets the states of all or some Interfaces. If any is refused, none is set.
    ///
    /// Parameters
    /// ----------
    /// states : array_like, shape (n, 13), optional
    ///     Position (3, m), quaternion w, x, y, z (4), velocity of the origin (3, m/s) and angular velocity (3, rad/s) of each
    ///     group in the common frame. An array of float64 is read in place.
    /// position : array_like, shape (n, 3), optional
    ///     Positions of the origins, m, instead of `states`.
    /// orientation : array_like, shape (n, 4), optional
    ///     Unit quaternions (w, x, y, z) that turn axes of the group into common ones; without them groups are unturned.
    /// linear_velocity : array_like, shape (n, 3), optional
    ///     Velocities of the origins, m/s; at rest without them.
    /// angular_velocity : array_like, shape (n, 3), optional
    ///     Angular velocities, rad/s, along the common axes; at rest without them.
    /// interfaces : sequence of Interface, optional
    ///     Interfaces of the rows; all, in the order of `interfaces`, without it.
    ///
    /// Raises
    /// ------
    /// StateError
    ///     A number is not finite, or a quaternion is no unit quaternion.
    /// BadValueError
    ///     An array has another shape, or an Interface is given twice.
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
        let parts = [position, orientation, linear_velocity, angular_velocity];
        arrays::given_states(states, parts, ids, room)?;
        world.set_states(room).map_err(of_engine)
    }

    /// Sets the motions of surfaces along themselves, as of belts and turntables (docs/theory.md, 4). The world must be
    /// built with `moving_surfaces=True`. Set them for each step for which they differ, as states are set.
    ///
    /// Parameters
    /// ----------
    /// motions : array_like, shape (n, 18)
    ///     Linear, angular and belt velocity in the axes of the group, m/s, rad/s and m/s, then their integrals over time.
    /// interfaces : sequence of Interface, optional
    ///     Groups of the rows; all of them without it.
    #[pyo3(signature = (motions, interfaces = None))]
    fn set_surface_motions(
        &self,
        motions: Bound<'_, PyAny>,
        interfaces: Option<Vec<PyRef<'_, Interface>>>,
    ) -> PyResult<()> {
        let chosen = self.chosen(interfaces)?;
        let motions = arrays::surface_motions(&motions, chosen.as_deref().unwrap_or(&self.ids))?;
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        world.set_surface_motions(&motions).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recorder.surfaces_moved(&motions));
        Ok(())
    }

    /// Returns the states as they were set.
    ///
    /// Parameters
    /// ----------
    /// out : ndarray, shape (n, 13), optional
    ///     Array of float64 to write into.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (n, 13)
    ///     `out` or a new array; NaN for states that were never set. Columns as in `set_states`.
    #[pyo3(signature = (out = None))]
    fn states<'py>(&self, py: Python<'py>, out: Option<Bound<'py, PyAny>>) -> PyResult<Matrix<'py>> {
        let inner = self.lock()?;
        arrays::fill(py, out, self.ids.len(), |index| {
            Ok(arrays::state_row(inner.world.state_as_set(self.ids[index]).map_err(of_engine)?))
        })
    }

    /// Computes wrenches from the states and the committed contact state, and changes nothing else.
    ///
    /// Returns
    /// -------
    /// FrameReport
    ///
    /// Raises
    /// ------
    /// StateError
    ///     A state was never set.
    /// NotFiniteError
    ///     A force is beyond what a number holds.
    fn evaluate(&self, py: Python<'_>) -> PyResult<FrameReport> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        let report = py.detach(|| world.evaluate()).map_err(of_engine)?;
        recorder.iter_mut().for_each(Recorder::evaluated);
        Ok(report.into())
    }

    /// Makes the contact state of the last evaluation the committed one.
    ///
    /// Parameters
    /// ----------
    /// pairs : sequence of Pair, optional
    ///     Pairs to commit; all without it.
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
    ///
    /// Returns
    /// -------
    /// FrameReport
    ///
    /// Raises
    /// ------
    /// StateError
    ///     A state was never set.
    /// NotFiniteError
    ///     A force is beyond what a number holds.
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

    /// Returns the contact wrenches of the last frame.
    ///
    /// Parameters
    /// ----------
    /// out : ndarray, shape (n, 6), optional
    ///     Array of float64 to write into.
    /// axes : {"common", "group"}, default "common"
    ///     Axes of the components: those of the common frame, or of each group.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (n, 6)
    ///     `out` or a new array: force (N) and moment (N·m) about the origin of the group, a row for each Interface.
    #[pyo3(signature = (out = None, *, axes = "common"))]
    fn wrenches<'py>(
        &self,
        py: Python<'py>,
        out: Option<Bound<'py, PyAny>>,
        axes: &str,
    ) -> PyResult<Matrix<'py>> {
        let common = arrays::along_common_axes(axes)?;
        let inner = self.lock()?;
        arrays::fill::<WRENCH>(py, out, self.ids.len(), |index| {
            let id = self.ids[index];
            let wrench = if common { inner.world.wrench_common(id) } else { inner.world.wrench(id) };
            Ok(arrays::wrench_row(&wrench.map_err(of_engine)?))
        })
    }

    /// Returns the part of a row of `wrenches` that comes from the contacts with one other group.
    ///
    /// Parameters
    /// ----------
    /// on : Interface
    ///     Group on which the wrench acts.
    /// source : Interface
    ///     Group from which it comes.
    /// axes : {"common", "group"}, default "common"
    ///     Axes of the components.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (6,)
    ///     Force (N) and moment (N·m) about the origin of `on`. Over all sources, these add up to its row of `wrenches`.
    #[pyo3(signature = (on, source, *, axes = "common"))]
    fn wrench_from<'py>(
        &self,
        py: Python<'py>,
        on: &Interface,
        source: &Interface,
        axes: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let common = arrays::along_common_axes(axes)?;
        let inner = self.lock()?;
        let (world, on, from) = (&inner.world, on.id, source.id);
        let wrench = if common { world.wrench_from_common(on, from) } else { world.wrench_from(on, from) };
        Ok(PyArray1::from_slice(py, &arrays::wrench_row(&wrench.map_err(of_engine)?)))
    }

    /// Returns the distance of two movable groups at the states set last; no frame is needed.
    ///
    /// Parameters
    /// ----------
    /// a, b : Interface
    ///     The groups.
    ///
    /// Returns
    /// -------
    /// Distance
    fn distance(&self, a: &Interface, b: &Interface) -> PyResult<Distance> {
        Ok(self.lock()?.world.distance(a.id, b.id).map_err(of_engine)?.into())
    }

    /// Starts to observe pairs, from no contact on; called again, it begins anew.
    fn start_pair_monitor(&self) -> PyResult<()> {
        let mut inner = self.lock()?;
        inner.monitor = Some(PairMonitor::new(&inner.world).map_err(of_engine)?);
        Ok(())
    }

    /// Observes the frame that was committed last: once after each commit.
    ///
    /// Parameters
    /// ----------
    /// step : float
    ///     Time since the commit before, s.
    fn observe_pairs(&self, step: f64) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, monitor, .. } = &mut **inner;
        monitor.as_mut().ok_or_else(no_monitor)?.observe(world, step).map_err(of_engine)
    }

    /// Returns begins and ends of contact in the frame observed last, by pair of Objects and groups.
    ///
    /// Returns
    /// -------
    /// list of ContactChange
    fn contact_changes(&self) -> PyResult<Vec<ContactChange>> {
        let inner = self.lock()?;
        Ok(inner.monitor.as_ref().ok_or_else(no_monitor)?.changes().map(Into::into).collect())
    }

    /// Returns peak and mean of all pairs of groups that touched in the window, or whose contact ended in it.
    ///
    /// Returns
    /// -------
    /// list of PairPeaks
    fn pair_peaks(&self) -> PyResult<Vec<PairPeaks>> {
        let inner = self.lock()?;
        Ok(inner.monitor.as_ref().ok_or_else(no_monitor)?.peaks().map(Into::into).collect())
    }

    /// Begins another window of `pair_peaks`; what touches is kept.
    fn begin_peak_window(&self) -> PyResult<()> {
        self.lock()?.monitor.as_mut().ok_or_else(no_monitor)?.begin_window();
        Ok(())
    }

    /// Returns the wrench of a pair in the last frame, on the Object that was named first in it from the other.
    ///
    /// Parameters
    /// ----------
    /// pair : Pair
    ///     Pair of Objects.
    /// about : Interface
    ///     Group of either Object, about whose origin the moment is taken.
    /// axes : {"common", "group"}, default "common"
    ///     Axes of the components: common, or those of `about`.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (6,)
    ///     Force (N) and moment (N·m).
    #[pyo3(signature = (pair, about, *, axes = "common"))]
    fn pair_wrench<'py>(
        &self,
        py: Python<'py>,
        pair: &Pair,
        about: &Interface,
        axes: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let common = arrays::along_common_axes(axes)?;
        let inner = self.lock()?;
        let (world, pair, about) = (&inner.world, pair.id, about.id);
        let wrench =
            if common { world.pair_wrench_common(pair, about) } else { world.pair_wrench(pair, about) };
        Ok(PyArray1::from_slice(py, &arrays::wrench_row(&wrench.map_err(of_engine)?)))
    }

    /// Returns the contacts of the last frame, in the order of every sum.
    ///
    /// Returns
    /// -------
    /// structured ndarray, shape (k,)
    ///     Rows of `pong.CONTACT_DTYPE`, along the common axes.
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        contacts::array(py, &self.lock()?.world)
    }

    /// Returns the derivatives of each contact's normal force by its depth and by its depth rate.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (k, 2)
    ///     Stiffness (N/m) and damping (N·s/m) in the order of `contacts`; NaN for a normal law of the host.
    fn contact_stiffness<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        contacts::stiffness(py, &self.lock()?.world)
    }

    /// Returns stiffness and damping of each contact, along its normal and of its bristle.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (k, 4)
    ///     Stiffness (N/m) and damping (N·s/m) along the normal, then those of the bristle while it sticks, else 0; in the
    ///     order of `contacts`. NaN for a law of the host, solids, and forces against rolling and spinning.
    fn contact_tangents<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        tangents::of_contacts(py, &self.lock()?.world)
    }

    /// Returns the derivatives of the wrenches of the last frame, between `evaluate` and the commit, for every two groups
    /// that touch (docs/theory.md, 7). The frame stays as it is.
    ///
    /// Parameters
    /// ----------
    /// differences : bool, default False
    ///     Central differences instead of the closed form: for all kinds of contact, and slower.
    ///
    /// Returns
    /// -------
    /// list of Tangent
    ///
    /// Raises
    /// ------
    /// PhaseError
    ///     No frame is evaluated, or it is committed.
    /// BadValueError
    ///     A contact has derivatives that are not known in closed form: use `complete_tangents`.
    #[pyo3(signature = (differences = false))]
    fn tangents(&self, py: Python<'_>, differences: bool) -> PyResult<Vec<Tangent>> {
        tangents::of_frame(py, &mut self.lock()?.world, tangents::all(differences))
    }

    /// Returns the same as `tangents`, by differences for two groups with a contact that has no closed form.
    ///
    /// Returns
    /// -------
    /// list of Tangent
    fn complete_tangents(&self, py: Python<'_>) -> PyResult<Vec<Tangent>> {
        tangents::of_frame(py, &mut self.lock()?.world, pong_engine::World::complete_tangents)
    }

    /// Returns the report of the last frame.
    ///
    /// Returns
    /// -------
    /// FrameReport
    fn report(&self) -> PyResult<FrameReport> {
        Ok(self.lock()?.world.report().into())
    }

    /// Describes a tunnelling event since the last commit.
    ///
    /// Returns
    /// -------
    /// str or None
    ///     The event; None if there was none.
    fn tunnelling(&self) -> PyResult<Option<String>> {
        frame_report::tunnelling(&self.lock()?.world).map_err(of_engine)
    }

    /// Returns the committed contact state.
    ///
    /// Returns
    /// -------
    /// bytes
    ///     The contact state. The states of the groups are the caller's.
    fn save_state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let inner = self.lock()?;
        PyBytes::new_with(py, inner.world.state_used(), |room| {
            inner.world.save_state(room).map_err(of_engine)
        })
    }

    /// Restores a contact state saved by a world built by the same calls.
    ///
    /// Parameters
    /// ----------
    /// block : bytes
    ///     Contact state of `save_state`. Set the states that belong to it afterwards, and evaluate.
    ///
    /// Raises
    /// ------
    /// ContactStateError
    ///     The state is damaged, or of another world.
    fn restore_state(&self, block: &[u8]) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        world.restore_state(block).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recorder.restored(block));
        Ok(())
    }

    /// Returns a builder that begins with everything that this world was made of, and with its states, pairs and surfaces as
    /// they are now: add what arrives, seal, and let the new world `continue_from` this one, which may run on meanwhile.
    ///
    /// Returns
    /// -------
    /// WorldBuilder
    fn extended(&self) -> PyResult<WorldBuilder> {
        let inner = self.lock()?;
        let builder = pong_engine::WorldBuilder::extending(&inner.world);
        Ok(WorldBuilder::new_from(builder, inner.sources.clone(), inner.folders.clone()))
    }

    /// Continues the run of another world, with the states, pairs, surfaces and contact state of the Objects that are in both,
    /// by name.
    ///
    /// Parameters
    /// ----------
    /// other : World
    ///     World whose run goes on.
    ///
    /// Returns
    /// -------
    /// dict[str, float]
    ///     Counts of what continues (`objects`, `pairs`, `contacts`) and of what was left behind (`objects_left`,
    ///     `pairs_left`, `contacts_left`, `energy_left` in J).
    fn continue_from<'py>(slf: &Bound<'py, Self>, other: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        if slf.is(other) {
            let cure = "give the world whose run goes on";
            return Err(bad_value("other", "it is this world itself".to_owned(), cure));
        }
        let (mut inner, other) = (slf.get().lock()?, other.get().lock()?);
        if inner.recorder.is_some() {
            return Err(recording::is_running());
        }
        let of = inner.world.continue_from(&other.world).map_err(of_engine)?;
        frame_report::continued(slf.py(), &of)
    }

    /// Drops the contact state of an Object, after a teleport or a reset.
    ///
    /// Parameters
    /// ----------
    /// object : Object or str
    ///     Object, or its name.
    fn clear_contact_history(&self, object: ObjectRef<'_>) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        let object = object.resolve(world.scene())?;
        world.clear_contact_history(object).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recorder.forgot(object));
        Ok(())
    }

    /// Enables or disables a pair.
    ///
    /// Parameters
    /// ----------
    /// pair : Pair
    ///     Pair of Objects.
    /// enabled : bool
    ///     True if they may touch.
    fn set_pair_enabled(&self, pair: &Pair, enabled: bool) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        world.set_pair_enabled(pair.id, enabled).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recorder.pair_switched(pair.id, enabled));
        Ok(())
    }

    /// Returns the present values of a surface of a model.
    ///
    /// Parameters
    /// ----------
    /// model : AddedModel
    ///     Model of this world.
    /// name : str
    ///     Name of the surface.
    ///
    /// Returns
    /// -------
    /// dict
    ///     `stiffness` (N/m), `normal` and `friction` with their `law`.
    fn surface<'py>(&self, py: Python<'py>, model: &AddedModel, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let inner = self.lock()?;
        surface_values(py, inner.world.surface(model.id, name).map_err(of_engine)?)
    }

    /// Changes values of a surface, for all Objects of the model, from the next evaluation on. Laws may not change.
    ///
    /// Parameters
    /// ----------
    /// model : AddedModel
    ///     Model of this world.
    /// name : str
    ///     Name of the surface.
    /// values : dict
    ///     New values, nested as `surface` gives them; what is left out stays as it is.
    ///
    /// Raises
    /// ------
    /// BadValueError
    ///     A key is no value of this surface, or a value is outside of its range.
    ///
    /// Examples
    /// --------
    /// >>> world.set_surface(world.models[0], "rubber", {"friction": {"mu": 0.2}})
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

    /// Commits, and preloads the bristles of a pair.
    ///
    /// Parameters
    /// ----------
    /// pair : Pair
    ///     Pair of Objects.
    /// holding : array_like, shape (3,), optional
    ///     Force that friction holds on the pair's first Object, N, along the common axes; without it, moving contacts are
    ///     assumed to slide.
    ///
    /// Returns
    /// -------
    /// int
    ///     Number of preloaded bristles.
    #[pyo3(signature = (pair, holding = None))]
    fn preload_friction(&self, pair: &Pair, holding: Option<Bound<'_, PyAny>>) -> PyResult<usize> {
        let preload = match holding {
            Some(force) => FrictionPreload::Holding(arrays::vector::<3>("holding", &force)?.into()),
            None => FrictionPreload::Sliding,
        };
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        let set = world.preload_friction(pair.id, &preload).map_err(of_engine)?;
        recorder.iter_mut().for_each(|recorder| recording::preloaded(recorder, world));
        Ok(set)
    }

    /// Returns the energies of all contacts at the last commit.
    ///
    /// Returns
    /// -------
    /// dict[str, float]
    ///     `stored`, `work` and `dissipated`, J; zero unless the world keeps the ledger.
    fn ledger<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let ledger = self.lock()?.world.ledger();
        [("stored", ledger.stored), ("work", ledger.work), ("dissipated", ledger.dissipated)].into_py_dict(py)
    }

    /// Begins a response log in a folder.
    ///
    /// Parameters
    /// ----------
    /// folder : path_like
    ///     Folder of the log.
    /// name : str, optional
    ///     Name of the run.
    /// step : float, optional
    ///     Step of the host, s.
    /// commits_per_frame : int, optional
    ///     Commits for each frame of the log.
    /// overwrite : bool, default False
    ///     Replaces a log that is in the folder already.
    /// lose : bool, default False
    ///     Loses frames if the disk is too slow, instead of waiting.
    ///
    /// Raises
    /// ------
    /// LogError
    ///     The folder cannot be written, or has a log already.
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
        let when_full = if lose { WhenFull::Lose } else { WhenFull::Wait };
        let options = RecordOptions { name: name.to_owned(), step, ..RecordOptions::default() };
        let options = RecordOptions { commits_per_frame, overwrite, when_full, ..options };
        recording::start(&mut **self.lock()?, folder, options)
    }

    /// Records the frame last computed.
    ///
    /// Parameters
    /// ----------
    /// time : float
    ///     Time of the frame, s.
    fn log_frame(&self, py: Python<'_>, time: f64) -> PyResult<()> {
        let mut inner = self.lock()?;
        let Inner { world, recorder, .. } = &mut **inner;
        recording::record(py, recorder.as_mut().ok_or_else(recording::none)?, world, time)
    }

    /// Writes the remaining data and closes the log.
    ///
    /// Returns
    /// -------
    /// int
    ///     Number of frames in the log.
    fn stop_log(&self, py: Python<'_>) -> PyResult<u64> {
        let recorder = self.lock()?.recorder.take().ok_or_else(recording::none)?;
        recording::finish(py, recorder)
    }
}
