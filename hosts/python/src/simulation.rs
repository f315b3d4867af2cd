//! A scene in the built-in executive.

use crate::arrays::{self, Matrix, STATE};
use crate::contacts;
use crate::dynamics;
use crate::errors::{bad_value, lock, of_engine, of_executive};
use crate::model::{surface_from, surface_values};
use crate::run::{Run, RunLog, Stop, Wanted};
use crate::world::FrameReport;
use pong_executive::scene::BuiltScene;
use pong_executive::{BodyId, Energy};
use pong_geometry::{Pose, Twist, Vec3};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

/// A running scene: its bodies, integrator and world.
///
/// One thread at a time may call it. `step` and `run` release the GIL.
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
    /// Name of the scene.
    #[getter]
    fn name(&self) -> PyResult<String> {
        Ok(self.lock()?.name.clone())
    }

    /// Names of the bodies: the rows of `states` and `wrenches`.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.bodies.clone()
    }

    /// Time, s.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.lock()?.simulation.time())
    }

    /// Step, s.
    #[getter]
    fn step_length(&self) -> PyResult<f64> {
        Ok(self.lock()?.simulation.step_length())
    }

    /// Steps in the duration of the scene.
    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(self.lock()?.steps)
    }

    /// Interval of the scene's records, in steps.
    #[getter]
    fn record_every(&self) -> PyResult<u64> {
        Ok(self.lock()?.record_every)
    }

    /// Integrator, as the scene format spells it.
    #[getter]
    fn integrator(&self) -> PyResult<String> {
        Ok(self.lock()?.simulation.integrator().to_string())
    }

    /// Hash of the world: simulations with equal hashes have the same world.
    #[getter]
    fn scene_hash(&self) -> PyResult<u64> {
        Ok(self.lock()?.simulation.world().scene_hash())
    }

    /// Warnings of `pong run`: models, seal, contacts that gain energy at the step.
    #[getter]
    fn warnings(&self) -> PyResult<Vec<String>> {
        let built = self.lock()?;
        let seal = built.seal.warnings.iter().map(ToString::to_string);
        Ok(built.warnings.iter().cloned().chain(seal).chain(built.simulation.step_warnings()).collect())
    }

    /// Notes about contacts that may gain energy at the step if they act together.
    #[getter]
    fn notes(&self) -> PyResult<Vec<String>> {
        let built = self.lock()?;
        let seal = built.seal.notes.iter().map(ToString::to_string);
        Ok(seal.chain(built.simulation.step_notes()).collect())
    }

    /// States of the bodies: a row of 13 numbers for each.
    #[pyo3(signature = (out = None))]
    fn states<'py>(&self, py: Python<'py>, out: Option<Bound<'py, PyAny>>) -> PyResult<Matrix<'py>> {
        let built = self.lock()?;
        let simulation = &built.simulation;
        arrays::fill(py, out, self.ids.len(), |index| {
            Ok(arrays::motion_row(&simulation.pose(self.ids[index]), &simulation.twist(self.ids[index])))
        })
    }

    /// Contact wrenches on the bodies along the common axes: a row (force, moment about the group's origin) for each.
    #[pyo3(signature = (out = None))]
    fn wrenches<'py>(&self, py: Python<'py>, out: Option<Bound<'py, PyAny>>) -> PyResult<Matrix<'py>> {
        let built = self.lock()?;
        let wrench = |index: usize| built.simulation.contact_wrench(self.ids[index]);
        arrays::fill(py, out, self.ids.len(), |index| Ok(arrays::wrench_row(&wrench(index))))
    }

    /// Contacts of the present instant: a structured array of `pong.CONTACT_DTYPE`.
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        contacts::array(py, self.lock()?.simulation.world())
    }

    /// Stiffness (N/m) and damping (N·s/m) of each contact along its normal, in the order of `contacts`.
    fn contact_stiffness<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        contacts::stiffness(py, self.lock()?.simulation.world())
    }

    /// Report of the last frame.
    fn report(&self) -> PyResult<FrameReport> {
        Ok(self.lock()?.simulation.world().report().into())
    }

    /// Energies of the present instant, J, by name.
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        energies(py, &self.lock()?.simulation.energy())
    }

    /// Moves free or fixed bodies: a row of 13 numbers for each named body. The contact history stays.
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

    /// Sets gravity, m/s², along the common axes.
    fn set_gravity(&self, gravity: Bound<'_, PyAny>) -> PyResult<()> {
        let gravity = arrays::vector::<3>("gravity", &gravity)?;
        if let Some(value) = gravity.iter().find(|value| !value.is_finite()) {
            return Err(bad_value("gravity", format!("it holds {value}"), "give finite numbers"));
        }
        self.lock()?.simulation.set_gravity(gravity.into());
        Ok(())
    }

    /// Gravity, m/s², along the common axes.
    #[getter]
    fn gravity(&self) -> PyResult<(f64, f64, f64)> {
        let gravity = self.lock()?.simulation.gravity();
        Ok((gravity.x, gravity.y, gravity.z))
    }

    /// Mass, inertia and mass centre of a free body, by their names.
    fn mass<'py>(&self, py: Python<'py>, body: &str) -> PyResult<Bound<'py, PyDict>> {
        let id = self.body(body)?;
        dynamics::mass(py, &self.lock()?.simulation, id)
    }

    /// Replaces mass, inertia and mass centre of a free body. Its pose and velocities stay.
    fn set_mass(&self, body: &str, values: &Bound<'_, PyDict>) -> PyResult<()> {
        let id = self.body(body)?;
        dynamics::set_mass(&mut self.lock()?.simulation, id, values)
    }

    /// Number of springs; they are numbered from 0 in the order of the scene.
    #[getter]
    fn springs(&self) -> PyResult<usize> {
        Ok(self.lock()?.simulation.springs().len())
    }

    /// Stiffness, damping and preload of a spring, by their names.
    fn spring<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyDict>> {
        dynamics::spring(py, &self.lock()?.simulation, number)
    }

    /// Replaces stiffness, damping and preload of a spring. Its ends and its rest pose stay.
    fn set_spring(&self, number: usize, values: &Bound<'_, PyDict>) -> PyResult<()> {
        dynamics::set_spring(&mut self.lock()?.simulation, number, values)
    }

    /// Names of the models.
    #[getter]
    fn models(&self) -> PyResult<Vec<String>> {
        Ok(self.lock()?.simulation.world().scene().models().map(|(_, model)| model.name.clone()).collect())
    }

    /// Present values of a surface of a model, by name.
    fn surface<'py>(&self, py: Python<'py>, model: &str, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let built = self.lock()?;
        let world = built.simulation.world();
        let id = model_id(world, model)?;
        surface_values(py, world.surface(id, name).map_err(of_engine)?)
    }

    /// Replaces the values of a surface. Laws may not change.
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
    #[pyo3(signature = (count = 1))]
    fn step(&self, py: Python<'_>, count: u64) -> PyResult<()> {
        let mut built = self.lock()?;
        let simulation = &mut built.simulation;
        py.detach(|| (0..count).try_for_each(|_| simulation.step())).map_err(of_executive)
    }

    /// Runs, by default to the end of the scene's duration, and keeps every `every`-th instant, by default as
    /// in the scene, and always the first and the last. `log` is a folder for a response log of the same
    /// instants.
    ///
    /// `stop(time, states)` is called at the start and after every `stop_every`-th step; true ends the run there.
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

/// Energies by name.
pub(crate) fn energies<'py>(py: Python<'py>, energy: &Energy) -> PyResult<Bound<'py, PyDict>> {
    let terms = [
        ("kinetic", energy.kinetic),
        ("potential", energy.potential),
        ("springs", energy.springs),
        ("contacts", energy.contacts),
        ("contact_loss", energy.contact_loss),
        ("spring_loss", energy.spring_loss),
        ("work_in", energy.work_in),
        ("balance", energy.balance()),
    ];
    terms.into_py_dict(py)
}
