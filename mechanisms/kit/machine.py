"""A mechanism in MuJoCo with Pong's contact: steps it and records energy, reactions and flags."""

import os

import mujoco
import numpy as np

from kit.ledger import Ledger

FULL = mujoco.mjtState.mjSTATE_INTEGRATION
TUNNELLED = 4  # flag of the plugin's sensor, docs/mujoco.md
_loaded = False


def wrenches(sensed):
    """Force (N) and moment (N·m) of each movable group, from sensor values of one step or of many, row by row."""
    return sensed[..., 3:].reshape(*sensed.shape[:-1], -1, 6)


def load_plugin():
    """Loads the plugin from the file in PLUGIN, as ci/mechanisms sets it, or from the wheel pong_mujoco."""
    global _loaded
    if _loaded:
        return
    if "PLUGIN" in os.environ:
        mujoco.mj_loadPluginLibrary(os.environ["PLUGIN"])
    else:
        import pong_mujoco  # noqa: F401 (importing loads the plugin)
    _loaded = True


class Machine:
    """`mjcf`: text of a model with one instance of pong.contact, whose sensor is called `contact`.

    `carriers`: names of the bodies that carry the movable groups, in the order of the sensor (docs/mujoco.md).
    `groups`: names of these groups, for those who ask for the wrench on one.
    `watchers`: functions that see the machine after each step, such as a `kit.record.Recorder`.
    """

    def __init__(self, mjcf, carriers, groups=()):
        load_plugin()
        self.text, self.watchers = mjcf, []
        self.model = mujoco.MjModel.from_xml_string(mjcf)
        self.data = mujoco.MjData(self.model)
        self.carriers = [self.model.body(name).id for name in carriers]
        self.groups = {name: i for i, name in enumerate(groups)}
        start = self.model.sensor("contact").adr[0]
        self.sensed = slice(start, start + self.model.sensor("contact").dim[0])
        self.step = self.model.opt.timestep
        self.contacts_most, self.flags, self.imbalance = 0, 0, 0.0
        self.start()

    def start(self):
        """Call after setting positions or velocities: the energy account begins here."""
        mujoco.mj_forward(self.model, self.data)
        self.ledger = Ledger(self.model, self.data)

    @property
    def name(self):
        return self.model.names[: self.model.names.index(b"\0")].decode()

    @property
    def time(self):
        return self.data.time

    def advance(self, control=None):
        """Runs one step. `control(machine)` sets the controls before it."""
        if control is not None:
            control(self)
        with self.ledger:
            mujoco.mj_step(self.model, self.data)
        # Forces of the new state; the plugin's evaluation is pure, so this changes nothing that follows.
        mujoco.mj_forward(self.model, self.data)
        self._look()
        for watch in self.watchers:
            watch(self)

    def hurry(self, control=None):
        """Runs one step without the accounts of energy and reactions; forces read afterwards are those of its beginning."""
        if control is not None:
            control(self)
        mujoco.mj_step(self.model, self.data)
        self._computed()

    def stride(self, seconds):
        """Runs steps with constant controls and without the accounts; returns the sensor values of each, row by row."""
        sensed = self.data.sensordata[self.sensed]  # a view of MuJoCo's memory
        seen = np.empty((round(seconds / self.step), len(sensed)))
        for row in seen:
            mujoco.mj_step(self.model, self.data)
            row[:] = sensed
        self.judge(seen)
        return seen

    def judge(self, seen):
        """Records flags and status of many steps, given as rows of the sensor."""
        if seen[:, 2].any():
            raise RuntimeError(f"before {self.time:.6f} s a step could not be computed")
        self.flags |= int(np.bitwise_or.reduce(seen[:, 1].astype(int)))

    def run(self, seconds, control=None, watch=None):
        """Runs for a duration, or until `watch(machine)` is true; returns whether it was."""
        for _ in range(round(seconds / self.step)):
            self.advance(control)
            if watch is not None and watch(self):
                return True
        return False

    def _computed(self):
        """Sensor values of a valid step; records its flags."""
        sensed = self.data.sensordata[self.sensed]
        if sensed[2] != 0:
            raise RuntimeError(f"at {self.time:.6f} s a step could not be computed: status {int(sensed[2])}")
        self.flags |= int(sensed[1])
        return sensed

    def _look(self):
        sensed = self._computed()
        if not np.all(np.isfinite(self.data.qpos)):
            raise RuntimeError(f"at {self.time:.6f} s positions are no longer finite: the step is too long")
        self.contacts_most = max(self.contacts_most, int(sensed[0]))
        found = wrenches(sensed)
        forces, moments = found[:, :3], found[:, 3:]
        arms = self.data.xpos[self.carriers]
        about_origin = (moments + np.cross(arms, forces)).sum(axis=0)
        greatest = np.abs(forces).max(initial=0.0)
        if greatest > 0.0:
            off = max(np.abs(forces.sum(axis=0)).max(), np.abs(about_origin).max())
            self.imbalance = max(self.imbalance, off / greatest)

    @property
    def tunnelled(self):
        return bool(self.flags & TUNNELLED)

    def contacts(self):
        return int(self.data.sensordata[self.sensed][0])

    def wrench(self, carrier):
        """Force (N) and moment (N·m) about the origin of the body, along the axes of the world, summed over its groups."""
        body = self.model.body(carrier).id
        found = wrenches(self.data.sensordata[self.sensed])
        return found[[i for i, other in enumerate(self.carriers) if other == body]].sum(axis=0)

    def on(self, group):
        """Force (N) and moment (N·m) on a named movable group."""
        first = self.sensed.start + 3 + 6 * self.groups[group]
        return self.data.sensordata[first : first + 6]

    def joint(self, name):
        return float(self.data.qpos[self.model.joint(name).qposadr[0]])

    def speed(self, name):
        return float(self.data.qvel[self.model.joint(name).dofadr[0]])

    def scale_mass(self, body, factor):
        """Multiplies the mass of a body. Call `mujoco.mj_setConst` yourself: it resets joints to their reference."""
        number = self.model.body(body).id
        self.model.body_mass[number] *= factor
        self.model.body_inertia[number] *= factor

    def place(self, body):
        return self.data.xpos[self.model.body(body).id].copy()

    def save(self):
        state = np.empty(mujoco.mj_stateSize(self.model, FULL))
        mujoco.mj_getState(self.model, self.data, state, FULL)
        return state

    def restore(self, state):
        mujoco.mj_setState(self.model, self.data, state, FULL)
        self.start()
