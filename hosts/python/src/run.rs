//! A run of a scene: its instants as arrays, its peaks, its log.

use crate::arrays::{STATE, WRENCH, motion_row, wrench_row};
use crate::dynamics::energies;
use crate::errors::{of_executive, of_log};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pong_executive::scene::BuiltScene;
use pong_executive::{RunStatistics, Simulation};
use pong_record::{EnergyRow, LogError, ModelSource, RecordOptions, Recorder};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Polling interval of a long run for interruptions.
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// Result of a run: instants that were kept, and peaks over every step.
#[pyclass(frozen, module = "pong.types", get_all)]
pub(crate) struct Run {
    /// list of str : Names of the bodies.
    bodies: Vec<String>,
    /// ndarray, shape (k,) : Times of the instants, s.
    time: Py<PyAny>,
    /// ndarray, shape (k, n, 13) : States at the instants, in the common frame: position, quaternion w, x, y, z, velocities.
    states: Py<PyAny>,
    /// ndarray, shape (k, n, 6) : Contact wrenches at the instants along the common axes: force, N, and moment, N·m.
    wrenches: Py<PyAny>,
    /// NDArray[np.uint64], shape (k,) : Number of contacts at the instants.
    contacts: Py<PyAny>,
    /// ndarray, shape (n,) : Largest contact force of each body over all steps, N.
    peak_force: Py<PyAny>,
    /// ndarray, shape (n,) : Largest contact moment, N·m.
    peak_moment: Py<PyAny>,
    /// ndarray, shape (n,) : Largest depth, m.
    peak_depth: Py<PyAny>,
    /// ndarray, shape (n, 3) : ∫ contact force dt of each body, N·s.
    impulse: Py<PyAny>,
    /// int : Most contacts at once.
    most_contacts: usize,
    /// dict[str, float] : Energies at the end, J, by name.
    energy: Py<PyDict>,
    /// float : Largest deviation of the energy balance from its first value, J, by the ledger.
    worst_balance: f64,
    /// int : Steps in which a primitive tunnelled through another.
    tunnelled: u64,
    /// int : Steps in which a solid was deeper in a mesh than the regions below its facets.
    deep_in_mesh: u64,
    /// list of str : Warnings of `pong run` after a run.
    warnings: Vec<String>,
    /// bool : True if `stop` ended it.
    stopped: bool,
}

/// Options of a run.
pub(crate) struct Wanted {
    pub steps: u64,
    /// Interval of the kept instants, in steps.
    pub every: u64,
    pub log: Option<RunLog>,
    pub stop: Option<Stop>,
}

/// A condition of the caller that ends a run.
pub(crate) struct Stop {
    /// Callable of the time and the states; true ends the run.
    pub asked: Py<PyAny>,
    /// Interval of its calls, in steps.
    pub every: u64,
}

/// Options of a log.
pub(crate) struct RunLog {
    pub folder: PathBuf,
    pub overwrite: bool,
}

/// Kept instants.
#[derive(Default)]
struct Kept {
    time: Vec<f64>,
    states: Vec<f64>,
    wrenches: Vec<f64>,
    contacts: Vec<u64>,
    stopped: bool,
}

impl Kept {
    fn keep(&mut self, simulation: &Simulation) {
        self.time.push(simulation.time());
        self.states.extend(state_rows(simulation));
        for (id, _) in simulation.bodies() {
            self.wrenches.extend(wrench_row(&simulation.contact_wrench(id)));
        }
        self.contacts.push(simulation.world().contact_count() as u64);
    }
}

/// A row of 13 numbers for each body, one after the other.
fn state_rows(simulation: &Simulation) -> impl Iterator<Item = f64> {
    simulation.bodies().flat_map(|(id, _)| motion_row(&simulation.pose(id), &simulation.twist(id)))
}

impl Stop {
    /// Tests whether the run ends here.
    fn ends(&self, simulation: &Simulation) -> PyResult<bool> {
        Python::attach(|py| {
            let bodies = simulation.bodies().len();
            let states = PyArray1::from_iter(py, state_rows(simulation)).reshape([bodies, STATE])?;
            self.asked.bind(py).call1((simulation.time(), states))?.is_truthy()
        })
    }
}

impl Run {
    /// Runs some steps.
    pub fn of(py: Python<'_>, built: &mut BuiltScene, wanted: &Wanted, bodies: &[String]) -> PyResult<Self> {
        let done = py.detach(|| {
            let log = wanted.log.as_ref();
            let mut recorder = log.map(|log| start_log(built, log, wanted.every)).transpose()?;
            let done = advance(built, wanted, recorder.as_mut());
            // The records before a failure help to find its cause.
            let closed = recorder.map_or(Ok(()), |log| log.finish().map(|_| ()).map_err(of_log));
            let done = done?;
            closed.map(|()| done)
        });
        let (kept, statistics) = done?;
        Self::told(py, kept, &statistics, bodies, built)
    }

    fn told(
        py: Python<'_>,
        kept: Kept,
        statistics: &RunStatistics,
        bodies: &[String],
        built: &BuiltScene,
    ) -> PyResult<Self> {
        let (instants, count) = (kept.time.len(), bodies.len());
        let of_bodies = |value: &dyn Fn(&pong_executive::BodyStatistics) -> f64| {
            PyArray1::from_iter(py, statistics.bodies.iter().map(value)).into_any().unbind()
        };
        let cube = |values: Vec<f64>, width| -> PyResult<Py<PyAny>> {
            Ok(PyArray1::from_vec(py, values).reshape([instants, count, width])?.into_any().unbind())
        };
        let impulses: Vec<Vec<f64>> =
            statistics.bodies.iter().map(|body| body.impulse.as_slice().to_vec()).collect();
        let impulse = PyArray2::from_vec2(py, &impulses).expect("an impulse has three components");
        let warnings = built.simulation.energy_warnings().into_iter().chain(statistics.advice());
        Ok(Self {
            bodies: bodies.to_vec(),
            time: PyArray1::from_vec(py, kept.time).into_any().unbind(),
            states: cube(kept.states, STATE)?,
            wrenches: cube(kept.wrenches, WRENCH)?,
            contacts: PyArray1::from_vec(py, kept.contacts).into_any().unbind(),
            peak_force: of_bodies(&|body| body.peak_force),
            peak_moment: of_bodies(&|body| body.peak_moment),
            peak_depth: of_bodies(&|body| body.peak_depth),
            impulse: impulse.into_any().unbind(),
            most_contacts: statistics.most_contacts,
            energy: energies(py, &statistics.last_energy)?.unbind(),
            worst_balance: statistics.worst_balance,
            tunnelled: statistics.tunnelled,
            deep_in_mesh: statistics.deep_in_mesh,
            warnings: warnings.collect(),
            stopped: kept.stopped,
        })
    }
}

fn advance(
    built: &mut BuiltScene,
    wanted: &Wanted,
    mut log: Option<&mut Recorder>,
) -> PyResult<(Kept, RunStatistics)> {
    let ledger = built.ledger;
    let simulation = &mut built.simulation;
    simulation.commit_initial_states().map_err(of_executive)?;
    let mut statistics = RunStatistics::new(simulation);
    let mut kept = Kept::default();
    let mut looked = Instant::now();
    for done in 0..=wanted.steps {
        if done > 0 {
            simulation.step().map_err(of_executive)?;
            statistics.observe(simulation);
        }
        let asked = wanted.stop.iter().filter(|stop| done.is_multiple_of(stop.every));
        for stop in asked {
            kept.stopped = stop.ends(simulation)?;
        }
        let due = done.is_multiple_of(wanted.every);
        if due || done == wanted.steps || kept.stopped {
            kept.keep(simulation);
        }
        if let Some(log) = &mut log {
            record(log, simulation, ledger, due).map_err(of_log)?;
        }
        if kept.stopped {
            break;
        }
        if looked.elapsed() > LOOK_EVERY {
            Python::attach(|py| py.check_signals())?;
            looked = Instant::now();
        }
    }
    Ok((kept, statistics))
}

fn start_log(built: &BuiltScene, log: &RunLog, every: u64) -> PyResult<Recorder> {
    let options = RecordOptions {
        name: built.name.clone(),
        writer: concat!("pong for Python ", env!("CARGO_PKG_VERSION")).to_owned(),
        step: Some(built.simulation.step_length()),
        commits_per_frame: Some(every),
        integrator: Some(built.simulation.integrator().to_string()),
        energies: built.ledger,
        overwrite: log.overwrite,
        ..RecordOptions::default()
    };
    let models: Vec<_> = built.model_files.iter().cloned().map(ModelSource::File).collect();
    Recorder::start(built.simulation.world(), &log.folder, &models, &options).map_err(of_log)
}

fn record(log: &mut Recorder, simulation: &Simulation, ledger: bool, wanted: bool) -> Result<(), LogError> {
    log.evaluated();
    log.committed();
    if !wanted {
        return Ok(());
    }
    let e = simulation.energy();
    let energies = ledger.then(|| EnergyRow {
        kinetic: e.kinetic,
        potential: e.potential,
        springs: e.springs,
        contacts: e.contacts,
        contact_loss: e.contact_loss,
        spring_loss: e.spring_loss,
        work_in: e.work_in,
        balance: e.balance(),
    });
    log.record(simulation.world(), simulation.time(), 0, energies.as_ref())
}
