"""Controller of the arm: brakes, joint rate servos, and the law of force-moment accommodation.

    arm = Arm(machine)                 once, after the machine was made
    arm.pose(angles)                   sets a posture at rest
    arm.command("tip", rates=..., push=...)
    machine.run(seconds, arm.control)

States: `brakes` (all brakes on, motors off), `joints` (rates of joints), `tip` (rates of the tip, with accommodation)
and `tripped` (too great a force was measured: brakes on until the next command; while it is felt, only `joints` moves
the arm). Everything that it remembers is in `save()`; a restored controller continues to the same bits.
"""

import copy
from dataclasses import dataclass

import numpy as np

from . import dimensions as d
from . import kinematics
from ..machine import wrenches


@dataclass(frozen=True)
class Law:
    """Rate of the tip = commanded rate + admittance · (measured and commanded force, beyond the dead band).

    Vectors are shortened, never turned: limits and dead bands are those of magnitudes. All values are chosen.
    """

    admittance: float = 1e-4  # m/s of rate for each N beyond the dead band
    admittance_turn: float = 2e-5  # rad/s for each N·m
    band: float = 10.0  # N, dead band
    band_turn: float = 10.0  # N·m
    push: float = 500.0  # N, greatest commanded force
    push_turn: float = 500.0  # N·m
    rate: float = 0.1  # m/s, greatest rate of the tip
    rate_turn: float = 0.03  # rad/s
    trip: float = 1500.0  # N measured at which the brakes come on
    filter: float = 0.05  # s, time constant of the measured force and moment
    period: float = 0.01  # s from one evaluation of the law to the next
    damping: float = 0.05  # of the least squares, as a singular value of the Jacobian

    def answer(self, rates, push, measured):
        """Commanded rates of the tip for the force and moment on it."""
        wanted = np.concatenate([shortened(push[:3], self.push), shortened(push[3:], self.push_turn)])
        felt = measured + wanted
        linear = rates[:3] + self.admittance * beyond(felt[:3], self.band)
        angular = rates[3:] + self.admittance_turn * beyond(felt[3:], self.band_turn)
        return np.concatenate([shortened(linear, self.rate), shortened(angular, self.rate_turn)])


def shortened(vector, greatest):
    length = float(np.linalg.norm(vector))
    return vector * (greatest / length) if length > greatest else vector


def beyond(vector, band):
    """Part of a vector beyond the dead band."""
    length = float(np.linalg.norm(vector))
    return vector * (1.0 - band / length) if length > band else np.zeros(3)


@dataclass
class State:
    mode: str = "brakes"
    rates: np.ndarray = None  # commanded: of the joints (7) or of the tip (6)
    push: np.ndarray = None  # commanded force and moment on what the tip touches
    released: np.ndarray = None  # joints whose brakes are off in the state `joints`
    aim: np.ndarray = None  # angles that the servos are to have
    speed: np.ndarray = None  # rates that the servos are to have
    anchor: np.ndarray = None  # angles at which the brakes have no torque
    felt: np.ndarray = None  # filtered force and moment on the tip, along the axes of the world
    due: int = 0  # evaluations of the law so far


class Arm:
    """`prefix` as given to `body`. `sensed(machine)` may replace the sensor: force and moment on the tip, world.

    `point`: where the law acts, in the frame of the tip: rates and moments are those of this point. `torque`: greatest
    of a motor, N·m.
    """

    def __init__(self, machine, prefix="", law=Law(), sensed=None, point=(0.0, 0.0, 0.0), torque=d.TORQUE):
        self.machine, self.law, self.sensed = machine, law, sensed or self._sensor
        self.point, self.torque = np.array(point), torque
        model = machine.model
        joints = [model.joint(prefix + link.name) for link in d.LINKS]
        self.places = np.array([joint.qposadr[0] for joint in joints])
        self.dofs = np.array([joint.dofadr[0] for joint in joints])
        self.motors = np.array([model.actuator(prefix + link.name).id for link in d.LINKS])
        self.base, self.tip = model.body(prefix + "base").id, model.body(prefix + "tip").id
        self.site = model.site(prefix + "sensor").id
        force, moment = (model.sensor(prefix + name).adr[0] for name in ("force", "moment"))
        self.wrench_at = np.r_[force : force + 3, moment : moment + 3]
        self.carried = [i for i, carrier in enumerate(machine.carriers) if self._carries(carrier)]
        self.carriers = np.array(machine.carriers, int)[self.carried]
        self.state = State()
        self.pose(machine.data.qpos[self.places])

    # --- commands ---------------------------------------------------------------------------------------------------

    def pose(self, angles):
        """Sets the motors to angles, gears without load, the whole arm at rest, brakes on."""
        data = self.machine.data
        data.qpos[self.places], data.qpos[self.places + 1] = angles, 0.0
        data.qvel[self.dofs], data.qvel[self.dofs + 1] = 0.0, 0.0
        self.machine.start()
        zeros = np.zeros(7)
        angles = np.array(angles, float)
        self.state = State(
            "brakes", zeros, np.zeros(6), zeros == 1, angles, zeros, angles.copy(), self.sensed(self.machine)
        )
        self.state.due = round(self.machine.time / self.law.period)

    def command(self, mode, rates=None, push=None, released=None):
        """`joints`: seven rates; brakes of the joints that are not `released` (indices; all) stay on. `tip`: six rates,
        and the force and moment (6) that the tip is to press with."""
        state, now = self.state, self.angles()
        state.mode = mode
        state.rates = np.zeros(7 if mode == "joints" else 6) if rates is None else np.array(rates, float)
        state.push = np.zeros(6) if push is None else np.array(push, float)
        free = np.zeros(7, bool) if mode == "brakes" else np.ones(7, bool)
        if released is not None:
            free = np.isin(np.arange(7), released)
        # An engaging brake grips at its motor's angle; an engaging servo aims there.
        state.anchor = np.where(state.released & ~free, now, state.anchor)
        state.aim = np.where(~state.released & free, now + self._load() / d.SERVO_STIFFNESS, state.aim)
        state.released = free
        state.speed = np.zeros(7)

    # --- one step ---------------------------------------------------------------------------------------------------

    def control(self, machine):
        """Called before each step: for `Machine.advance`, or by another control."""
        if machine.time >= (self.state.due - 1e-6) * self.law.period:
            self.state.due += 1
            self._decide()
        self.state.aim = self.state.aim + machine.step * self.state.speed
        machine.data.ctrl[self.motors] = np.where(self.state.released, self._servo(), self._brake())

    def _decide(self):
        """Runs once per period: state machine, and joint rates."""
        state, law = self.state, self.law
        share = 1.0 - np.exp(-law.period / law.filter)
        state.felt = state.felt + share * (self.sensed(self.machine) - state.felt)
        if state.mode == "tip" and np.linalg.norm(state.felt[:3]) > law.trip:
            self.command("brakes")
            state.mode = "tripped"
        speed = np.zeros(7)
        if state.mode == "joints":
            speed = state.rates * state.released
        elif state.mode == "tip":
            rates = law.answer(state.rates, state.push, state.felt)
            speed = kinematics.resolve(self.jacobian(), rates, law.damping)
        # All joints slow down together, which preserves the tip's direction.
        fastest = np.abs(speed).max()
        state.speed = speed * (d.SPEED / fastest) if fastest > d.SPEED else speed

    def _servo(self):
        state, limit = self.state, self.torque / d.SERVO_STIFFNESS
        # While a motor is at its limit, its aim does not run away (anti-windup).
        state.aim = np.where(
            state.released, np.clip(state.aim, self.angles() - limit, self.angles() + limit), state.aim
        )
        torque = d.SERVO_STIFFNESS * (state.aim - self.angles()) + d.SERVO_DAMPING * (state.speed - self.speeds())
        return np.clip(torque, -self.torque, self.torque)

    def _brake(self):
        """Brake as a spring from its anchor up to the slip torque; beyond it the anchor is dragged along."""
        state, limit = self.state, d.BRAKE_TORQUE / d.BRAKE_STIFFNESS
        gripped = np.clip(state.anchor, self.angles() - limit, self.angles() + limit)
        state.anchor = np.where(state.released, state.anchor, gripped)
        torque = d.BRAKE_STIFFNESS * (state.anchor - self.angles()) - d.BRAKE_DAMPING * self.speeds()
        return np.clip(torque, -d.BRAKE_TORQUE, d.BRAKE_TORQUE)

    def _load(self):
        return np.clip(self.machine.data.ctrl[self.motors], -self.torque, self.torque)

    # --- measured and computed state
    # ------------------------------------------------------------------------------------

    def angles(self):
        return self.machine.data.qpos[self.places]

    def speeds(self):
        return self.machine.data.qvel[self.dofs]

    def jacobian(self):
        """Jacobian of the control point, by the angles of the motors."""
        data = self.machine.data
        base = data.xpos[self.base], data.xmat[self.base].reshape(3, 3)
        matrix = kinematics.jacobian(self.angles(), *base)
        if self.point.any():
            beside = kinematics.forward(self.angles(), *base)[3] @ self.point
            matrix[:3] += np.cross(matrix[3:].T, beside).T
        return matrix

    def _sensor(self, machine):
        """Force and moment about the control point from beyond the sensor, less inertia, along world axes.

        MuJoCo's sensor gives the inertia less the forces that it knows of; the contacts of the plugin are passive
        forces to it and are not in there, so they are added.
        """
        data = machine.data
        axes = data.site_xmat[self.site].reshape(3, 3)
        own = data.sensordata[self.wrench_at]
        touching = wrenches(data.sensordata[machine.sensed])[self.carried]
        forces, arms = touching[:, :3], data.xpos[self.carriers] - data.xpos[self.tip]
        moments = touching[:, 3:] + np.cross(arms, forces)
        force, moment = forces.sum(axis=0) - axes @ own[:3], moments.sum(axis=0) - axes @ own[3:]
        return np.concatenate([force, moment - np.cross(axes @ self.point, force)])

    def _carries(self, carrier):
        """True if a body depends, directly or not, on the tip."""
        while carrier not in (0, self.tip):
            carrier = self.machine.model.body_parentid[carrier]
        return carrier == self.tip

    def save(self):
        return copy.deepcopy(self.state)

    def restore(self, state):
        self.state = copy.deepcopy(state)
