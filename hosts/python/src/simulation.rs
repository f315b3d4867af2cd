//! A scene in the built-in executive.

use crate::arrays::{self, Matrix, STATE};
use crate::contacts;
use crate::dynamics;
use crate::errors::{bad_value, lock, of_engine, of_executive};
use crate::frame_report::FrameReport;
use crate::model::{surface_from, surface_values};
use crate::run::{Run, RunLog, Stop, Wanted};
use pong_executive::BodyId;
use pong_executive::scene::BuiltScene;
use pong_geometry::{Pose, Twist, Vec3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

/// A running scene: its bodies, integrator and world. `Scene.build` makes it.
///
/// One thread at a time may call it. `step` and `run` release the GIL. A row of a state is position (3, m), quaternion
/// w, x, y, z (4), velocity of the origin (3, m/s) and angular velocity (3, rad/s) in the common frame.
#[pyclass(frozen, module = "pong")]
pub(crate) struct Simulation {
    built: Mutex<Box<BuiltScene>>,
    bodies: Vec<String>,
    ids: Vec<BodyId>,
}

impl Simulation {
    pub(crate) fn new(built: BuiltScene) -> Self {
        let (ids, bodies) = built.simulation.bodies().map(|(id, body)| (id, body.name.clone())).unzip();
        Self { built: Mutex::new(Box::new(built)), bodies, ids }
    }

    fn lock(&self) -> PyResult<MutexGuard<'_, Box<BuiltScene>>> {
        lock("simulation", &self.built, "give each thread a simulation of its own")
    }

    fn body(&self, name: &str) -> PyResult<BodyId> {
        let place = self.bodies.iter().position(|body| body == name);
        place.map(|place| self.ids[place]).ok_or_else(|| {
            let cause = format!("there is no body `{name}`");
            bad_value("body", cause, &format!("name one of: {}", self.bodies.join(", ")))
        })
    }
}

#[pymethods]
impl Simulation {
    /// str : Name of the scene.
    #[getter]
    fn name(&self) -> PyResult<String> {
        Ok(self.lock()?.name.clone())
    }

    /// list of str : Names of the bodies: the rows of `states` and `wrenches`.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.bodies.clone()
    }

    /// float : Time, s.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.lock()?.simulation.time())
    }

    /// float : Step, s.
    #[getter]
    fn step_length(&self) -> PyResult<f64> {
        Ok(self.lock()?.simulation.step_length())
    }

    /// int : Steps in the duration of the scene.
    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(self.lock()?.steps)
    }

    /// int : Interval of the scene's records, in steps.
    #[getter]
    fn record_every(&self) -> PyResult<u64> {
        Ok(self.lock()?.record_every)
    }

    /// str : Integrator, as the scene format spells it.
    #[getter]
    fn integrator(&self) -> PyResult<String> {
        Ok(self.lock()?.simulation.integrator().to_string())
    }

    /// int : Hash of the world: simulations with equal hashes have the same world.
    #[getter]
    fn scene_hash(&self) -> PyResult<u64> {
        Ok(self.lock()?.simulation.world().scene_hash())
    }

    /// list of str : Warnings of `pong run`: models, seal, contacts that gain energy at the step.
    #[getter]
    fn warnings(&self) -> PyResult<Vec<String>> {
        let built = self.lock()?;
        let seal = built.seal.warnings.iter().map(ToString::to_string);
        Ok(built.warnings.iter().cloned().chain(seal).chain(built.simulation.step_warnings()).collect())
    }

    /// list of str : Notes about contacts that may gain energy at the step if they act together.
    #[getter]
    fn notes(&self) -> PyResult<Vec<String>> {
        let built = self.lock()?;
        let seal = built.seal.notes.iter().map(ToString::to_string);
        Ok(seal.chain(built.simulation.step_notes()).collect())
    }

    /// Returns the states of the bodies.
    ///
    /// Parameters
    /// ----------
    /// out : ndarray, shape (n, 13), optional
    ///     Array of float64 to write into.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (n, 13)
    ///     `out` or a new array, a row for each body.
    #[pyo3(signature = (out = None))]
    fn states<'py>(&self, py: Python<'py>, out: Option<Bound<'py, PyAny>>) -> PyResult<Matrix<'py>> {
        let built = self.lock()?;
        let simulation = &built.simulation;
        arrays::fill(py, out, self.ids.len(), |index| {
            Ok(arrays::motion_row(&simulation.pose(self.ids[index]), &simulation.twist(self.ids[index])))
        })
    }

    /// Returns the contact wrenches on the bodies, along the common axes.
    ///
    /// Parameters
    /// ----------
    /// out : ndarray, shape (n, 6), optional
    ///     Array of float64 to write into.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (n, 6)
    ///     `out` or a new array: force (N) and moment (N·m) about the origin of the group, a row for each body.
    #[pyo3(signature = (out = None))]
    fn wrenches<'py>(&self, py: Python<'py>, out: Option<Bound<'py, PyAny>>) -> PyResult<Matrix<'py>> {
        let built = self.lock()?;
        let wrench = |index: usize| built.simulation.contact_wrench(self.ids[index]);
        arrays::fill(py, out, self.ids.len(), |index| Ok(arrays::wrench_row(&wrench(index))))
    }

    /// Returns the contacts of the present instant.
    ///
    /// Returns
    /// -------
    /// structured ndarray, shape (k,)
    ///     Rows of `pong.CONTACT_DTYPE`, along the common axes.
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        contacts::array(py, self.lock()?.simulation.world())
    }

    /// Returns stiffness and damping of each contact along its normal.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (k, 2)
    ///     Stiffness (N/m) and damping (N·s/m) in the order of `contacts`; NaN for a normal law of the host.
    fn contact_stiffness<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        contacts::stiffness(py, self.lock()?.simulation.world())
    }

    /// Returns the report of the last frame.
    ///
    /// Returns
    /// -------
    /// FrameReport
    fn report(&self) -> PyResult<FrameReport> {
        Ok(self.lock()?.simulation.world().report().into())
    }

    /// Returns the energies of the present instant.
    ///
    /// Returns
    /// -------
    /// dict[str, float]
    ///     Energies by name, J.
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        dynamics::energies(py, &self.lock()?.simulation.energy())
    }

    /// Moves free or fixed bodies. The contact history stays.
    ///
    /// Parameters
    /// ----------
    /// states : array_like, shape (n, 13)
    ///     State of each named body. A fixed body gets the pose and stays at rest.
    /// bodies : sequence of str
    ///     Names of the bodies, one for each row.
    ///
    /// Raises
    /// ------
    /// BadValueError
    ///     A body is unknown or given twice, or its row is no state.
    /// RunError
    ///     A body is on a prescribed path.
    fn set_states(&self, states: Bound<'_, PyAny>, bodies: Vec<String>) -> PyResult<()> {
        let rows = arrays::rows("states", &states, bodies.len(), STATE)?;
        let rows = rows.as_array();
        let mut seen = HashSet::new();
        if let Some(twice) = bodies.iter().find(|name| !seen.insert(*name)) {
            return Err(bad_value("bodies", format!("`{twice}` is given twice"), "give each body once"));
        }
        let ids: Vec<BodyId> = bodies.iter().map(|name| self.body(name)).collect::<PyResult<_>>()?;
        if let Some(value) = rows.iter().find(|value| !value.is_finite()) {
            return Err(bad_value("states", format!("they hold {value}"), "give finite numbers"));
        }
        let mut built = self.lock()?;
        for (row, (id, name)) in rows.rows().into_iter().zip(ids.iter().zip(&bodies)) {
            let vector = |from: usize| Vec3::new(row[from], row[from + 1], row[from + 2]);
            let orientation: [f64; 4] = std::array::from_fn(|i| row[3 + i]);
            let norm = orientation.iter().map(|x| x * x).sum::<f64>().sqrt();
            // The tolerance of the engine for a host's states.
            if (norm - 1.0).abs() > 1e-3 {
                let cause = format!("the quaternion of `{name}` has norm {norm}");
                return Err(bad_value("states", cause, "give unit quaternions (w, x, y, z)"));
            }
            let twist = Twist { linear: vector(7), angular: vector(10) };
            let set = built.simulation.set_motion(*id, Pose::new(vector(0), orientation), twist);
            set.map_err(of_executive)?;
        }
        Ok(())
    }

    /// Drops the contact history of all bodies: for a new start, after the bodies were moved to other states.
    fn clear_contact_history(&self) -> PyResult<()> {
        self.lock()?.simulation.clear_contact_history().map_err(of_executive)
    }

    /// Sets gravity.
    ///
    /// Parameters
    /// ----------
    /// gravity : array_like, shape (3,)
    ///     Acceleration along the common axes, m/s².
    fn set_gravity(&self, gravity: Bound<'_, PyAny>) -> PyResult<()> {
        let gravity = arrays::vector::<3>("gravity", &gravity)?;
        if let Some(value) = gravity.iter().find(|value| !value.is_finite()) {
            return Err(bad_value("gravity", format!("it holds {value}"), "give finite numbers"));
        }
        self.lock()?.simulation.set_gravity(gravity.into());
        Ok(())
    }

    /// tuple[float, float, float] : Gravity, m/s², along the common axes.
    #[getter]
    fn gravity(&self) -> PyResult<(f64, f64, f64)> {
        let gravity = self.lock()?.simulation.gravity();
        Ok((gravity.x, gravity.y, gravity.z))
    }

    /// Returns mass, inertia and mass centre of a free body.
    ///
    /// Parameters
    /// ----------
    /// body : str
    ///     Name of the body.
    ///
    /// Returns
    /// -------
    /// dict
    ///     `mass` (kg), `inertia` (3, 3) (kg·m², about the mass centre), `mass_center` (3,) (m), along the axes of the group.
    fn mass<'py>(&self, py: Python<'py>, body: &str) -> PyResult<Bound<'py, PyDict>> {
        let id = self.body(body)?;
        dynamics::mass(py, &self.lock()?.simulation, id)
    }

    /// Replaces mass, inertia and mass centre of a free body. Its pose and velocities stay.
    ///
    /// Parameters
    /// ----------
    /// body : str
    ///     Name of the body.
    /// values : dict
    ///     All values that `mass` gives.
    fn set_mass(&self, body: &str, values: &Bound<'_, PyDict>) -> PyResult<()> {
        let id = self.body(body)?;
        dynamics::set_mass(&mut self.lock()?.simulation, id, values)
    }

    /// int : Number of springs; they are numbered from 0 in the order of the scene.
    #[getter]
    fn springs(&self) -> PyResult<usize> {
        Ok(self.lock()?.simulation.springs().len())
    }

    /// Returns stiffness, damping and preload of a spring.
    ///
    /// Parameters
    /// ----------
    /// number : int
    ///     Number of the spring.
    ///
    /// Returns
    /// -------
    /// dict[str, list[float]]
    ///     `stiffness`, `damping` and `preload`, six numbers each: three translations (N/m, N·s/m, N), then three rotations
    ///     (N·m/rad, N·m·s/rad, N·m).
    fn spring<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyDict>> {
        dynamics::spring(py, &self.lock()?.simulation, number)
    }

    /// Replaces stiffness, damping and preload of a spring. Its ends and its rest pose stay.
    ///
    /// Parameters
    /// ----------
    /// number : int
    ///     Number of the spring.
    /// values : dict
    ///     All values that `spring` gives.
    fn set_spring(&self, number: usize, values: &Bound<'_, PyDict>) -> PyResult<()> {
        dynamics::set_spring(&mut self.lock()?.simulation, number, values)
    }

    /// list of str : Names of the models.
    #[getter]
    fn models(&self) -> PyResult<Vec<String>> {
        Ok(self.lock()?.simulation.world().scene().models().map(|(_, model)| model.name.clone()).collect())
    }

    /// Returns the present values of a surface of a model.
    ///
    /// Parameters
    /// ----------
    /// model : str
    ///     Name of the model.
    /// name : str
    ///     Name of the surface.
    ///
    /// Returns
    /// -------
    /// dict
    ///     `stiffness` (N/m), `normal` and `friction` with their `law`.
    fn surface<'py>(&self, py: Python<'py>, model: &str, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let built = self.lock()?;
        let world = built.simulation.world();
        let id = model_id(world, model)?;
        surface_values(py, world.surface(id, name).map_err(of_engine)?)
    }

    /// Changes values of a surface. Laws may not change.
    ///
    /// Parameters
    /// ----------
    /// model : str
    ///     Name of the model.
    /// name : str
    ///     Name of the surface.
    /// values : dict
    ///     New values, nested as `surface` gives them; what is left out stays as it is.
    ///
    /// Raises
    /// ------
    /// BadValueError
    ///     A key is no value of this surface, or a value is outside of its range.
    fn set_surface(
        &self,
        py: Python<'_>,
        model: &str,
        name: &str,
        values: &Bound<'_, PyDict>,
    ) -> PyResult<()> {
        let mut built = self.lock()?;
        let id = model_id(built.simulation.world(), model)?;
        let known = built.simulation.world().surface(id, name).map_err(of_engine)?;
        let surface = surface_from(py, known, values)?;
        let set = built.simulation.world_mut().set_surface(id, &surface);
        set.map_err(of_engine)
    }

    /// Advances by some steps.
    ///
    /// Parameters
    /// ----------
    /// count : int, default 1
    ///     Number of steps.
    ///
    /// Raises
    /// ------
    /// RunError
    ///     The run diverges.
    #[pyo3(signature = (count = 1))]
    fn step(&self, py: Python<'_>, count: u64) -> PyResult<()> {
        let mut built = self.lock()?;
        let simulation = &mut built.simulation;
        py.detach(|| (0..count).try_for_each(|_| simulation.step())).map_err(of_executive)
    }

    /// Runs, by default to the end of the scene's duration.
    ///
    /// Parameters
    /// ----------
    /// steps : int, optional
    ///     Number of steps.
    /// every : int, optional
    ///     Interval of the kept instants in steps, by default that of the scene. The first and the last are always kept.
    /// log : path_like, optional
    ///     Folder for a response log of the same instants.
    /// overwrite : bool, default False
    ///     Replaces a log that is in the folder already.
    /// stop : Callable[[float, ndarray], object], optional
    ///     Function of the time (s) and the states (n, 13), called at the start and after every `stop_every`-th step; true
    ///     ends the run there. It must not call the simulation.
    /// stop_every : int, default 1
    ///     Interval of its calls, in steps.
    ///
    /// Returns
    /// -------
    /// Run
    ///
    /// Raises
    /// ------
    /// RunError
    ///     The run diverges.
    /// LogError
    ///     The log cannot be written.
    #[pyo3(signature = (steps = None, *, every = None, log = None, overwrite = false, stop = None, stop_every = 1))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn run(
        &self,
        py: Python<'_>,
        steps: Option<u64>,
        every: Option<u64>,
        log: Option<PathBuf>,
        overwrite: bool,
        stop: Option<Py<PyAny>>,
        stop_every: u64,
    ) -> PyResult<Run> {
        let mut built = self.lock()?;
        let every = every.unwrap_or(built.record_every);
        for (name, value) in [("every", every), ("stop_every", stop_every)] {
            if value == 0 {
                let cure = "give the number of steps between instants, at least 1";
                return Err(bad_value(name, "it is 0", cure));
            }
        }
        let left = built.steps.saturating_sub(steps_done(&built));
        let wanted = Wanted {
            steps: steps.unwrap_or(left),
            every,
            log: log.map(|folder| RunLog { folder, overwrite }),
            stop: stop.map(|asked| Stop { asked, every: stop_every }),
        };
        Run::of(py, &mut built, &wanted, &self.bodies)
    }
}

/// Steps since the start, at the present step.
fn steps_done(built: &BuiltScene) -> u64 {
    (built.simulation.time() / built.simulation.step_length()).round() as u64
}

fn model_id(world: &pong_engine::World, name: &str) -> PyResult<pong_engine::ModelId> {
    let found = world.scene().models().find(|(_, model)| model.name == name).map(|(id, _)| id);
    found.ok_or_else(|| {
        let known: Vec<String> = world.scene().models().map(|(_, model)| model.name.clone()).collect();
        let cure = format!("name one of: {}", known.join(", "));
        bad_value("model", format!("there is no model `{name}`"), &cure)
    })
}
