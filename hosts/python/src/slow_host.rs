//! Slow hosts, as Python sees them: wrenches for hosts that call once in a long frame.

use crate::arrays::{self, Matrix, STATE, WRENCH};
use crate::errors::{BadValueError, ContactStateError, PhaseError, lock, of_engine};
use crate::ids::Interface;
use crate::sealed::World;
use pong_engine::{InterfaceId, State};
use pong_slow::{Coupling, Dynamics, GroupInput, Report, Settings, SlowError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::{Mutex, MutexGuard};

/// Numbers of a difference from the prediction: position, rotation, velocity, angular velocity, energy.
const DIFFERENCE: usize = 13;

/// Contact for a host that calls once in a long frame and holds the wrench: a clone of a world, in which copies of the bodies
/// follow the contacts with short substeps (docs/slow_hosts.md).
///
/// The host tells once how each movable group answers an impulse, with `free`, `jointed` or `prescribed`, and again where
/// that changes; then it calls `step` each frame and holds `wrenches`. Rows of arrays are in the order of
/// `World.interfaces`. Later changes of the world do not reach the slow host.
///
/// Parameters
/// ----------
/// world : World
///     World to clone, with its contact state.
/// theta : float, optional
///     Position rule of the host, x₁ = x₀ + T·v₀ + θ·T²·a: 1 for semi-implicit Euler, 0.5 for Runge-Kutta with the wrench held, 0
///     for explicit Euler.
/// substeps_per_radian : float, optional
///     Substeps per radian of the fastest vibration on the contacts, 2 to 1e6.
/// substeps_max : int, optional
///     Largest number of substeps in a frame; it bounds the time of a frame.
/// delay_frames : int, optional
///     Whole frames by which the host applies the wrench later than it could.
///
/// Raises
/// ------
/// BadValueError
///     A setting is out of its range.
///
/// Examples
/// --------
/// >>> builder = pong.WorldBuilder()
/// >>> ball = builder.create_object(builder.add_model(pong.load_model("ball.ron")), "ball")
/// >>> ground = builder.create_object(builder.add_model(pong.load_model("ground.ron")), "ground")
/// >>> pair = builder.pair(ball, ground)
/// >>> world = builder.seal()
/// >>> slow = pong.SlowHost(world)
/// >>> slow.free(world.interfaces[0], mass=2.0, inertia=[[8e-3, 0, 0], [0, 8e-3, 0], [0, 0, 8e-3]])
/// >>> slow.prescribed(world.interfaces[1])
/// >>> states = [[0, 0, 0.099019, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0]]
/// >>> report = slow.step(0.05, states, [[0, 0, -9.81, 0, 0, 0], [0, 0, 0, 0, 0, 0]])
/// >>> report.substep_limit
/// False
/// >>> bool(abs(slow.wrenches()[0, 2] - 2.0 * 9.81) < 0.01)
/// True
#[pyclass(frozen, module = "pong")]
pub(crate) struct SlowHost {
    inner: Mutex<Box<Inner>>,
    ids: Vec<InterfaceId>,
}

struct Inner {
    host: pong_slow::SlowHost,
    /// Dynamics of each movable group; `None` until they are given.
    dynamics: Vec<Option<Dynamics>>,
}

#[pymethods]
impl SlowHost {
    #[new]
    #[pyo3(signature = (world, *, theta = 1.0, substeps_per_radian = 12.0, substeps_max = 20_000, delay_frames = 0))]
    fn new(
        world: &World,
        theta: f64,
        substeps_per_radian: f64,
        substeps_max: u32,
        delay_frames: u32,
    ) -> PyResult<Self> {
        let settings = Settings { theta, substeps_per_radian, substeps_max, delay_frames };
        let host = pong_slow::SlowHost::new(&world.lock()?.world, settings).map_err(of_slow)?;
        let dynamics = vec![None; world.ids.len()];
        Ok(Self { inner: Mutex::new(Box::new(Inner { host, dynamics })), ids: world.ids.clone() })
    }

    /// Tells that a movable group is a free rigid body. It holds its wrench along common axes.
    ///
    /// Parameters
    /// ----------
    /// interface : Interface
    ///     The movable group.
    /// mass : float
    ///     Mass, kg.
    /// inertia : array_like, shape (3, 3)
    ///     Inertia about the mass centre along the axes of the group, kg·m².
    /// mass_center : array_like, shape (3,), optional
    ///     Mass centre in the group frame, m; the origin without it.
    #[pyo3(signature = (interface, mass, inertia, mass_center = None))]
    fn free(
        &self,
        interface: PyRef<'_, Interface>,
        mass: f64,
        inertia: &Bound<'_, PyAny>,
        mass_center: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let mass_center = mass_center.map_or(Ok([0.0; 3]), |given| arrays::vector("mass_center", given))?;
        let inertia = square("inertia", inertia)?;
        self.set(&interface, Dynamics::Free { mass, inertia, mass_center })
    }

    /// Tells how a movable group that joints hold answers an impulse, at its present pose. It holds its wrench along its own
    /// axes.
    ///
    /// Parameters
    /// ----------
    /// interface : Interface
    ///     The movable group.
    /// mobility : array_like, shape (6, 6)
    ///     Velocity of the group's origin (m/s, rad/s) per impulse (N·s, N·m·s about the origin) as the joints let it move, along
    ///     the axes of the group: J·M⁻¹·Jᵀ. Symmetric, without negative eigenvalues.
    fn jointed(&self, interface: PyRef<'_, Interface>, mobility: &Bound<'_, PyAny>) -> PyResult<()> {
        let mobility = square("mobility", mobility)?;
        self.set(&interface, Dynamics::Jointed { mobility })
    }

    /// Tells how impulses on some jointed groups move others, because joints connect them. The couplings replace those of the
    /// last call; without a coupling, two groups do not move by the impulses of each other.
    ///
    /// Parameters
    /// ----------
    /// couplings : sequence of tuple[Interface, Interface, array_like]
    ///     The group that moves, the group that gets the impulse, and (6, 6) the velocity of the origin of the first, along its axes, per
    ///     impulse on the second about its origin, along the axes of the second: Jᵢ·M⁻¹·Jⱼᵀ. One direction is enough.
    ///
    /// Raises
    /// ------
    /// BadValueError
    ///     A group is coupled with itself, two are coupled twice, or a number is not finite. The couplings stay as they were.
    fn couplings(
        &self,
        couplings: Vec<(PyRef<'_, Interface>, PyRef<'_, Interface>, Bound<'_, PyAny>)>,
    ) -> PyResult<()> {
        let coupling =
            |(of, by, mobility): &(PyRef<'_, Interface>, PyRef<'_, Interface>, Bound<'_, PyAny>)| {
                Ok(Coupling { of: of.id, by: by.id, mobility: square("mobility", mobility)? })
            };
        let couplings = couplings.iter().map(coupling).collect::<PyResult<Vec<_>>>()?;
        self.lock()?.host.set_couplings(&couplings).map_err(of_slow)
    }

    /// Tells that contact does not move a movable group: the ground, or a body on a prescribed path.
    ///
    /// Parameters
    /// ----------
    /// interface : Interface
    ///     The movable group.
    fn prescribed(&self, interface: PyRef<'_, Interface>) -> PyResult<()> {
        self.set(&interface, Dynamics::Prescribed)
    }

    /// Computes the wrenches to hold over a frame. It affects no later evaluate or commit. After a refused call there is no frame
    /// to commit.
    ///
    /// Parameters
    /// ----------
    /// length : float
    ///     Time until the next call, s.
    /// states : array_like, shape (n, 13)
    ///     States of all movable groups at the start of the frame, as for `World.set_states`.
    /// accelerations : array_like, shape (n, 6)
    ///     Accelerations without contact along common axes: linear (m/s²; of the mass centre of a free body, otherwise of the
    ///     origin), then angular (rad/s²). Gravity, thrusters and forces of joints are in it.
    ///
    /// Returns
    /// -------
    /// SlowReport
    ///
    /// Raises
    /// ------
    /// BadValueError
    ///     The length is not positive, a group has no dynamics yet, or a mass, an inertia or a mobility is not positive.
    /// StateError
    ///     A state is not finite or its quaternion not of unit length.
    fn evaluate(
        &self,
        py: Python<'_>,
        length: f64,
        states: &Bound<'_, PyAny>,
        accelerations: &Bound<'_, PyAny>,
    ) -> PyResult<SlowReport> {
        self.frame(py, length, states, accelerations, false)
    }

    /// Accepts the frame that was evaluated last: the only call that changes what is kept between frames.
    ///
    /// Raises
    /// ------
    /// PhaseError
    ///     There is no such frame.
    fn commit(&self) -> PyResult<()> {
        self.lock()?.host.commit().map_err(of_slow)
    }

    /// Evaluates and commits; parameters and errors of `evaluate`.
    ///
    /// Parameters
    /// ----------
    /// length : float
    ///     Time until the next call, s.
    /// states : array_like, shape (n, 13)
    ///     States of all movable groups.
    /// accelerations : array_like, shape (n, 6)
    ///     Accelerations without contact.
    ///
    /// Returns
    /// -------
    /// SlowReport
    fn step(
        &self,
        py: Python<'_>,
        length: f64,
        states: &Bound<'_, PyAny>,
        accelerations: &Bound<'_, PyAny>,
    ) -> PyResult<SlowReport> {
        self.frame(py, length, states, accelerations, true)
    }

    /// Returns the wrenches to hold over the last frame, about the origin of each movable group.
    ///
    /// Parameters
    /// ----------
    /// axes : {"common", "group"}, optional
    ///     Axes of the components: "common" for free bodies, "group" for jointed ones.
    /// out : ndarray, shape (n, 6), optional
    ///     Array of float64 to write into and to return; a new one without it.
    ///
    /// Returns
    /// -------
    /// ndarray
    ///     Force (3, N) and moment (3, N·m) of each Interface.
    ///
    /// Raises
    /// ------
    /// PhaseError
    ///     There was no frame yet.
    #[pyo3(signature = (axes = "common", out = None))]
    fn wrenches<'py>(
        &self,
        py: Python<'py>,
        axes: &str,
        out: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Matrix<'py>> {
        let common = arrays::along_common_axes(axes)?;
        let host = &self.lock()?.host;
        arrays::fill::<WRENCH>(py, out, self.ids.len(), |index| {
            let id = self.ids[index];
            let wrench = if common { host.wrench_common(id) } else { host.wrench(id) };
            Ok(arrays::wrench_row(&wrench.map_err(of_slow)?))
        })
    }

    /// Returns all that is kept between frames, the contact state and the wrenches on their way included.
    ///
    /// Returns
    /// -------
    /// bytes
    fn save_state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.lock()?.host.save_state()))
    }

    /// Restores what `save_state` returned.
    ///
    /// Parameters
    /// ----------
    /// block : bytes
    ///     State of this slow host or of one whose world was built by the same calls.
    ///
    /// Raises
    /// ------
    /// ContactStateError
    ///     The state is damaged, or of another scene; nothing was restored.
    fn restore_state(&self, block: &[u8]) -> PyResult<()> {
        self.lock()?.host.restore_state(block).map_err(of_slow)
    }

    fn __repr__(&self) -> String {
        format!("<pong.SlowHost of {} Interfaces>", self.ids.len())
    }
}

impl SlowHost {
    fn lock(&self) -> PyResult<MutexGuard<'_, Box<Inner>>> {
        lock("slow host", &self.inner, "give each thread a slow host of its own, or wait for the other call")
    }

    fn set(&self, interface: &Interface, dynamics: Dynamics) -> PyResult<()> {
        let inner = &mut **self.lock()?;
        // Refuses Interfaces of other worlds.
        inner.host.world().state_as_set(interface.id).map_err(of_engine)?;
        inner.dynamics[interface.id.index()] = Some(dynamics);
        Ok(())
    }

    fn frame(
        &self,
        py: Python<'_>,
        length: f64,
        states: &Bound<'_, PyAny>,
        accelerations: &Bound<'_, PyAny>,
        commit: bool,
    ) -> PyResult<SlowReport> {
        let count = self.ids.len();
        let states = arrays::rows("states", states, count, STATE)?;
        let accelerations = arrays::rows("accelerations", accelerations, count, 6)?;
        let inner = &mut **self.lock()?;
        let Inner { host, dynamics } = inner;
        host.discard();
        let mut given: Vec<(InterfaceId, State)> = Vec::with_capacity(count);
        arrays::states(&states.as_array(), &self.ids, &mut given);
        let input =
            |((interface, state), row): (&(InterfaceId, State), numpy::ndarray::ArrayView1<'_, f64>)| {
                // A group without dynamics is left out, and named as missing.
                dynamics[interface.index()].map(|dynamics| GroupInput {
                    interface: *interface,
                    state: *state,
                    dynamics,
                    linear_acceleration: [row[0], row[1], row[2]],
                    angular_acceleration: [row[3], row[4], row[5]],
                })
            };
        let inputs: Vec<GroupInput> =
            given.iter().zip(accelerations.as_array().rows()).filter_map(input).collect();
        let report = py.detach(|| {
            if commit { host.step(length, &inputs) } else { host.evaluate(length, &inputs) }.cloned()
        });
        Ok(SlowReport(report.map_err(of_slow)?))
    }
}

/// Report of a frame of a slow host.
#[pyclass(frozen, eq, module = "pong.types")]
#[derive(Clone, PartialEq)]
pub(crate) struct SlowReport(Report);

#[pymethods]
impl SlowReport {
    /// int : Substeps taken.
    #[getter]
    fn substeps(&self) -> u32 {
        self.0.substeps
    }

    /// int : Substeps that the contacts need.
    #[getter]
    fn substeps_wanted(&self) -> u32 {
        self.0.substeps_wanted
    }

    /// int : Evaluations of the engine, those of the substeps included.
    #[getter]
    fn evaluations(&self) -> u32 {
        self.0.evaluations
    }

    /// int : Contacts of the copies at the end of the frame.
    #[getter]
    fn contacts(&self) -> u32 {
        self.0.contacts
    }

    /// float : Largest rate of the contacts in the frame, rad/s; 0 if nothing touched.
    #[getter]
    fn rate(&self) -> f64 {
        self.0.rate
    }

    /// float or None : θ as the motion since the last frame shows it; None without acceleration.
    #[getter]
    fn theta_measured(&self) -> Option<f64> {
        self.0.theta_measured
    }

    /// float : Energy that differences between motion and prediction inserted, J: the sum of the last column of `differences`.
    #[getter]
    fn inserted(&self) -> f64 {
        self.0.inserted
    }

    /// int : Incomplete or missed parts of any substep, as the bits of `pong.Status`.
    #[getter]
    fn status(&self) -> u32 {
        self.0.status.engine.bits()
    }

    /// bool : The contacts needed more substeps than `substeps_max`.
    #[getter]
    fn substep_limit(&self) -> bool {
        self.0.status.substep_limit
    }

    /// bool : The substeps were too few to follow the contacts at all: the wrench is that of one implicit step, without rebound
    /// and without gain of energy.
    #[getter]
    fn unresolved(&self) -> bool {
        self.0.status.unresolved
    }

    /// bool : A body left what it touched and touched something else within the frame.
    #[getter]
    fn met_another(&self) -> bool {
        self.0.status.met_another
    }

    /// bool : θ as measured differs from the setting by more than 0.1: energy is gained without bound.
    #[getter]
    fn theta_mismatch(&self) -> bool {
        self.0.status.theta_mismatch
    }

    /// bool : The velocity nearest to the copies would have had too much energy, and was reduced.
    #[getter]
    fn energy_limited(&self) -> bool {
        self.0.status.energy_limited
    }

    /// ndarray : Shape (n, 13): found minus predicted leading position (3, m), orientation as a rotation vector (3, rad), velocity
    /// (3, m/s) and angular velocity (3, rad/s), and the energy that this inserted (1, J), of each Interface: of the mass centre
    /// of a free body along common axes, of the origin of a jointed one along its own axes.
    #[getter]
    fn differences<'py>(&self, py: Python<'py>) -> PyResult<Matrix<'py>> {
        arrays::fill::<DIFFERENCE>(py, None, self.0.groups.len(), |index| {
            let group = &self.0.groups[index];
            let parts =
                [group.position, group.rotation, group.linear_velocity, group.angular_velocity].into_iter();
            let mut numbers = parts.flatten().chain([group.inserted]);
            Ok(std::array::from_fn(|_| numbers.next().expect("13 numbers")))
        })
    }

    fn __repr__(&self) -> String {
        let Report { substeps, substeps_wanted, inserted, .. } = &self.0;
        format!("<pong.SlowReport {substeps} of {substeps_wanted} substeps, {inserted} J inserted>")
    }
}

/// A square matrix of numbers.
fn square<const N: usize>(thing: &str, given: &Bound<'_, PyAny>) -> PyResult<[[f64; N]; N]> {
    let rows = arrays::rows(thing, given, N, N)?;
    let view = rows.as_array();
    Ok(std::array::from_fn(|row| std::array::from_fn(|column| view[[row, column]])))
}

/// The exception of an error of a slow host.
fn of_slow(error: SlowError) -> PyErr {
    let text = error.to_string();
    match error {
        SlowError::Engine(error) => of_engine(error),
        SlowError::BadSetting { .. } | SlowError::BadInput { .. } => BadValueError::new_err(text),
        SlowError::WrongPhase { .. } => PhaseError::new_err(text),
        SlowError::BadState { .. } => ContactStateError::new_err(text),
    }
}
